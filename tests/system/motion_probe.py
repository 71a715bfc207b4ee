"""A hand on the manual controller, and a witness of what moves, on the machine's clock.

Reads one word a line: release, drive or rest. Prints a JSON object ten times a second: x and y in m and lift in m, as
they truly are; locks and message of drive control; joys, the number of messages of the hand.
"""
# SPDX-License-Identifier: Apache-2.0
import json
import sys
import threading
from typing import Any, Dict

import rospy
from nav_msgs.msg import Odometry
from sensor_msgs.msg import Joy

from mtr_controller_input.parameters import Parameters
from mtr_core import names
from mtr_msgs.msg import DriveStatus, FirmwareState

AXES, BUTTONS = 8, 12
JOY_PERIOD_S, REPORT_EVERY = 0.04, 3
FORWARD, TURN, LIFT = 0.6, 0.5, 1.0
# A recording that is played has the same topics.
SIMULATOR, DRIVE_CONTROL = "/simulator", "/drive_control"


def publisher_of(message: Any) -> str:
    """Node that published a received message."""
    return str(message._connection_header["callerid"])


class Probe:
    """Holds the newest of everything."""

    def __init__(self) -> None:
        self._parameters = Parameters()
        self._joy = rospy.Publisher(names.JOY, Joy, queue_size=10, tcp_nodelay=True)
        self.word, self._joys = "rest", 0
        self._seen: Dict[str, Any] = {"x": 0.0, "y": 0.0, "lift": 0.0, "locks": ["not heard"], "message": ""}
        rospy.Subscriber(names.SIM_TRUTH, Odometry, self._take_truth)
        rospy.Subscriber(names.FIRMWARE_STATE, FirmwareState, self._take_lift)
        rospy.Subscriber(names.DRIVE_STATUS, DriveStatus, self._take_drive)
        rospy.Timer(rospy.Duration(JOY_PERIOD_S), self._tick)

    def _take_truth(self, message: Odometry) -> None:
        self._seen.update(x=message.pose.pose.position.x, y=message.pose.pose.position.y)

    def _take_lift(self, message: FirmwareState) -> None:
        if publisher_of(message) == SIMULATOR:
            self._seen.update(lift=message.lift_height_m)

    def _take_drive(self, message: DriveStatus) -> None:
        if publisher_of(message) == DRIVE_CONTROL:
            self._seen.update(locks=message.engaged_locks, message=message.message)

    def _tick(self, _: object) -> None:
        joy = Joy(axes=[0.0] * AXES, buttons=[0] * BUTTONS)
        joy.header.stamp = rospy.Time.now()
        if self.word == "release":
            for button in self._parameters.release_buttons:
                joy.buttons[button] = 1
        elif self.word == "drive":
            joy.buttons[self._parameters.slow_button] = 1
            # A stick in a hand is never quite still.
            joy.axes[self._parameters.linear_axis] = FORWARD + 0.01 * (self._joys % 2)
            joy.axes[self._parameters.angular_axis] = TURN
            joy.axes[self._parameters.lift_axis] = LIFT
        self._joy.publish(joy)
        self._joys += 1
        if self._joys % REPORT_EVERY == 0:
            print(json.dumps({**self._seen, "joys": self._joys}), flush=True)


if __name__ == "__main__":
    rospy.init_node("motion_probe", disable_signals=True)
    probe = Probe()
    for line in sys.stdin:
        probe.word = line.strip()
    threading.Event().wait()
