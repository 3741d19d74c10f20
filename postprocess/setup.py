"""Builds theory and atlas for Python with CMake; everything else stands in pyproject.toml.

    pip install --no-build-isolation ./postprocess

A compiler, CMake, pybind11 and their libraries (Boost, TBB, NLopt, Eigen, fmt) must be installed; src/manual/machines.md names their packages.
"""

import subprocess
import sys
from pathlib import Path

from setuptools import Extension, setup
from setuptools.command.build_ext import build_ext

SOURCE = Path(__file__).parent.resolve()


class BuildWithCMake(build_ext):  # type: ignore[misc]
    """CMake knows the sources and what they are compiled with."""

    def build_extension(self, ext: Extension) -> None:
        target = Path(self.get_ext_fullpath(ext.name)).resolve().parent
        build = Path(self.build_temp).resolve()
        subprocess.run(["cmake", "-S", SOURCE, "-B", build, f"-DPython_EXECUTABLE={sys.executable}", f"-DPYTHON_EXECUTABLE={sys.executable}",
                        f"-DCMAKE_LIBRARY_OUTPUT_DIRECTORY={target}"], check=True)  # fmt: skip
        subprocess.run(["cmake", "--build", build, "--parallel", "2", "--target", "_vibrotrough_theory"], check=True)


setup(ext_modules=[Extension("vibrotrough._theory", sources=[])], cmdclass={"build_ext": BuildWithCMake})
