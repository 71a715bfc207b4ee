"""A hand on the manual controller, as its driver would say it: it releases the emergency stop and then rests.

SIGUSR1 has it drive in a circle, or rest again. It speaks every 40 ms of the robot's clock, and in lock-step the clock
waits until it has been heard.
"""
# SPDX-License-Identifier: Apache-2.0
import itertools
import signal

import rospy
from rosgraph_msgs.msg import Clock
from sensor_msgs.msg import Joy

from mtr_controller_input.parameters import Parameters
from mtr_core import names
from mtr_core.lockstep import direct_publisher
from mtr_core.lockstep.clock import stamp_of
from mtr_core.schedule import CONTROLLER_INPUT, MILLISECOND_NS

AXES, BUTTONS = 8, 12
# It says the release for longer than it takes: what it says first is not waited for.
RELEASE_NS = 1600 * MILLISECOND_NS
# Of full deflection while slow: a circle of 0.8 m.
FORWARD, TURN = 0.6, 0.5


class Hand:
    """Says what is pressed at each instant."""

    def __init__(self) -> None:
        self._parameters = Parameters()
        # Without a queue: no word is left out.
        self._publisher = direct_publisher(names.JOY, Joy)
        self._begun_ns = self._said_ns = 0
        self._tremor = itertools.cycle((0.0, 0.01))
        self._drives = False
        signal.signal(signal.SIGUSR1, self._change)
        self._clock = rospy.Subscriber("/clock", Clock, self._take, queue_size=50, tcp_nodelay=True)

    def _change(self, *_: object) -> None:
        self._drives = not self._drives

    def _take(self, clock: Clock) -> None:
        now_ns = clock.clock.to_nsec()
        if now_ns - self._said_ns < CONTROLLER_INPUT.period_ns or not self._publisher.get_num_connections():
            return
        self._said_ns = now_ns
        self._begun_ns = self._begun_ns or now_ns
        joy = self._pressed(is_released=now_ns - self._begun_ns > RELEASE_NS)
        joy.header.stamp = stamp_of(now_ns)
        self._publisher.publish(joy)

    def _pressed(self, is_released: bool) -> Joy:
        joy = Joy(axes=[0.0] * AXES, buttons=[0] * BUTTONS)
        if not is_released:
            for button in self._parameters.release_buttons:
                joy.buttons[button] = 1
        elif self._drives:
            joy.buttons[self._parameters.slow_button] = 1
            joy.axes[self._parameters.linear_axis] = FORWARD + next(self._tremor)
            joy.axes[self._parameters.angular_axis] = TURN
        return joy


if __name__ == "__main__":
    rospy.init_node("hand_on_joystick", disable_rostime=True)
    hand = Hand()
    rospy.spin()
