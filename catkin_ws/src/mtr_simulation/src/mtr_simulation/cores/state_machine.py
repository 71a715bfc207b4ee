"""The state machine between its core and the other parts, as mtr_state_machine's node."""
# SPDX-License-Identifier: Apache-2.0
from typing import Callable

from mtr_core.liveness import NS
from mtr_core.schedule import STATE_MACHINE
from mtr_msgs.msg import MotionLock
from mtr_state_machine.conversions import lock_message, mode_message, observation
from mtr_state_machine.core import StateMachine
from mtr_state_machine.observation import Part
from mtr_state_machine.parameters import Parameters

from . import wire
from .topics import Topics


class StateMachinePart:
    """Decides at each tick of its slot."""

    slot = STATE_MACHINE

    def __init__(self, topics: Topics, parameters: Parameters, lock: Callable[[MotionLock], None]):
        """lock: takes its reason to stand still."""
        self._core, self._topics, self._lock = StateMachine(parameters), topics, lock
        self._inputs = {
            Part.DISPATCHER: topics.desired.input(), Part.LOCALIZATION: topics.pose.input(lag_ns=0),
            Part.CAR_LOCATOR: topics.car.input(), Part.MOTION_PLANNER: topics.motion.input(),
            Part.DRIVE_CONTROL: topics.drive.input(), Part.PERIPHERALS: topics.peripherals.input()}
        self._check = topics.check.input()

    def step(self, tick_ns: int) -> None:
        """One tick."""
        messages = {part: each.at(tick_ns) for part, each in self._inputs.items()}
        ages_s = {part: each.age_s(tick_ns) for part, each in self._inputs.items()}
        decision = self._core.step(observation(messages, self._check.at(tick_ns), ages_s, tick_ns * NS))
        stamp = wire.stamp(tick_ns)
        self._lock(lock_message(decision, stamp))
        self._topics.mode.publish(mode_message(decision, stamp))
