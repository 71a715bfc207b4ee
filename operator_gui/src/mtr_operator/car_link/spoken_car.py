"""The demo car's substitute on python-can's virtual bus, in lock-step with a robot's substitute.

For tests and benchmarks of all that lies between a bus and a distance. Nobody waits for a time: each frame is taken
before the next Status comes.
"""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import collections
import time
from typing import Iterator

import can

from mtr_operator.domain.ports import CarEvent, LockState, RobotLink
from mtr_operator.domain.requests import DesiredState
from mtr_operator.domain.robot_status import RobotStatus

from .bus import CanCarLink
from .fake_message import DemoLockMessage
from .simulated_car import SimulatedCarLink

_LOCK_ID = 0x320
# Between the instant of a frame and the step of the robot's clock.
_PHASE_S = 0.001
_PATIENCE_S = 10.0
_PASSIVE_ENTRY, _KEY_BUTTON = 1, 2


class SpokenCar(RobotLink):
    """A robot's link that has the Car speak on its bus up to each Status that it gives.

    channel: of the virtual bus. profile: of a Car that speaks the demo car's message.

    Attributes:
        car: link on that bus, not connected yet; its clock is the robot's.
    """

    def __init__(self, robot: RobotLink, channel: str, seed: int = 1, profile: str = "mtr_demo_car"):
        self.statistics = robot.statistics
        self.car = CanCarLink("virtual", channel, profile=profile, clock=lambda: self._now_s)
        self._robot = robot
        self._bus = can.Bus(interface="virtual", channel=channel)
        self._model = SimulatedCarLink(seed)
        self._message = DemoLockMessage()
        self._events: collections.deque[CarEvent] = collections.deque()
        self._now_s = self._sent_s = 0.0
        self._sent = 0

    def connect(self) -> None:
        """See RobotLink."""
        self._robot.connect()
        self._model.connect()

    def next_status(self, timeout_s: float) -> RobotStatus | None:
        """See RobotLink."""
        status = self._robot.next_status(timeout_s)
        if status is None:
            return None
        self._events.extend(self._model.observe(status))
        self._message.source = _KEY_BUTTON if status.presses else _PASSIVE_ENTRY
        for time_s in self._due(status.stamp_s):
            self._speak(time_s)
        self._now_s = status.stamp_s
        return status

    def _due(self, until_s: float) -> Iterator[float]:
        cycle_s = 0.0 if self.car.profile is None else self.car.profile.cycle_time_s
        if not cycle_s:
            return
        if not self._sent_s:
            self._sent_s = until_s - cycle_s - _PHASE_S
        while self._sent_s + cycle_s + _PHASE_S <= until_s:
            self._sent_s = round(self._sent_s + cycle_s, 6)
            yield self._sent_s

    def _speak(self, time_s: float) -> None:
        while self._events and self._events[0].time_s <= time_s:
            self._message.is_locked = self._events.popleft().lock_state is LockState.LOCKED
        self._now_s = time_s
        self._bus.send(can.Message(arbitration_id=_LOCK_ID, is_extended_id=False, data=self._message.next()))
        self._sent += 1
        give_up_s = time.monotonic() + _PATIENCE_S
        while self.car.frames_received < self._sent and time.monotonic() < give_up_s:
            time.sleep(0.0)

    def send(self, desired: DesiredState) -> None:
        """See RobotLink."""
        self._robot.send(desired)

    def close(self) -> None:
        """See RobotLink."""
        self._robot.close()
        self._bus.shutdown()
