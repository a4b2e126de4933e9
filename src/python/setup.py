"""Builds the extension module by CMake, from the folder of the whole project.

CMAKE_ARGS in the environment gives more options, such as -DPERILINK_NATIVE=OFF for a wheel that is
to run on other machines.
"""

import os
import re
import shlex
import subprocess
import sys
from pathlib import Path

from setuptools import Extension, setup
from setuptools.command.build_ext import build_ext

ROOT = Path(__file__).resolve().parents[2]
VERSION = re.search(r"project\(perilink VERSION ([0-9.]+)", (ROOT / "CMakeLists.txt").read_text())


class CMakeBuild(build_ext):
    def build_extension(self, ext):
        build = ROOT / "build" / "pip"  # apart from the sources
        subprocess.run(
            ["cmake", "-S", ROOT, "-B", build, "-DCMAKE_BUILD_TYPE=Release",
             "-DCMAKE_UNITY_BUILD=ON", "-DPERILINK_PYTHON=ON", "-DPERILINK_TESTS=OFF",
             "-DPERILINK_BENCHMARKS=OFF", "-DPERILINK_MPI=OFF",
             f"-DPython3_EXECUTABLE={sys.executable}",
             *shlex.split(os.environ.get("CMAKE_ARGS", ""))],
            check=True)
        subprocess.run(["cmake", "--build", build, "--target", "perilink_python",
                        "--parallel", str(os.cpu_count())], check=True)
        target = Path(self.get_ext_fullpath(ext.name))
        target.parent.mkdir(parents=True, exist_ok=True)
        self.copy_file(next((build / "python/perilink").glob("_core*.so")), target)


setup(version=VERSION.group(1), ext_modules=[Extension("perilink._core", [])],
      cmdclass={"build_ext": CMakeBuild})
