"""Builds the extension module with CMake. scikit-build-core would do this too, but Debian 12 does not have it."""

import os
import re
import subprocess
import sys
from pathlib import Path

from setuptools import Extension, setup
from setuptools.command.build_ext import build_ext

TREE = Path(__file__).resolve().parent.parent
VERSION = re.search(r'define JAWARI_VERSION "([0-9.]+)"', (TREE / "engine/include/jawari/version.h").read_text()).group(1)


class BuildWithCMake(build_ext):
    def run(self):
        build = Path(self.build_temp).resolve()
        package = Path(self.build_lib).resolve()
        if self.inplace:
            package = Path(__file__).resolve().parent
        options = ["BUILD_LIVE", "BUILD_PLUGINS", "BUILD_LV2", "BUILD_TESTS", "BUILD_BENCHMARKS"]
        subprocess.check_call([
            "cmake", "-S", str(TREE), "-B", str(build), "-G", "Ninja", "-DCMAKE_BUILD_TYPE=Release",
            "-DJAWARI_BUILD_PYTHON=ON", f"-DPYTHON_EXECUTABLE={sys.executable}", f"-DJAWARI_PYTHON_INSTALL_DIR={package}",
            *[f"-DJAWARI_{option}=OFF" for option in options],
        ])  # fmt: skip
        jobs = os.environ.get("CMAKE_BUILD_PARALLEL_LEVEL", str(os.cpu_count()))
        subprocess.check_call(["cmake", "--build", str(build), "--target", "jawari_python", "-j", jobs])
        subprocess.check_call(["cmake", "--install", str(build), "--component", "python"])


setup(
    version=VERSION,
    packages=[],  # all files are installed by CMake
    ext_modules=[Extension("jawari._core", [])],
    cmdclass={"build_ext": BuildWithCMake},
)
