#!/usr/bin/env python3
"""stubs.py PROGRAM: the stubs of the package are those of the real module, by name, argument and type, and mypy accepts the package."""

import ast
import inspect
import os
import re
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

try:
    import numpy  # noqa: F401
except ImportError:
    print("skipped: numpy is not installed")
    sys.exit(77)
import kaya
from kaya import _kaya, quantities

sys.argv.pop()
SOURCE = Path(__file__).resolve().parents[2]
PACKAGE = Path(kaya.__file__).resolve().parent
PROGRAM_OF_A_USER = """import kaya
import numpy as np
from numpy.typing import NDArray

m = kaya.Model()
ids: NDArray[np.int64] = m.blocks["id"]
groups: list[str] = m.blocks["group"]
forces: NDArray[np.float64] = m.sub_contacts["normal_force"]
cycles: int = m.cycle_number
ratio: float = m.average_ratio
error: kaya.Error
place: int | None = error.line
"""


def functions(tree):
    """{name: node} of the functions of a stub; those of a class with its name before."""
    found = {}
    for node in tree.body:
        if isinstance(node, ast.ClassDef):
            found |= {f"{node.name}.{name}": inner for name, inner in functions(node).items()}
        elif isinstance(node, ast.FunctionDef):
            found[node.name] = node
    return found


class Stubs(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.tree = ast.parse((PACKAGE / "_kaya.pyi").read_text())

    def test_the_compiled_module_has_these_functions_with_these_arguments(self):
        real = {}
        for owner, prefix in ((_kaya, ""), (_kaya.Session, "Session.")):
            for name, value in vars(owner).items():
                if callable(value) and not isinstance(value, type) and (name == "__init__" or not name.startswith("__")):
                    head = value.__doc__.split("->")[0]
                    real[prefix + name] = re.findall(r"(\w+): ", head)
        stubbed = {name: [argument.arg for argument in node.args.args] for name, node in functions(self.tree).items()}
        self.assertEqual(set(stubbed), set(real))
        for name, arguments in real.items():
            self.assertEqual([a for a in stubbed[name] if a != "self"], [a for a in arguments if a != "self"], name)

    def test_every_function_says_what_it_does(self):
        for name, node in functions(self.tree).items():
            self.assertTrue(name.endswith("__init__") or ast.get_docstring(node), name)
        for name, member in inspect.getmembers(kaya.Model):
            self.assertTrue(name.startswith("_") or member.__doc__, name)

    def test_errors_have_the_parts_of_the_stub(self):
        parts = next(node for node in self.tree.body if isinstance(node, ast.ClassDef) and node.name == "Error").body
        with self.assertRaises(kaya.Error) as caught:
            kaya.Model().command("poly brik")
        for part in parts:
            if isinstance(part, ast.AnnAssign):
                self.assertTrue(hasattr(caught.exception, part.target.id), part.target.id)

    def test_tables_and_quantities_are_those_of_the_engine(self):
        said = subprocess.run([sys.executable, SOURCE / "scripts/python-stubs", "--check"], capture_output=True, text=True)
        self.assertEqual(said.returncode, 0, said.stderr)

    def test_help_comes_from_the_tables(self):
        self.assertIn("sub_contact", quantities.SubContacts.__doc__)
        for name, info in kaya.Model().blocks.fields().items():
            self.assertIn(f" {name}{'*' if info['writable'] else ''}: {info['help']}", quantities.Blocks.__doc__)
        self.assertIn("poly brick", kaya.help("poly"))
        self.assertIn("volume", kaya.help("b_vol"))
        with self.assertRaises(kaya.Error):
            kaya.help("nosuchword")

    def check(self, *command, **options):
        if not shutil.which(command[0], path="/usr/bin"):
            self.skipTest(f"{command[0]} is not installed (scripts/install --all)")
        said = subprocess.run(["/usr/bin/" + command[0], *command[1:]], capture_output=True, text=True, **options)
        self.assertEqual(said.returncode, 0, said.stdout + said.stderr)

    def test_with_mypy(self):
        with tempfile.TemporaryDirectory() as folder:
            program = Path(folder) / "program.py"
            program.write_text(PROGRAM_OF_A_USER)
            path = {**os.environ, "MYPYPATH": str(PACKAGE.parent)}
            self.check("mypy", "--config-file", SOURCE / "pyproject.toml", "--cache-dir", folder + "/cache", "-p", "kaya", cwd=folder, env=path)
            self.check("mypy", "--strict", "--cache-dir", folder + "/cache", str(program), cwd=folder, env=path)
            program.write_text(PROGRAM_OF_A_USER + "m.nosuch\n")
            with self.assertRaisesRegex(AssertionError, 'has no attribute "nosuch"'):
                self.check("mypy", "--strict", "--cache-dir", folder + "/cache", str(program), cwd=folder, env=path)

    def test_with_stubtest(self):
        with tempfile.TemporaryDirectory() as folder:
            allowed = Path(folder) / "allowed"
            allowed.write_text("kaya._kaya.Session\nkaya._kaya.Handle(.__init__)?\n")  # their metaclass is pybind11's
            self.check("stubtest", "--mypy-config-file", SOURCE / "pyproject.toml", "--allowlist", str(allowed), "kaya._kaya", "kaya.quantities", cwd=folder,
                       env={**os.environ, "MYPYPATH": str(PACKAGE.parent)})


if __name__ == "__main__":
    unittest.main()
