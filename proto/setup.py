"""Builds mtr_proto for pip, and tells catkin where its Python package lies.

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
    """Generates the module beside the copied package."""

    def run(self):
        """See build_py."""
        build_py.run(self)
        target = str(pathlib.Path(self.build_lib) / "mtr_proto")
        subprocess.run([*compiler(), "--proto_path=" + str(FOLDER), "--python_out=" + target, "robot_link.proto"],
                       check=True)


def has_own_compiler():
    """True in the build environment that pip makes."""
    return importlib.util.find_spec("grpc_tools") is not None


def compiler():
    """protoc of pip's build environment, else the system's."""
    return [sys.executable, "-m", "grpc_tools.protoc"] if has_own_compiler() else ["protoc"]


def protobuf():
    """The protobuf that runs what the compiler generates: not older, and of the same major version or the next one."""
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
    # What spake2 is for, and that it may lack: mtr_proto/pairing.py.
    install_requires=[protobuf(), "spake2>=0.8"],
    cmdclass={"build_py": BuildWithSchema},
)
