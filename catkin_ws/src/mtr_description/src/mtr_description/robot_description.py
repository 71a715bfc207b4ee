"""Geometry of the robot from the ROS parameter robot_description."""
# SPDX-License-Identifier: Apache-2.0
import rospy

from mtr_core import names
from mtr_core.errors import ConfigurationError

from .robot_geometry import RobotGeometry


def described_robot() -> RobotGeometry:
    """Return the geometry; ConfigurationError if the parameter is unset or not a URDF."""
    text = rospy.get_param(names.ROBOT_DESCRIPTION, "")
    if not isinstance(text, str) or not text:
        raise ConfigurationError("Parameter robot_description is not set; allowed is the robot's URDF, which "
                                 "robot.launch loads from mtr_description.")
    return RobotGeometry(text)
