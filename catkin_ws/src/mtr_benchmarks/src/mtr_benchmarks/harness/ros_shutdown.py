"""Shuts down the ROS node of this process."""
# SPDX-License-Identifier: Apache-2.0
import contextlib

import rospy


def shut_down(reason: str) -> None:
    """Call rospy.signal_shutdown; ignore its failure on Debian 11."""
    # The rospy of Debian 11 uses thread attributes that Python 3.9 has removed.
    with contextlib.suppress(AttributeError):
        rospy.signal_shutdown(reason)
