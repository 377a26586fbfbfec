#!/usr/bin/env python3
"""forces.py PROGRAM: interfaces and reactions of a block on a slope are those of statics, wherever and in whatever units it lies."""

import itertools
import math
import sys
import unittest

try:
    import numpy as np
except ImportError:
    print("skipped: numpy is not installed")
    sys.exit(77)
import kaya

sys.argv.pop()
DIP, FRICTION = 15.0, 30.0 # below 18.4 degrees the whole foot of the cube is pressed


class Slope:
    """A cube of unit length on a larger block, seen in axes that are tilted: gravity is turned in place of the slope."""

    def __init__(self, length=1.0, mass=1.0, time=1.0, at=(0, 0, 0), mirrored=False, order=(0, 1), cohesion=0.0, friction=FRICTION):
        sign = -1 if mirrored else 1
        self.weight = 2000 * 9.81 * mass * length / time**2  # of one cubic length
        down = np.array([sign * math.sin(math.radians(DIP)), 0, -math.cos(math.radians(DIP))])
        self.gravity = 9.81 * length / time**2 * down
        boxes = [((-1, 2), (-1, 2), (-1, 0)), ((0, 1), (0, 1), (0, 1))]
        if mirrored:
            boxes = [((-x[1], -x[0]), y, z) for x, y, z in boxes]
        self.at, self.length = np.array(at, float) * length, length
        stiffness, stress = 1e9 * mass / length**2 / time**2, mass / length / time**2
        lines = []
        for box in (boxes[k] for k in order):
            lines.append("poly brick " + " ".join(repr(float((value + at[axis]) * length))
                                                  for axis, side in enumerate(box) for value in side))
        top, foot = (order.index(1) + 1, order.index(0) + 1)
        self.top, self.foot = top, foot
        x, y, z = self.at
        lines += [f"prop mat 1 dens {2000 * mass / length**3!r}",
                  f"prop jmat 1 jkn {stiffness!r} jks {stiffness!r} jfric {friction} jcoh {cohesion * stress!r}",
                  f"fix range z {z - length!r} {z + 1e-3 * length!r}", "gravity " + " ".join(repr(float(g)) for g in self.gravity),
                  "damp local 0.8", "cycle 3000"]
        self.model = kaya.Model()
        self.model.command("\n".join(lines))
        self.force = self.weight * down  # of the cube on the slope


class Forces(unittest.TestCase):
    cases = {"plain": {}, "mirrored": {"mirrored": True}, "numbered the other way": {"order": (1, 0)}, "far away": {"at": (3e4, -2e4, 1e4)},
             "millimetres, tonnes": {"length": 1e3, "mass": 1e-3}, "feet, slugs": {"length": 3.28, "mass": 0.0685},
             "milliseconds": {"time": 1e3}}

    def test_of_a_block_on_a_slope(self):
        for name, case in self.cases.items():
            with self.subTest(name):
                slope = Slope(**case)
                (one,) = slope.model.interfaces()
                self.assertEqual({one["block1"], one["block2"]}, {1, 2})
                sign = 1 if one["block1"] == slope.top else -1
                near = dict(rtol=1e-6, atol=1e-6 * slope.weight)
                np.testing.assert_allclose(sign * one["force"], slope.force, **near)
                np.testing.assert_allclose(sign * one["normal"], (0, 0, -1), atol=1e-6)
                np.testing.assert_allclose(one["normal_force"], slope.weight * math.cos(math.radians(DIP)), rtol=1e-6)
                np.testing.assert_allclose(one["shear_force"], slope.weight * math.sin(math.radians(DIP)), rtol=1e-6)
                np.testing.assert_allclose(one["utilisation"], math.tan(math.radians(DIP)) / math.tan(math.radians(FRICTION)), rtol=1e-6)
                np.testing.assert_allclose(one["area"], slope.length**2, rtol=1e-6)
                # The force passes through the centroid of the cube: half a length up the line of gravity.
                side = -1 if case.get("mirrored") else 1
                foot = np.array([side * (0.5 + 0.5 * math.tan(math.radians(DIP))), 0.5, 0]) * slope.length + slope.at
                np.testing.assert_allclose(one["point"], foot, atol=1e-3 * slope.length)
                (polygon,) = one["polygons"]
                np.testing.assert_allclose(np.ptp(polygon, axis=0), (slope.length, slope.length, 0), atol=1e-3 * slope.length)

    def test_reactions_hold_all_weights(self):
        for name, case in self.cases.items():
            with self.subTest(name):
                slope = Slope(**case)
                found = slope.model.reactions()
                weight = 10 * slope.force  # nine cubes of the foot, and one
                np.testing.assert_allclose(found["weight"], weight, rtol=1e-9)
                np.testing.assert_allclose(found["reaction"], -weight, rtol=1e-6, atol=1e-6 * slope.weight)
                np.testing.assert_allclose(found["reaction"] + found["weight"] + found["load"], found["unbalanced"], atol=1e-9 * slope.weight)
                self.assertEqual([group["held"] for group in found["groups"].values()], [1])

    def test_reactions_of_each_support(self):
        model = kaya.Model()
        model.command("poly brick 0 1 0 1 0 1\npoly brick 3 4 0 1 0 1\npoly brick 0 4 0 1 1 2\ngroup block left range x 0 1 z 0 1\n"
                      "group block right range x 3 4 z 0 1\nfix range z 0 1\nprop mat 1 dens 1000\nprop jmat 1 jkn 1e9 jks 1e9 jfric 30\n"
                      "gravity 0 0 -10\ndamp local 0.8\ncycle 3000")
        groups = model.reactions()["groups"]
        self.assertEqual(set(groups), {"left", "right"})
        for support in groups.values(): # own weight and half of the beam
            np.testing.assert_allclose(support["force"], (0, 0, 10000 + 20000), atol=1e-2)
            np.testing.assert_allclose(support["weight"], (0, 0, -10000), rtol=1e-12)

    def test_utilisation_with_cohesion_and_without_strength(self):
        strong = Slope(cohesion=1e4)
        (one,) = strong.model.interfaces()
        strength = one["normal_force"] * math.tan(math.radians(FRICTION)) + 1e4
        np.testing.assert_allclose(one["utilisation"], one["shear_force"] / strength, rtol=1e-9)
        bare = kaya.Model()
        bare.command("poly brick 0 1 0 1 0 1\npoly brick 0 1 0 1 1 2")
        (one,) = bare.interfaces()
        self.assertIsNone(one["utilisation"])
        self.assertEqual(one["force"].tolist(), [0, 0, 0])
        np.testing.assert_allclose(one["point"], one["centre"])

    def test_without_blocks_supports_or_contacts(self):
        model = kaya.Model()
        self.assertEqual(model.interfaces(), [])
        self.assertEqual(model.reactions()["groups"], {})
        model.command("poly brick 0 1 0 1 0 1\npoly brick 5 6 0 1 0 1")
        self.assertEqual(model.interfaces(), [])
        self.assertEqual(model.reactions()["reaction"].tolist(), [0, 0, 0])

    def test_joined_blocks_are_one_body(self):
        model = kaya.Model()
        model.command("\n".join(f"poly brick {x} {x + 1} 0 1 {z} {z + 1}" for x, z in itertools.product((0, 1), (0, 1))) +
                      "\njoin on range z 1 2")
        self.assertEqual([(one["block1"], one["block2"]) for one in model.interfaces() if 2 in (one["block1"], one["block2"])],
                         [(1, 2), (2, 3)])


if __name__ == "__main__":
    unittest.main()
