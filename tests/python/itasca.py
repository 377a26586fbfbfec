#!/usr/bin/env python3
"""itasca.py PROGRAM: drivers written for other programs find their names in kaya.itasca."""

import sys
import unittest

try:
    import numpy as np
except ImportError:
    print("skipped: numpy is not installed")
    sys.exit(77)
import kaya
import kaya.itasca as it

sys.argv.pop()


class Driver(unittest.TestCase):
    def setUp(self):
        it.use(kaya.Model())
        it.command("""block create brick 0 1 0 1 0 1
            block create brick 0 1 0 1 1 2""")

    def test_objects(self):
        blocks = list(it.block.list())
        self.assertEqual((len(blocks), it.block.count()), (2, 2))
        self.assertEqual([b.id() for b in blocks], [1, 2])
        np.testing.assert_allclose(it.block.find(2).pos(), (0.5, 0.5, 1.5))
        self.assertEqual(it.block.near((0, 0, 5)).id(), 2)
        self.assertIsNone(it.block.find(3))
        blocks[0].set_vel((1, 2, 3))
        np.testing.assert_array_equal(blocks[0].vel(), (1, 2, 3))
        with self.assertRaises(AttributeError):
            blocks[0].nosuch()

    def test_near_takes_the_block_that_contains_the_place(self):
        it.use(kaya.Model())
        it.command("""block create brick 0 10 0 10 0 10
            block create brick 0 1 0 1 10 11""")
        self.assertEqual(it.block.near((0.5, 0.5, 9.5)).id(), 1)  # the centroid of block 2 is nearer
        self.assertEqual(it.block.near((0.5, 0.5, 10.5)).id(), 2)
        self.assertEqual(it.block.near((9, 9, 10.5)).id(), 1)  # beside block 2: the surface of block 1 is nearer
        it.use(kaya.Model())
        self.assertIsNone(it.block.near((0, 0, 0)))

    def test_objects_stay_the_same(self):
        first, second = it.block.list()
        it.command("block delete range position-z 0 0.9")
        self.assertEqual((it.block.count(), second.id()), (1, 2))
        np.testing.assert_allclose(second.pos(), (0.5, 0.5, 1.5))
        for use in first.pos, first.id, lambda: first.set_vel((1, 0, 0)):
            with self.assertRaisesRegex(kaya.Error, "this block no longer exists"):
                use()
        self.assertEqual(repr(first), "<block, deleted>")
        point = it.block.gridpoint.near((0, 0, 2))
        it.command("block cut joint-set dip 0 origin 0 0 1.5")
        with self.assertRaisesRegex(kaya.Error, "this gridpoint no longer exists"):
            point.pos()
        it.use(kaya.Model())
        self.assertEqual(second.id(), 2)  # of the model that it was found in

    def test_arrays(self):
        self.assertEqual(it.blockarray.pos().shape, (2, 3))
        it.blockarray.set_vel(np.ones((2, 3)))
        np.testing.assert_array_equal(it.blockarray.vel(), np.ones((2, 3)))

    def test_fish(self):
        it.command("fish define twice(a)\n twice = 2 * a\nend")
        it.fish.set("x", 4)
        self.assertEqual(it.fish.get("x"), 4)
        self.assertEqual(it.fish.call_function("twice", (5,)), 10)

    def test_contacts(self):
        self.assertEqual(it.block.contact.count(), 1)
        point = next(iter(it.block.subcontact.list()))
        self.assertEqual(point.force_norm(), 0)


if __name__ == "__main__":
    unittest.main()
