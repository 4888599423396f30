# SPDX-FileCopyrightText: 2026 The lightstripe authors
# SPDX-License-Identifier: Apache-2.0
"""Builds lightstripe._core by CMake for the Python that runs this; everything else stands in pyproject.toml.

LIGHTSTRIPE_BUILD names an existing build folder, so that nothing is compiled twice.
"""
import os
import pathlib
import re
import subprocess
import sys

from setuptools import Extension, setup
from setuptools.command.build_ext import build_ext

SOURCE = pathlib.Path(__file__).resolve().parent


def version():
    return re.search(r"project\(lightstripe VERSION ([\d.]+)", (SOURCE / "CMakeLists.txt").read_text()).group(1)


class CMakeBuild(build_ext):
    def build_extension(self, ext):
        package = pathlib.Path(self.get_ext_fullpath(ext.name)).resolve().parent
        build = os.environ.get("LIGHTSTRIPE_BUILD")
        if build is None:
            build = str(pathlib.Path(self.build_temp).resolve())
            subprocess.run(["cmake", "-G", "Ninja", "-S", SOURCE, "-B", build, "-DCMAKE_BUILD_TYPE=Release", "-DLIGHTSTRIPE_UNITY=ON",
                            "-DLIGHTSTRIPE_APPS=OFF", "-DLIGHTSTRIPE_TESTS=OFF", "-DLIGHTSTRIPE_EXAMPLES=OFF",
                            f"-DPython_EXECUTABLE={sys.executable}"], check=True)
        subprocess.run(["cmake", "--build", build, "--target", "lightstripe_python"], check=True)
        package.mkdir(parents=True, exist_ok=True)
        for library in (pathlib.Path(build) / "python/lightstripe").glob("_core*"):
            self.copy_file(str(library), str(package / library.name))


setup(version=version(), ext_modules=[Extension("lightstripe._core", sources=[])], cmdclass={"build_ext": CMakeBuild})
