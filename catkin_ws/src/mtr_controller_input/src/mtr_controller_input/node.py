"""The manual controller's node: sensor_msgs/Joy in; velocity, motion lock and lift rate out."""
# SPDX-License-Identifier: Apache-2.0
import collections
import time
from typing import Deque, List, NamedTuple, Optional

import rospy
import sensor_msgs.msg

from mtr_core import names, schedule
from mtr_core.liveness import NS, Instant, steady_stamp_ns
from mtr_core.lockstep import PublisherWatch, StampedQueue, Ticker, clock, publisher, run_node
from mtr_core.problems import NO_PROBLEM, Problem, messages_of
from mtr_core.quiet_log import QuietStart
from mtr_msgs.msg import LiftCommand, MotionLock, VelocityCommand
from mtr_msgs.msg import Problem as ProblemMessage

from . import problems
from .core import RELEASED, UNKNOWN_AGE_S, Controller, Joy, Outcome
from .parameters import Parameters
from .presence.presence import Presence

OWNER = "controller_input"
KEPT = 100
# A restarted node publishes the released state for this many ticks, which ends the claim of its predecessor.
RELEASED_TICKS = 50
# A driver has no slot in the schedule; within one period it has published at any phase.
LOCKSTEP_LAG_NS = schedule.CONTROLLER_INPUT.period_ns


class ReceivedJoy(NamedTuple):
    """A message of the driver.

    Attributes:
        received_ns: arrival on the steady clock.
        age_s: age at the arrival, by its stamp; NaN for a driver without stamps.
    """

    received_ns: int
    age_s: float
    message: sensor_msgs.msg.Joy


class ArrivedJoys:
    """Messages of the permitted driver, each with its arrival time.

    The times are of the steady clock, so that a step of the robot's clock does not cause a loss of the controller.
    """

    def __init__(self, watch: PublisherWatch) -> None:
        self._watch = watch
        self._before: Optional[Instant] = None
        self._messages: Deque[ReceivedJoy] = collections.deque(maxlen=KEPT)
        self._subscriber = rospy.Subscriber(names.JOY, sensor_msgs.msg.Joy, self._take_in, queue_size=50,
                                            tcp_nodelay=True)

    def take(self, _: int) -> List[ReceivedJoy]:
        """Return the messages since the last call, oldest first."""
        return [self._messages.popleft() for _ in range(len(self._messages))]

    def _take_in(self, message: sensor_msgs.msg.Joy) -> None:
        if not self._watch.permits(names.JOY, message):
            return
        now, stamp_ns = clock.reading(), message.header.stamp.to_nsec()
        age_s = (now.steady_ns - steady_stamp_ns(stamp_ns, now, self._before)) * NS if stamp_ns else UNKNOWN_AGE_S
        self._before = now
        self._messages.append(ReceivedJoy(now.steady_ns, age_s, message))


class DueJoys:
    """The lock-step variant: waits for the messages that are due at a tick, and uses their stamps.

    Delays on a busy machine have no effect, and it does not wait for a driver that is gone.
    """

    def __init__(self) -> None:
        self._queue = StampedQueue(names.JOY, sensor_msgs.msg.Joy, schedule.CONTROLLER_INPUT, LOCKSTEP_LAG_NS)

    def take(self, tick_ns: int) -> List[ReceivedJoy]:
        """Return the messages that are due since the last call, oldest first."""
        stamped = ((message.header.stamp.to_nsec(), message) for message in self._queue.take(tick_ns))
        return [ReceivedJoy(stamp_ns, (tick_ns - stamp_ns) * NS, message) for stamp_ns, message in stamped]


class ControllerInputNode:
    """Publishes the lock at each tick, the velocity at the start, while a dead-man button is held, and once after."""

    def __init__(self, parameters: Parameters):
        self._parameters = parameters
        self._core = Controller(parameters)
        self._before = Outcome()
        self._released_ticks = RELEASED_TICKS
        self._start, self._said = QuietStart(), (NO_PROBLEM, False)
        self._velocity = publisher(names.MANUAL_VELOCITY, VelocityCommand)
        self._lift = publisher(names.MANUAL_LIFT, LiftCommand)
        self._lock = publisher(names.MOTION_LOCK, MotionLock)
        self._watch = PublisherWatch({names.JOY: parameters.driver})
        self._presence = Presence(parameters.device, parameters.heartbeat_after_s)
        self._newest, self._is_unwatched = Joy((), ()), False
        self._joys = DueJoys() if clock.is_lockstep() else ArrivedJoys(self._watch)
        self._ticker = Ticker(schedule.CONTROLLER_INPUT)

    def spin(self) -> None:
        """Run until shutdown."""
        while not rospy.is_shutdown():
            self._step(self._ticker.sleep())

    def _step(self, tick: int) -> None:
        before = self._newest
        for received_ns, age_s, joy in self._joys.take(tick):
            self._newest = Joy(tuple(joy.axes), tuple(joy.buttons))
            self._core.take(self._newest, received_ns * NS, age_s)
        is_present = self._presence.update(time.monotonic(), is_idle=self._newest == before)
        outcome = self._core.step(clock.steady_at(tick) * NS, is_present, self._intrusion())
        self._publish(outcome, tick)
        self._log(outcome)
        self._before = outcome

    def _intrusion(self) -> Problem:
        intruder = self._watch.intruder
        return problems.SECOND_PUBLISHER(**intruder._asdict()) if intruder else NO_PROBLEM

    def _publish(self, outcome: Outcome, tick: int) -> None:
        stamp = clock.stamp_of(tick)
        lock = MotionLock(owner=OWNER, engaged=bool(outcome.lock_reason), reason=outcome.lock_reason.text,
                          problems=messages_of(outcome.lock_reason, ProblemMessage), emergency=True)
        lock.header.stamp = stamp
        self._lock.publish(lock)
        self._released_ticks = max(0, self._released_ticks - 1)
        if outcome.velocity.active or self._before.velocity.active or self._released_ticks:
            message = VelocityCommand(None, *outcome.velocity)
            message.header.stamp, message.header.frame_id = stamp, names.BASE
            self._velocity.publish(message)
        if outcome.lift_mps or self._before.lift_mps:
            lift = LiftCommand(rate_mps=outcome.lift_mps)
            lift.header.stamp = stamp
            self._lift.publish(lift)

    def _log(self, outcome: Outcome) -> None:
        if self._presence.is_unwatched and not self._is_unwatched:
            rospy.logwarn("%s", problems.UNWATCHED())
        self._is_unwatched = self._presence.is_unwatched
        warns = self._start.warns(clock.steady_ns() * NS, is_good=not outcome.lock_reason)
        said = (outcome.lock_reason, warns and bool(outcome.lock_reason))
        if said != self._said:
            log = rospy.logwarn if warns else rospy.loginfo
            log("%s", outcome.lock_reason.text or "The manual controller locks the robot no longer.")
        self._said = said
        if outcome.velocity.active != self._before.velocity.active:
            rospy.loginfo("Manual control %s.", "ends" if outcome.velocity == RELEASED else "begins")


def main() -> int:
    """Run the node and return its exit status."""
    return run_node("controller_input", Parameters, ControllerInputNode)
