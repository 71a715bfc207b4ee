"""Robot link and Car link of the application to the radio world."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import math
from collections import deque

from mtr_operator.domain.assistance import OUTPUT, HandlePort
from mtr_operator.domain.interfaces.car_bus import CarEquipment
from mtr_operator.domain.ports import CarEvent, CarLink, LinkStatistics, LockFacts, LockState, RobotLink
from mtr_operator.domain.requests import DesiredState
from mtr_operator.domain.robot_status import RobotStatus
from mtr_simulation.car.honest.instants import Moved
from mtr_simulation.car.honest.locks import Cause
from mtr_simulation.car.honest.locks import LockState as TrueState

from .world import RadioWorld

_NS = 1e9
# 1 sigma of the mapping between adapter and robot clock; see car_link/README.md.
_CLOCK_SIGMA_S = 0.003
_SOURCES = {Cause.PASSIVE_ENTRY: "passive_entry", Cause.KEY_BUTTON: "key_button", Cause.HANDLE: "handle"}
# Time until the ECU has booted and sent its first message.
_KNOWN_AFTER_NS = 600_000_000


class RadioRobotLink(RobotLink):
    """Robot link; next_status advances the time until there is news."""

    def __init__(self, world: RadioWorld):
        self.statistics = LinkStatistics()
        self._world = world

    def connect(self) -> None:
        pass

    def next_status(self, timeout_s: float) -> RobotStatus | None:
        """See RobotLink; never times out."""
        self.statistics.received += 1
        return self._world.next_status()

    def send(self, desired: DesiredState) -> None:
        self._world.take(desired)

    def close(self) -> None:
        pass


class RadioHandle(HandlePort):
    """Actuator at the Car's handle."""

    by = OUTPUT

    def __init__(self, world: RadioWorld):
        self._world = world
        self._is_taken = False

    def request(self, distance_m: float) -> None:
        self._world.take_handle()
        self._is_taken = True

    def is_taken(self) -> bool:
        return self._is_taken

    def release(self) -> None:
        self._is_taken = False


class RadioCarLink(CarLink, CarEquipment):
    """Car link with events as in the lock message: timed in the middle between the frames around a change.

    clock_s: delay added to the event times.
    """

    def __init__(self, world: RadioWorld, facts: LockFacts, clock_s: float = 0.0):
        self._world = world
        self._facts = facts
        self._clock_s = clock_s
        self._handle = RadioHandle(world)
        self._known_ns = world.time_ns + _KNOWN_AFTER_NS
        self._state = LockState.UNKNOWN
        self._told: deque[CarEvent] = deque()

    def connect(self) -> None:
        pass

    def observe(self, status: RobotStatus) -> list[CarEvent]:
        """See CarLink; events with a future time are held back until then."""
        world = self._world
        if self._state is LockState.UNKNOWN and world.time_ns >= self._known_ns:
            self._state = LockState.LOCKED
        while world.moved:
            self._told.append(self._event(world.moved.popleft()))
        events = []
        while self._told and self._told[0].time_s <= status.stamp_s:
            event = self._told.popleft()
            if event.lock_state is not self._state:
                self._state = event.lock_state
                events.append(event)
        return events

    def _event(self, moved: Moved) -> CarEvent:
        gap_s = (moved.told_ns - moved.before_ns) / _NS
        state = LockState.LOCKED if moved.state is TrueState.LOCKED else LockState.UNLOCKED
        return CarEvent(moved.told_ns / _NS - gap_s / 2.0 + self._clock_s,
                        math.hypot(gap_s / math.sqrt(12.0), _CLOCK_SIGMA_S), state, _SOURCES.get(moved.cause, ""))

    @property
    def lock_state(self) -> LockState:
        return self._state

    @property
    def facts(self) -> LockFacts:
        return self._facts

    @property
    def handle(self) -> HandlePort | None:
        return self._handle

    @property
    def problem(self) -> str:
        return ""

    def close(self) -> None:
        pass
