"""Checks for a ROS master before a program joins the graph."""
# SPDX-License-Identifier: Apache-2.0
import socket

import rospy

TIMEOUT_S = 3.0


def master_answers() -> bool:
    """Return True if a master answers at ROS_MASTER_URI."""
    before = socket.getdefaulttimeout()
    socket.setdefaulttimeout(TIMEOUT_S)
    try:
        rospy.get_master().getPid()
    except (OSError, ValueError, rospy.ROSException):
        return False
    finally:
        socket.setdefaulttimeout(before)
    return True
