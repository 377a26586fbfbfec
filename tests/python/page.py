#!/usr/bin/env python3
"""page.py PROGRAM: the examples of docs/python.md run, one after the other."""

import os
import re
import sys
import tempfile
from pathlib import Path

try:
    import numpy  # noqa: F401
except ImportError:
    print("skipped: numpy is not installed")
    sys.exit(77)
page = (Path(__file__).resolve().parents[2] / "docs/python.md").read_text()
os.chdir(tempfile.mkdtemp())
blocks, names = re.findall(r"```python\n(.*?)```", page, re.S), {}
assert len(blocks) >= 6
for block in blocks:
    exec(compile(block, "docs/python.md", "exec"), names)
assert len(names["heights"]) == 10 and names["m"].cycle_number == 300
