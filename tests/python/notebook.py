#!/usr/bin/env python3
"""notebook.py PROGRAM: the notebook of the examples runs, and its figures are those of statics and of a sliding body."""

import ast
import math
import sys
import tempfile
import unittest
from pathlib import Path

try:
    import ipykernel  # noqa: F401
    import matplotlib  # noqa: F401
    import nbformat
    import numpy as np
    from nbclient import NotebookClient
except ImportError as missing:
    print(f"skipped: {missing.name} is not installed (scripts/install --all)")
    sys.exit(77)

sys.argv.pop()
FILE = Path(__file__).resolve().parents[2] / "examples/notebook/block-on-a-slope.ipynb"
SHOWN = "print([list(map(float, dips)), utilisation, times, places, reactions['weight'].tolist(), reactions['reaction'].tolist()])"


class Notebook(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.stored = nbformat.read(FILE, as_version=4)
        cls.book = nbformat.read(FILE, as_version=4)
        cls.book.cells.append(nbformat.v4.new_code_cell(SHOWN))
        with tempfile.TemporaryDirectory() as folder:
            NotebookClient(cls.book, timeout=120, resources={"metadata": {"path": folder}}).execute()
        cls.dips, cls.utilisation, cls.times, cls.places, cls.weight, cls.reaction = ast.literal_eval(
            "".join(output["text"] for output in cls.book.cells[-1]["outputs"]))

    def test_is_stored_without_results(self):
        nbformat.validate(self.stored)
        for cell in self.stored.cells:
            self.assertFalse(cell.get("outputs"), cell["id"])

    def test_draws_two_figures(self):
        pictures = [output for cell in self.book.cells for output in cell.get("outputs", []) if "image/png" in output.get("data", {})]
        self.assertEqual(len(pictures), 2)

    def test_utilisation(self):
        self.assertEqual(len(self.dips), 8)
        np.testing.assert_allclose(self.utilisation, np.tan(np.radians(self.dips)) / math.tan(math.radians(30)), rtol=1e-5, atol=1e-9)

    def test_sliding(self):
        dip = math.radians(40)
        acceleration = 9.81 * (math.sin(dip) - math.cos(dip) * math.tan(math.radians(30)))
        self.assertGreater(self.times[-1], 0.98)
        np.testing.assert_allclose(self.places, 0.5 * acceleration * np.square(self.times), rtol=1e-3, atol=1e-4 * self.places[-1])

    def test_reactions(self):
        expected = 2500 * 9.81 * 30.2 * np.array([math.sin(math.radians(15)), 0, -math.cos(math.radians(15))])
        np.testing.assert_allclose(self.weight, expected, rtol=1e-9)
        np.testing.assert_allclose(self.reaction, -expected, rtol=1e-5, atol=1e-5 * 2500 * 9.81)


if __name__ == "__main__":
    unittest.main()
