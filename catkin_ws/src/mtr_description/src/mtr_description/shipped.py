"""The robot that this package describes, for tests, benchmarks and the simulation without ROS."""
# SPDX-License-Identifier: Apache-2.0
import functools
import pathlib

import rospkg
import xacro

from .robot_geometry import RobotGeometry


def shipped_urdf() -> str:
    """Text of urdf/robot.urdf.xacro as launch files load it."""
    path = pathlib.Path(rospkg.RosPack().get_path("mtr_description")) / "urdf" / "robot.urdf.xacro"
    text: str = xacro.process_file(str(path)).toxml()
    return text


@functools.lru_cache(maxsize=None)
def shipped_geometry() -> RobotGeometry:
    """Geometry of that robot."""
    return RobotGeometry(shipped_urdf())
