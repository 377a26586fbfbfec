"""`pip install --no-build-isolation .`: compiles the engine with CMake, or takes it from the build folder that KAYA_BUILD names."""

import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

from setuptools import Extension, setup
from setuptools.command.build_ext import build_ext

root = Path(__file__).resolve().parent


class Engine(build_ext):
    def run(self):
        build = Path(os.environ.get("KAYA_BUILD") or self.compile())
        to = Path(self.build_lib) / "kaya"
        if self.inplace:
            raise SystemExit("kaya: an editable installation is not supported; put build/release/python into PYTHONPATH")
        to.mkdir(parents=True, exist_ok=True)
        for library in (build / "python/kaya").glob("_kaya*.so"):
            shutil.copy2(library, to)
        for folder in ("joints", "zones"):
            shutil.copytree(build / folder, to / folder, dirs_exist_ok=True)

    def compile(self):
        build = Path(self.build_temp).resolve()
        subprocess.check_call(["cmake", "-S", root, "-B", build, "-G", "Ninja", "-DCMAKE_BUILD_TYPE=Release", "-DKAYA_TESTS=OFF",
                               "-DKAYA_PAINTER=OFF", "-DKAYA_TOGETHER=ON", f"-DPython3_EXECUTABLE={sys.executable}"])
        subprocess.check_call(["cmake", "--build", build, "--target", "kaya_python", "program"])
        return build


setup(version=re.search(r"project\(kaya VERSION ([0-9.]+)", (root / "CMakeLists.txt").read_text()).group(1),
      packages=["kaya"], package_dir={"kaya": "stdlib/python/kaya"}, package_data={"kaya": ["py.typed", "*.pyi"]},
      ext_modules=[Extension("kaya._kaya", [])], cmdclass={"build_ext": Engine})
