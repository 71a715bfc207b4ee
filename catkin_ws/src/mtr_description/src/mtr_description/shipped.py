"""Robots from files, above all the one that this package describes, and its base: for what runs without ROS."""
# SPDX-License-Identifier: Apache-2.0
import functools
import pathlib

import rospkg
import xacro

from mtr_core.errors import ConfigurationError

from .base_controller import BaseController, base_controller_in
from .robot_geometry import RobotGeometry


def urdf_in(path: pathlib.Path) -> str:
    """URDF text of a file, through xacro as launch files do it; ConfigurationError when it cannot be read."""
    try:
        text: str = xacro.process_file(str(path)).toxml()
    except Exception as error:  # Beside its own errors xacro lets through those of XML, of Python and of files.
        raise ConfigurationError(f"{path} cannot be read; allowed is a URDF or a xacro file ({error}).") from error
    return text


def _folder() -> pathlib.Path:
    return pathlib.Path(rospkg.RosPack().get_path("mtr_description"))


@functools.lru_cache(maxsize=None)
def shipped_urdf() -> str:
    """Text of urdf/robot.urdf.xacro."""
    return urdf_in(_folder() / "urdf" / "robot.urdf.xacro")


@functools.lru_cache(maxsize=None)
def shipped_base() -> BaseController:
    """The base of config/jackal_base.yaml."""
    return base_controller_in(shipped_base_file())


def shipped_base_file() -> pathlib.Path:
    """The base's configuration of this package."""
    return _folder() / "config" / "jackal_base.yaml"


@functools.lru_cache(maxsize=None)
def shipped_geometry() -> RobotGeometry:
    """Geometry of that robot."""
    return RobotGeometry(shipped_urdf())
