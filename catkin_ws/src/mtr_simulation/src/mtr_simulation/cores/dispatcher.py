"""The dispatcher between its core, the application and the other parts, as mtr_dispatcher's node in lock-step."""
# SPDX-License-Identifier: Apache-2.0
from typing import Callable, Deque, Optional

from mtr_core.liveness import NS
from mtr_core.schedule import DISPATCHER
from mtr_dispatcher.area.keeper import AreaKeeper
from mtr_dispatcher.area.order import AreaOrder
from mtr_dispatcher.conversions import desired_message, lock_message
from mtr_dispatcher.core import Dispatcher
from mtr_dispatcher.parameters import Parameters
from mtr_dispatcher.status.builder import Identity
from mtr_dispatcher.status.emergency import EmergencyWatch
from mtr_dispatcher.status.inputs import STALE_AFTER_S, Inputs
from mtr_msgs.msg import MotionLock

from . import wire
from .topics import Topics


class NoArea(AreaKeeper):
    """Accepts no test area: drive control in one process does not enforce one, and Status must not say that it does."""

    def take(self, session_id: int, order: Optional[AreaOrder]) -> None:
        """See AreaKeeper."""


class DispatcherPart:
    """Says a Status at each tick, and once it is answered what the robot shall do."""

    slot = DISPATCHER

    def __init__(self, topics: Topics, parameters: Parameters, identity: Identity,
                 lock: Callable[[MotionLock], None]):
        """lock: takes its reason to stand still."""
        self._core, self._parameters = Dispatcher(parameters, identity, NoArea(required=False)), parameters
        self._topics, self._lock = topics, lock
        self._emergency = EmergencyWatch(parameters.emergency_stop)
        self._inputs = (topics.pose.input(lag_ns=0), topics.car.input(), topics.mode.input(),
                        topics.peripherals.input(), topics.check.input(), topics.drive.input(), topics.motion.input())

    def status(self, tick_ns: int) -> bytes:
        """The Status of a tick, without the picture of what the LiDARs see and without the robot's log."""
        pose, car, mode, peripherals, check, drive, motion = (
            each.fresh_at(tick_ns, STALE_AFTER_S) for each in self._inputs)
        now_s = tick_ns * NS
        return self._core.status(Inputs(now_s, pose, car, mode, peripherals, check, drive, motion, now_s, 0,
                                        self._emergency.at(now_s)))

    def answer(self, tick_ns: int, commands: Deque[bytes]) -> None:
        """The application's answers to the Status of that tick; the robot goes on with what they ask for."""
        while commands:
            self._core.receive(commands.popleft(), tick_ns * NS)
        desired, stamp = self._core.desired(tick_ns * NS), wire.stamp(tick_ns)
        self._lock(lock_message(desired, stamp))
        self._topics.desired.publish(wire.desired(desired_message(desired, stamp, self._parameters.default_speed_mps)))
