"""The manual controller's node: sensor_msgs/Joy in; velocity, motion lock and way of the lift out."""
# SPDX-License-Identifier: Apache-2.0
import collections
import os
from typing import Deque, Tuple

import rospy
import sensor_msgs.msg

from mtr_core import names, schedule
from mtr_core.lockstep import Ticker, clock, publisher, run_node
from mtr_core.problems import NO_PROBLEM, messages_of
from mtr_core.quiet_log import QuietStart
from mtr_msgs.msg import LiftCommand, MotionLock, Problem, VelocityCommand

from .core import RELEASED, Controller, Joy, Outcome
from .parameters import Parameters

NS = 1e-9
OWNER = "controller_input"


class ControllerInputNode:
    """Publishes the lock at each tick, and what is wanted while a dead-man button is held and once after."""

    def __init__(self, parameters: Parameters):
        self._parameters = parameters
        self._core = Controller(parameters)
        self._messages: Deque[Tuple[int, sensor_msgs.msg.Joy]] = collections.deque(maxlen=100)
        self._before = Outcome()
        self._start, self._said = QuietStart(), (NO_PROBLEM, False)
        self._velocity = publisher(names.MANUAL_VELOCITY, VelocityCommand)
        self._lift = publisher(names.MANUAL_LIFT, LiftCommand)
        self._lock = publisher(names.MOTION_LOCK, MotionLock)
        self._subscriber = rospy.Subscriber(names.JOY, sensor_msgs.msg.Joy, self._take, queue_size=50,
                                            tcp_nodelay=True)
        self._ticker = Ticker(schedule.CONTROLLER_INPUT)

    def spin(self) -> None:
        """Run until shutdown."""
        while not rospy.is_shutdown():
            self._step(self._ticker.sleep())

    def _step(self, tick: int) -> None:
        while self._messages:
            taken_ns, joy = self._messages.popleft()
            self._core.take(Joy(tuple(joy.axes), tuple(joy.buttons)), taken_ns * NS)
        device = self._parameters.device
        outcome = self._core.step(clock.steady_at(tick) * NS, not device or os.path.exists(device))
        self._publish(outcome, tick)
        self._log(outcome)
        self._before = outcome

    def _publish(self, outcome: Outcome, tick: int) -> None:
        stamp = clock.stamp_of(tick)
        lock = MotionLock(owner=OWNER, engaged=bool(outcome.lock_reason), reason=outcome.lock_reason.text,
                          problems=messages_of(outcome.lock_reason, Problem), emergency=True)
        lock.header.stamp = stamp
        self._lock.publish(lock)
        if outcome.velocity.active or self._before.velocity.active:
            message = VelocityCommand(None, *outcome.velocity)
            message.header.stamp, message.header.frame_id = stamp, names.BASE
            self._velocity.publish(message)
        if outcome.lift_mps or self._before.lift_mps:
            lift = LiftCommand(rate_mps=outcome.lift_mps)
            lift.header.stamp = stamp
            self._lift.publish(lift)

    def _log(self, outcome: Outcome) -> None:
        warns = self._start.warns(clock.steady_ns() * NS, is_good=not outcome.lock_reason)
        said = (outcome.lock_reason, warns and bool(outcome.lock_reason))
        if said != self._said:
            log = rospy.logwarn if warns else rospy.loginfo
            log("%s", outcome.lock_reason.text or "The manual controller locks the robot no longer.")
        self._said = said
        if outcome.velocity.active != self._before.velocity.active:
            rospy.loginfo("Manual control %s.", "ends" if outcome.velocity == RELEASED else "begins")

    def _take(self, message: sensor_msgs.msg.Joy) -> None:
        # The time of arrival: a receiver whose clock is wrong must not keep an old deflection alive. On a clock that
        # nobody sets: a controller in the hand is not lost because the robot's clock was.
        self._messages.append((clock.steady_ns(), message))


def main() -> int:
    """Run the node; its exit status."""
    return run_node("controller_input", Parameters, ControllerInputNode)
