"""The manual controller's node: sensor_msgs/Joy in; velocity, motion lock and way of the lift out."""
# SPDX-License-Identifier: Apache-2.0
import collections
import os
from typing import Deque, List, Tuple

import rospy
import sensor_msgs.msg

from mtr_core import names, schedule
from mtr_core.lockstep import StampedQueue, Ticker, clock, publisher, run_node
from mtr_core.problems import NO_PROBLEM, messages_of
from mtr_core.quiet_log import QuietStart
from mtr_msgs.msg import LiftCommand, MotionLock, Problem, VelocityCommand

from .core import RELEASED, Controller, Joy, Outcome
from .parameters import Parameters

NS = 1e-9
OWNER = "controller_input"
KEPT = 100
# A driver speaks in no slot of the schedule: within a period it has said something at any phase.
LOCKSTEP_LAG_NS = schedule.CONTROLLER_INPUT.period_ns


class ArrivedJoys:
    """What the driver says, each message with the time at which it arrived.

    A receiver whose clock is wrong must not keep an old deflection alive. On a clock that nobody sets: a controller in
    the hand is not lost because the robot's clock was.
    """

    def __init__(self) -> None:
        self._messages: Deque[Tuple[int, sensor_msgs.msg.Joy]] = collections.deque(maxlen=KEPT)
        self._subscriber = rospy.Subscriber(names.JOY, sensor_msgs.msg.Joy, self._take_in, queue_size=50,
                                            tcp_nodelay=True)

    def take(self, _: int) -> List[Tuple[int, sensor_msgs.msg.Joy]]:
        """Messages that have not been taken, oldest first, with their times in ns."""
        return [self._messages.popleft() for _ in range(len(self._messages))]

    def _take_in(self, message: sensor_msgs.msg.Joy) -> None:
        self._messages.append((clock.steady_ns(), message))


class DueJoys:
    """The same in lock-step: the messages that are due at a tick, for which it waits, with their stamps.

    How long they were under way on a busy machine does not count; a driver that is gone is not waited for.
    """

    def __init__(self) -> None:
        self._queue = StampedQueue(names.JOY, sensor_msgs.msg.Joy, schedule.CONTROLLER_INPUT, LOCKSTEP_LAG_NS)

    def take(self, tick_ns: int) -> List[Tuple[int, sensor_msgs.msg.Joy]]:
        """Messages that are due and have not been taken, oldest first, with their times in ns."""
        return [(message.header.stamp.to_nsec(), message) for message in self._queue.take(tick_ns)]


class ControllerInputNode:
    """Publishes the lock at each tick, and what is wanted while a dead-man button is held and once after."""

    def __init__(self, parameters: Parameters):
        self._parameters = parameters
        self._core = Controller(parameters)
        self._before = Outcome()
        self._start, self._said = QuietStart(), (NO_PROBLEM, False)
        self._velocity = publisher(names.MANUAL_VELOCITY, VelocityCommand)
        self._lift = publisher(names.MANUAL_LIFT, LiftCommand)
        self._lock = publisher(names.MOTION_LOCK, MotionLock)
        self._joys = DueJoys() if clock.is_lockstep() else ArrivedJoys()
        self._ticker = Ticker(schedule.CONTROLLER_INPUT)

    def spin(self) -> None:
        """Run until shutdown."""
        while not rospy.is_shutdown():
            self._step(self._ticker.sleep())

    def _step(self, tick: int) -> None:
        for taken_ns, joy in self._joys.take(tick):
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


def main() -> int:
    """Run the node; its exit status."""
    return run_node("controller_input", Parameters, ControllerInputNode)
