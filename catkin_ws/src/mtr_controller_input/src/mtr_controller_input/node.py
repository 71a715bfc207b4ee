"""The manual controller's node: sensor_msgs/Joy in, velocity for drive control out."""
# SPDX-License-Identifier: Apache-2.0
from dataclasses import asdict
from typing import Tuple

import rospy
from sensor_msgs.msg import Joy

from mtr_core import names, schedule
from mtr_core.errors import RobotError
from mtr_lockstep import Ticker, clock
from mtr_msgs.msg import VelocityCommand

from .core import velocity
from .parameters import Parameters, parameters_from

JOY = "/joy"
NS = 1e-9


class ControllerInputNode:
    """Publishes the wanted velocity while a dead-man button is held, and once more when it is released."""

    def __init__(self, parameters: Parameters):
        self._parameters = parameters
        self._joy: Tuple[int, Joy] = (0, Joy())
        self._was_active = False
        self._velocity = rospy.Publisher(names.MANUAL_VELOCITY, VelocityCommand, queue_size=10, tcp_nodelay=True)
        self._subscriber = rospy.Subscriber(JOY, Joy, self._take, queue_size=1, tcp_nodelay=True)
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
    """Start the node and run it; the exit status says whether it could start."""
    rospy.init_node("controller_input")
    try:
        parameters = parameters_from(rospy.get_param("~", {}))
        rospy.loginfo("Controller input: %s", asdict(parameters))
        ControllerInputNode(parameters).spin()
    except RobotError as error:
        rospy.logfatal("The manual controller's node did not start. %s", error)
        return 2
    except rospy.ROSInterruptException:
        pass
    return 0
