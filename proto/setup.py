"""Builds mtr_proto for pip, and declares its Python package for catkin.

For pip the module is generated from robot_link.proto; catkin's CMakeLists.txt generates it in the source tree.
"""
# SPDX-License-Identifier: Apache-2.0
import importlib.metadata
import importlib.util
import pathlib
import subprocess
import sys
from xml.etree import ElementTree

from setuptools import setup
from setuptools.command.build_py import build_py

FOLDER = pathlib.Path(__file__).resolve().parent
PACKAGE = ElementTree.parse(str(FOLDER / "package.xml"))


class BuildWithSchema(build_py):
    """Generates the module in the copied package."""

    def run(self):
        """See build_py."""
        build_py.run(self)
        target = str(pathlib.Path(self.build_lib) / "mtr_proto")
        subprocess.run([*compiler(), "--proto_path=" + str(FOLDER), "--python_out=" + target, "robot_link.proto"],
                       check=True)


def has_own_compiler():
    """Return True in pip's build environment."""
    return importlib.util.find_spec("grpc_tools") is not None


def compiler():
    """Return protoc of pip's build environment, or the system's."""
    return [sys.executable, "-m", "grpc_tools.protoc"] if has_own_compiler() else ["protoc"]


def protobuf():
    """Return the protobuf requirement for the generated module: not older, of the same or the next major version."""
    if not has_own_compiler():
        return "protobuf>=3.12"
    version = importlib.metadata.version("protobuf")
    return "protobuf>={},<{}".format(version, int(version.split(".")[0]) + 2)


setup(
    name="mtr_proto",
    version=PACKAGE.findtext("version"),
    description=PACKAGE.findtext("description"),
    license=PACKAGE.findtext("license"),
    packages=["mtr_proto"],
    package_dir={"": "src"},
    python_requires=">=3.8",
    # mtr_proto/pairing.py explains the use of spake2, and that it is optional.
    install_requires=[protobuf(), "spake2>=0.8"],
    cmdclass={"build_py": BuildWithSchema},
)
