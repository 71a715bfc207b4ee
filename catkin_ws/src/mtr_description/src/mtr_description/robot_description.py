"""The robot's geometry as the parameter robot_description of the ROS master has it."""
# SPDX-License-Identifier: Apache-2.0
import rospy

from mtr_core import names
from mtr_core.errors import ConfigurationError

from .robot_geometry import RobotGeometry


def described_robot() -> RobotGeometry:
    """Geometry from the parameter; ConfigurationError when it is not set or is no URDF."""
    text = rospy.get_param(names.ROBOT_DESCRIPTION, "")
    if not isinstance(text, str) or not text:
        raise ConfigurationError("Parameter robot_description is not set; allowed is the robot's URDF, which "
                                 "robot.launch loads from mtr_description.")
    return RobotGeometry(text)
