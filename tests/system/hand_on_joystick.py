"""A hand on the manual controller, as its driver would say it: it releases the emergency stop and then rests.

SIGUSR1 has it drive in a circle, or rest again. It speaks every 40 ms of the robot's clock. On a machine that keeps it
waiting the controller counts as lost; therefore it lets go and begins anew again and again, as a person would.
"""
# SPDX-License-Identifier: Apache-2.0
import itertools
import signal
import threading

import rospy
from rosgraph_msgs.msg import Clock
from sensor_msgs.msg import Joy

from mtr_controller_input.parameters import Parameters
from mtr_core import names

AXES, BUTTONS = 8, 12
RELEASE_S, REST_S, DRIVE_S = 1.4, 0.2, 12.0
PERIOD_S = 0.04
# Of full deflection while slow: a circle of 0.8 m.
FORWARD, TURN = 0.6, 0.5


class Hand:
    """Says what is pressed at each instant."""

    def __init__(self) -> None:
        self._parameters = Parameters()
        self._publisher = rospy.Publisher(names.JOY, Joy, queue_size=1, tcp_nodelay=True)
        self._begun_s = self._said_s = -PERIOD_S
        self._tremor = itertools.cycle((0.0, 0.01))
        self._lock = threading.Lock()
        self._drives = False
        signal.signal(signal.SIGUSR1, self._change)
        self._clock = rospy.Subscriber("/clock", Clock, self._take, queue_size=1, tcp_nodelay=True)

    def _change(self, *_: object) -> None:
        self._drives = not self._drives

    def _take(self, clock: Clock) -> None:
        now_s = clock.clock.to_sec()
        with self._lock:
            if now_s - self._said_s < PERIOD_S:
                return
            self._said_s = now_s
            self._begun_s = now_s if self._begun_s < 0.0 else self._begun_s
            elapsed_s = (now_s - self._begun_s) % (RELEASE_S + REST_S + DRIVE_S)
        self._publisher.publish(self._pressed(elapsed_s))

    def _pressed(self, elapsed_s: float) -> Joy:
        joy = Joy(axes=[0.0] * AXES, buttons=[0] * BUTTONS)
        if elapsed_s < RELEASE_S:
            for button in self._parameters.release_buttons:
                joy.buttons[button] = 1
        elif self._drives and elapsed_s > RELEASE_S + REST_S:
            joy.buttons[self._parameters.slow_button] = 1
            joy.axes[self._parameters.linear_axis] = FORWARD + next(self._tremor)
            joy.axes[self._parameters.angular_axis] = TURN
        return joy


if __name__ == "__main__":
    rospy.init_node("hand_on_joystick", disable_rostime=True)
    hand = Hand()
    rospy.spin()
