#!/usr/bin/env python3
"""model.py PROGRAM: what a model of the package kaya shows is what the program computes."""

import os
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

try:
    import numpy as np
except ImportError:
    print("skipped: numpy is not installed")
    sys.exit(77)
import kaya

PROGRAM = sys.argv.pop()
WALL = """poly brick 0 3 0 1 0 3
jset dip 0 dd 0 org 0 0 0 spacing 1 num 5
jset dip 90 dd 90 org 0 0 0 spacing 1 num 5
prop mat 1 dens 2000 kn 1e9 ks 1e9 fric 30
prop jmat 1 jkn 1e9 jks 1e9 jfric 30
fix range z 0 0.9
gravity 0 0 -10
hist ncyc 5
hist unbal
hist label 1 'out of balance'
damp auto
cycle 200
"""


def wall():
    model = kaya.Model()
    model.command(WALL)
    return model


class Reading(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.model = wall()

    def test_bits_of_the_program(self):
        with tempfile.TemporaryDirectory() as folder:
            with open(folder + "/wall.3dd", "w") as deck:
                deck.write(WALL + "save 'wall.kaya.h5'\n")
            said = subprocess.run([PROGRAM, "wall.3dd"], cwd=folder, capture_output=True, text=True, check=True)
            self.assertIn("hash " + self.model.hash, said.stdout + said.stderr)
            self.assertEqual(kaya.open(folder + "/wall.kaya.h5").hash, self.model.hash)
            self.assertEqual(kaya.run(folder + "/wall.3dd").hash, self.model.hash)
            self.model.save(folder + "/again.kaya.h5")
            again = kaya.open(folder + "/again.kaya.h5")
            again.cycle(3)
            other = kaya.open(folder + "/wall.kaya.h5")
            other.cycle(3)
            self.assertEqual(again.hash, other.hash)

    def test_every_field_of_every_kind(self):
        for kind in ("blocks", "gridpoints", "faces", "contacts", "sub_contacts", "corners"):
            table = getattr(self.model, kind)
            self.assertGreater(len(table), 0, kind)
            for field in table.fields():
                values = table[field]
                self.assertEqual(len(values), len(table), f"{kind}.{field}")
        self.assertEqual(self.model.blocks["position"].shape, (9, 3))
        np.testing.assert_allclose(self.model.blocks["volume"], 1, rtol=1e-12)
        np.testing.assert_array_equal(self.model.blocks["position"][:, 2], self.model.blocks["z"])
        first = self.model.sub_contacts["contact"]
        self.assertEqual(first.dtype, np.int64)
        self.assertLess(first.max(), len(self.model.contacts))
        np.testing.assert_array_equal(self.model.blocks["b_vol"], self.model.blocks["volume"])

    def test_views_are_the_memory(self):
        columns = self.model.columns()
        for table, names in columns.items():
            for column, (dtype, shape) in names.items():
                view = self.model.view(table, column)
                self.assertEqual((view.dtype, view.shape), (dtype, shape))
                self.assertEqual(np.asarray(view).tobytes(), view[:].tobytes())
        view = self.model.view("blocks", "velocity")
        np.testing.assert_array_equal(view, self.model.blocks["velocity"])
        with self.assertRaises(KeyError):
            self.model.view("blocks", "nosuch")
        with view as array:
            self.assertFalse(array.flags.writeable)
            with self.assertRaises(ValueError):
                array[0] = 1

    def test_forces_balance_weights(self):
        model = self.model
        weight = -np.array([0, 0, 9 * 2000 * 10.0])
        reactions = model.reactions()
        np.testing.assert_allclose(reactions["weight"], weight, rtol=1e-12)
        # What is out of balance moves the free blocks.
        force = np.zeros((10, 3))
        for one in model.interfaces():
            self.assertAlmostEqual(one["area"], 1, places=4)
            force[one["block1"]] -= one["force"]
            force[one["block2"]] += one["force"]
        held = model.blocks["fixed"] != 0
        total = force[model.blocks["id"]] + np.array([0, 0, -20000.0])
        np.testing.assert_allclose(total[~held].sum(axis=0), reactions["unbalanced"], atol=1e-6)

    def test_supports_by_the_group_of_the_default_slot(self):
        model = wall()
        model.command("block group 'left' slot 'side' range position-z 0 1\ngroup block foot range z 0 1")
        self.assertEqual(set(model.reactions()["groups"]), {"foot"})
        model.command("block group 'foot' remove range position-z 0 1")
        self.assertEqual(set(model.reactions()["groups"]), {""})

    def test_histories(self):
        history = self.model.histories["out of balance"]
        self.assertEqual((history.number, len(history.values), list(history.cycle[:2])), (1, 40, [5, 10]))
        self.assertEqual(len(history.time), 40)

    def test_quantities(self):
        self.assertEqual(self.model.cycle_number, 200)
        self.assertEqual(self.model.time, self.model.histories["out of balance"].time[-1])
        with self.assertRaises(AttributeError):
            self.model.nosuch
        self.assertIn("unbalanced_force", dir(self.model))

    def test_pandas(self):
        try:
            import pandas  # noqa: F401
        except ImportError:
            self.skipTest("pandas is not installed")
        frame = self.model.blocks.frame(["id", "position"])
        self.assertEqual(list(frame.columns), ["id", "x_position", "y_position", "z_position"])


class Changing(unittest.TestCase):
    def test_fields_are_set(self):
        model = wall()
        model.blocks["velocity"] = (0, 0, 0)
        self.assertEqual(abs(model.blocks["velocity"]).max(), 0)
        model.blocks.set("x_velocity", [1.0, 2.0], rows=[2, 0])
        np.testing.assert_array_equal(model.blocks["velocity"][[2, 0], 0], [1, 2])
        mask = model.blocks["x_velocity"] > 1.5
        model.blocks.set("x_velocity", 3.0, rows=mask)
        np.testing.assert_array_equal(model.blocks["velocity"][[2, 0], 0], [1, 3])
        with self.assertRaises(IndexError):
            model.blocks.set("x_velocity", 1.0, rows=[True, False])
        with self.assertRaises(TypeError):
            model.blocks.set("x_velocity", 1.0, rows=[1.5])
        with self.assertRaises(TypeError):
            model.cycle(2.5)
        model.blocks["velocity"] = np.arange(27.0).reshape(9, 3)
        np.testing.assert_array_equal(model.blocks["velocity"], np.arange(27.0).reshape(9, 3))
        for field, value, rows in (("volume", 1.0, [0]), ("nosuch", 1.0, [0]), ("x_velocity", 1.0, [9]), ("x_velocity", 1.0, [-1]),
                                   ("x_velocity", "a", [0]), ("velocity", [1.0, 2.0], [0]), ("x_velocity", [1.0], [0, 1]),
                                   ("x_velocity", None, [0]), ("x_velocity", float("nan"), [0])):
            before = model.hash
            with self.assertRaises((kaya.Error, KeyError, IndexError, ValueError, TypeError), msg=(field, value, rows)):
                model.blocks.set(field, value, rows)
            self.assertEqual(model.hash, before, (field, value, rows))

    def test_views_end_with_their_rows(self):
        model = wall()
        view = model.view("blocks", "velocity")
        with view as array:
            part = array[2:]
        with self.assertRaises(BufferError):
            model.cycle()
        del array
        with self.assertRaises(BufferError):
            model.cycle()
        del part
        model.cycle()
        self.assertEqual(len(view), 9)
        model.command("poly brick 9 10 0 1 0 1")
        with self.assertRaisesRegex(RuntimeError, "take a new view"):
            view[0]

    def test_values_of_fish(self):
        model = kaya.Model()
        for value in (3, 2.5, "text", (1.0, 2.0, 3.0), True):
            model.set("x", value)
            self.assertEqual(model.get("x"), value)
        model.command("def twice(a)\n twice = 2 * a\nend")
        self.assertEqual(model.get("twice(4)"), 8)
        for wrong in ([1, 2], {"a": 1}, object(), [1, 2, "3"]):
            with self.assertRaises((TypeError, ValueError, RuntimeError)):
                model.set("x", wrong)
        with self.assertRaises(kaya.Error):
            model.get("1 +")

    def test_results_and_messages(self):
        out, messages = [], []
        model = kaya.Model(out=out.append, messages=messages.append)
        model.command("list blocks")
        model.command("poly brick 0 1 0 1 0 1\nlist blocks")
        self.assertIn("rigid", "".join(out))
        out.clear()
        self.assertIn("rigid", model.capture("list blocks"))
        self.assertEqual(out, [])

    def test_both_dialects(self):
        old, new = kaya.Model(), kaya.Model()
        old.command("poly brick 0 1 0 2 0 3")
        new.command("block create brick 0 1 0 2 0 3")
        self.assertEqual(old.hash, new.hash)


class Errors(unittest.TestCase):
    def test_have_their_place(self):
        model = kaya.Model()
        with self.assertRaises(kaya.Error) as caught:
            model.command("poly brick 0 1 0 1 0 1\npoly brik 0 1 0 1 0 1")
        error = caught.exception
        self.assertEqual((error.file, error.line, error.column, error.status), ("python", 2, 6, 1))
        self.assertIn("brick", error.hint)
        self.assertIn("brik", error.message)
        self.assertEqual(len(error.errors), 1)
        self.assertIn("^^^^", str(error))
        self.assertEqual(len(model.blocks), 0)

    def test_of_a_run(self):
        model = kaya.Model()
        with self.assertRaises(kaya.Error) as caught:
            model.command("restore 'nosuch.kaya.h5'")
        self.assertIn("nosuch", caught.exception.message)
        for wrong in ("", "\n\n", "\x00", "x" * 100000, "def f\n", "lua\nerror('mine')\nendlua", "lua\nendlua\nlua"):
            try:
                model.command(wrong)
            except kaya.Error as error:
                self.assertTrue(error.message)
        self.assertEqual(len(model.blocks), 0)

    def test_parameters(self):
        with tempfile.TemporaryDirectory() as folder:
            def written(name, text):
                Path(folder, name).write_text(text)
                return f"{folder}/{name}"

            inner = written("inner.3dd", "param angle = 3\nparam width = 1\npoly brick 0 @width 0 @angle 0 1\n")
            outer = written("outer.3dd", "program call 'inner.3dd'\n")
            own = written("own.3dd", "set @angle = 3\npoly brick 0 1 0 @angle 0 1\n")
            for deck in inner, outer:
                np.testing.assert_allclose(kaya.run(deck, Angle=5, width=2).blocks["volume"], [10])
            model = kaya.Model(messages=lambda text: None)
            for name in outer, outer.removesuffix(".3dd"):
                with self.assertRaisesRegex(kaya.Error, "the deck does not mention 'angel'") as caught:
                    model.run(name, angel=5)
                self.assertEqual(caught.exception.hint, "did you mean 'angle'?")
            self.assertEqual(len(model.blocks), 0)
            # They hold for one run: later ones have their own, or those of the deck.
            sweep = written("sweep.3dd", "param a = 7\nparam n = 3\ndef f\n twice = 2.0*a\n half = n/2\nend\n@f\n")
            for given, twice in ({"a": 2}, 4), ({"a": 3.0}, 6), ({}, 14), ({"a": np.float32(0.5)}, 1):
                model.run(sweep, **given)
                self.assertEqual(model.get("twice"), twice)
            for seven in 7, np.int64(7):
                model.run(sweep, n=seven)
                self.assertEqual(model.get("half"), 3, "an integer of numpy is one of FISH")
            for wrong in None, float("nan"), [1], np.zeros(2):
                with self.assertRaisesRegex(TypeError, "the parameter n is"):
                    model.run(sweep, n=wrong)
            model.run(own, angle=5)
            self.assertEqual(len(model.warnings), 1)
            self.assertIn("the deck sets 'angle' itself", model.warnings[0])

            yields = written("property.3dd", "prop mat 1 dens 2000\npoly brick 0 1 0 1 0 1\n")
            model = kaya.Model(messages=lambda text: None)
            model.run(yields, **{"prop 1 dens": 2500, "prop 2 dens": 2500})
            self.assertEqual(len(model.warnings), 1)
            self.assertIn("no command set 'prop 2 dens'", model.warnings[0])

    def test_strict(self):
        model = kaya.Model(strict=True)
        model.command("poly brick 0 1 0 1 0 1")
        with self.assertRaises(kaya.Error):
            model.command("hide range x 5 6")
        relaxed = kaya.Model(messages=lambda text: None)
        relaxed.command("poly brick 0 1 0 1 0 1\nhide range x 5 6")
        self.assertEqual(len(relaxed.warnings), 1)


if __name__ == "__main__":
    os.chdir(tempfile.mkdtemp())
    unittest.main()
