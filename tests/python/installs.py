#!/usr/bin/env python3
"""installs.py PROGRAM: pip installs the package into a new environment, without a network, from the present build."""

import os
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

build, source = Path(sys.argv[1]).parent, Path(__file__).resolve().parents[2]
try:
    import ensurepip  # noqa: F401
    import numpy  # noqa: F401
    import setuptools  # noqa: F401
except ImportError as missing:
    print(f"skipped: {missing.name} is not installed")
    sys.exit(77)
with tempfile.TemporaryDirectory() as folder:
    package = Path(folder) / "package"
    package.mkdir()
    for name in ("setup.py", "pyproject.toml", "CMakeLists.txt"): # the sources are not needed: KAYA_BUILD is complete
        shutil.copy(source / name, package)
    shutil.copytree(source / "stdlib/python", package / "stdlib/python")
    environment = {name: value for name, value in os.environ.items() if name != "PYTHONPATH"} | {"KAYA_BUILD": str(build)}
    subprocess.run([sys.executable, "-m", "venv", "--system-site-packages", f"{folder}/venv"], check=True)
    python = f"{folder}/venv/bin/python"
    subprocess.run([python, "-m", "pip", "install", "--quiet", "--no-index", "--no-deps", "--no-build-isolation", package],
                   check=True, env=environment)
    said = subprocess.run([python, "-c", """
import kaya
m = kaya.Model()
m.command("poly brick 0 1 0 1 0 1")
print(m.blocks["volume"], kaya.__file__)
m.command("jset dip 30 org .5 .5 .5\\nprop mat 1 dens 1\\nprop jmat 1 jkn 1e9 jks 1e9 jfric 30\\ngravity 0 0 -10\\ncycle 1")
"""], check=True, env=environment, cwd=folder, capture_output=True, text=True).stdout
    assert said.startswith("[1.]") and f"{folder}/venv" in said, said
    print(said)
