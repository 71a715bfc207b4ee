"""Simulated Car that sends a profile's frames on python-can's virtual bus, in lock-step with a robot's substitute.

It serves tests and benchmarks of the path from bus to distance, and the trial of a profile. No timed waits are needed:
each frame is received before the next Status comes.
"""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import collections
import pathlib
import time
from typing import TYPE_CHECKING, Iterator

import can

from mtr_operator.domain.ports import KEY_BUTTON, PASSIVE_ENTRY, CarEvent, LockState, RobotLink
from mtr_operator.domain.requests import DesiredState
from mtr_operator.domain.robot_status import RobotStatus

from .adapter import AdapterSettings
from .bus import CanCarLink
from .further.entries import FIRST_BUS
from .further.spoken_frames import BACKGROUND_ID, SpokenFrames, state_raw
from .phone.car_signal import PhoneSignal
from .phone.simulated import SimulatedPhone
from .profile import CarProfile, load_profile
from .simulated_car import SimulatedCarLink
from .uds.declared import UdsPoll

if TYPE_CHECKING:
    from .uds.spoken_ecu import SpokenEcu

# Offset between a frame and the step of the robot's clock.
_PHASE_S = 0.001
_PATIENCE_S = 10.0
_INTERFACE = "virtual"
_BITRATE_BPS, _DATA_BITRATE_BPS = 500_000, 2_000_000


class SpokenCar(RobotLink):
    """Robot link that lets the Car send its frames up to each Status that it returns.

    channel: of the virtual bus. profile: defines the Car's frames; databases: see load_profile.

    Attributes:
        car: link on that bus, not connected yet; its clock is the robot's.
        told: changes of the locks that the Car has sent.
    """

    def __init__(self, robot: RobotLink, channel: str, seed: int = 1, profile: str = "mtr_demo_car",
                 databases: pathlib.Path | None = None, *, car_seed: int = 1):
        self.statistics = robot.statistics
        self.told: list[CarEvent] = []
        self._profile: CarProfile = load_profile(profile, databases)
        self._frames = SpokenFrames(self._profile)
        data_bitrate = _DATA_BITRATE_BPS if self._frames.is_fd else None
        further = {name: AdapterSettings(_INTERFACE, f"{channel}-{name}", _BITRATE_BPS, data_bitrate_bps=data_bitrate)
                   for name in self._profile.further.buses}
        self.car = CanCarLink(_INTERFACE, channel, _BITRATE_BPS, profile, clock=lambda: self._now_s, further=further,
                              is_listening=self._profile.poll is None, data_bitrate=data_bitrate, databases=databases)
        self._robot = robot
        self._buses = {name: can.Bus(interface=_INTERFACE, channel=each.channel) for name, each in further.items()}
        self._buses[FIRST_BUS] = can.Bus(interface=_INTERFACE, channel=channel)
        self._ecu = None if self._profile.poll is None else _ecu(self._profile.poll, self._buses[FIRST_BUS])
        self._model = SimulatedCarLink(seed, car_seed=car_seed)
        self._phone = SimulatedPhone(seed)
        self._events: collections.deque[CarEvent] = collections.deque()
        self._now_s = self._sent_s = 0.0
        self._sent = 0

    @property
    def cycle_s(self) -> float:
        """Cycle of the message of the state."""
        return self._profile.cycle_time_s

    def connect(self) -> None:
        self._robot.connect()
        self._model.connect()
        self._phone.connect()

    def next_status(self, timeout_s: float) -> RobotStatus | None:
        status = self._robot.next_status(timeout_s)
        if status is None:
            return None
        self._events.extend(self._model.observe(status))
        self._frames.source = KEY_BUTTON if status.presses else PASSIVE_ENTRY
        for time_s in self._due(status.stamp_s):
            self._speak(time_s)
        self._speak_of_phone(status)
        self._now_s = status.stamp_s
        return status

    def _due(self, until_s: float) -> Iterator[float]:
        if self.car.profile is None:
            return
        cycle_s = self._profile.cycle_time_s
        if not self._sent_s:
            self._sent_s = until_s - cycle_s - _PHASE_S
        while self._next_s + _PHASE_S <= until_s:
            self._sent_s = self._next_s
            yield self._sent_s

    @property
    def _next_s(self) -> float:
        """Return the time of the next frames: by their cycle, or at once with a change."""
        next_s = round(self._sent_s + self._profile.cycle_time_s, 6)
        is_sooner = self._profile.sent_on_change and self._events and self._sent_s < self._events[0].time_s < next_s
        return self._events[0].time_s if is_sooner else next_s

    def _speak(self, time_s: float) -> None:
        while self._events and self._events[0].time_s <= time_s:
            event = self._events.popleft()
            self._frames.is_locked = event.lock_state is LockState.LOCKED
            self.told.append(event)
        self._now_s = time_s
        if self._ecu is not None:
            self._answer(self._ecu)
            return
        for bus, message in self._frames.next():
            self._buses[bus].send(message)
            self._sent += 1
        self._wait()

    def _speak_of_phone(self, status: RobotStatus) -> None:
        """Send the distance of a phone, if the profile names the signal."""
        signal = self._profile.phone
        if self.car.profile is None or not isinstance(signal, PhoneSignal):
            return
        for reported in self._phone.observe(status):
            for bus, message in self._frames.phone(signal, reported.distance_m):
                self._buses[bus].send(message)
                self._sent += 1
        self._wait()

    def _answer(self, ecu: SpokenEcu) -> None:
        """Answer the requests of the reader: a frame advances its time, then it sends a request."""
        ecu.raw = state_raw(self._profile, self._frames.is_locked)
        self._buses[FIRST_BUS].send(can.Message(arbitration_id=BACKGROUND_ID, is_extended_id=False))
        answered = ecu.answer(_PATIENCE_S)
        self._sent += 1 + answered
        self._wait()

    def _wait(self) -> None:
        give_up_s = time.monotonic() + _PATIENCE_S
        while self.car.frames_received < self._sent and time.monotonic() < give_up_s:
            time.sleep(0.0)

    def send(self, desired: DesiredState) -> None:
        self._robot.send(desired)

    def close(self) -> None:
        self._robot.close()
        for bus in self._buses.values():
            bus.shutdown()


def _ecu(poll: UdsPoll, bus: can.BusABC) -> SpokenEcu:
    from .uds.spoken_ecu import SpokenEcu
    return SpokenEcu(poll, bus)
