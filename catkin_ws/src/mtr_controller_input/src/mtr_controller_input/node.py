"""The manual controller's node: sensor_msgs/Joy in, velocity for drive control out."""
# SPDX-License-Identifier: Apache-2.0
from typing import Tuple

import rospy
from sensor_msgs.msg import Joy

from mtr_core import names, schedule
from mtr_lockstep import Ticker, clock, publisher, run_node
from mtr_msgs.msg import VelocityCommand

from .core import velocity
from .parameters import Parameters

NS = 1e-9


class ControllerInputNode:
    """Publishes the wanted velocity while a dead-man button is held, and once more when it is released."""

    def __init__(self, parameters: Parameters):
        self._parameters = parameters
        self._joy: Tuple[int, Joy] = (0, Joy())
        self._was_active = False
        self._velocity = publisher(names.MANUAL_VELOCITY, VelocityCommand)
        self._subscriber = rospy.Subscriber(names.JOY, Joy, self._take, queue_size=1, tcp_nodelay=True)
        self._ticker = Ticker(schedule.CONTROLLER_INPUT)

    def spin(self) -> None:
        """Run until shutdown."""
        while not rospy.is_shutdown():
            self._step(self._ticker.sleep())

    def _step(self, tick: int) -> None:
        taken_ns, joy = self._joy
        wanted = velocity(self._parameters, joy.axes, joy.buttons, max(tick - taken_ns, 0) * NS)
        if wanted.active != self._was_active:
            rospy.loginfo("Manual control %s.", "begins" if wanted.active else "ends")
        if wanted.active or self._was_active:
            message = VelocityCommand(None, *wanted)
            message.header.stamp, message.header.frame_id = clock.stamp_of(tick), names.BASE
            self._velocity.publish(message)
        self._was_active = wanted.active

    def _take(self, message: Joy) -> None:
        # The time of arrival: a receiver whose clock is wrong must not keep an old deflection alive.
        self._joy = (clock.now_ns(), message)


def main() -> int:
    """Run the node; its exit status."""
    return run_node("controller_input", Parameters, ControllerInputNode)
