"""Robots from files without ROS, in particular the robot of this package and its base."""
# SPDX-License-Identifier: Apache-2.0
import functools
import pathlib
import sys
from typing import List, Optional

import rospkg
import xacro
from xacro import substitution_args

from mtr_core.errors import ConfigurationError

from .base_controller import BaseController, base_controller_in
from .robot_geometry import RobotGeometry


def urdf_in(path: pathlib.Path) -> str:
    """Return the URDF text of a file, through xacro as in launch files; ConfigurationError if it is unreadable."""
    # The xacro of PyPI is the ROS 2 version, whose $(find PACKAGE) does not find packages of this workspace.
    substitution_args._eval_find = _package_folder
    try:
        text: str = xacro.process_file(str(path)).toxml()
    except Exception as error:  # In addition to its own errors, xacro passes errors of XML, Python and files.
        reason = str(error).partition("\n")[0]
        raise ConfigurationError(f"{path} cannot be read; allowed is a URDF or a xacro file ({reason}).") from error
    return text


def _package_folder(name: str) -> str:
    try:
        folder: str = rospkg.RosPack().get_path(name)
    except rospkg.ResourceNotFound:
        raise ConfigurationError(f"package {name} is not on ROS_PACKAGE_PATH") from None
    return folder


def main(arguments: Optional[List[str]] = None) -> int:
    """Entry point of rosrun mtr_description urdf FILE: print the URDF; exit status 1 after one sentence on failure."""
    given = sys.argv[1:] if arguments is None else arguments
    if len(given) != 1:
        print("Usage: rosrun mtr_description urdf FILE", file=sys.stderr)
        return 2
    try:
        print(urdf_in(pathlib.Path(given[0])))
    except ConfigurationError as error:
        print(error, file=sys.stderr)
        return 1
    return 0


def _folder() -> pathlib.Path:
    return pathlib.Path(rospkg.RosPack().get_path("mtr_description"))


@functools.lru_cache(maxsize=None)
def shipped_urdf() -> str:
    """Return the text of urdf/robot.urdf.xacro."""
    return urdf_in(_folder() / "urdf" / "robot.urdf.xacro")


@functools.lru_cache(maxsize=None)
def shipped_base() -> BaseController:
    """Return the base of config/jackal_base.yaml."""
    return base_controller_in(shipped_base_file())


def shipped_base_file() -> pathlib.Path:
    """Return the path of this package's base configuration."""
    return _folder() / "config" / "jackal_base.yaml"


@functools.lru_cache(maxsize=None)
def shipped_geometry() -> RobotGeometry:
    """Return the geometry of the robot of this package."""
    return RobotGeometry(shipped_urdf())
