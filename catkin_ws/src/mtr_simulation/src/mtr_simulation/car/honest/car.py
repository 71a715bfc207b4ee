"""Simulated honest Car: radio, key and locks while the key moves, with its CAN bus and the truth log."""
# SPDX-License-Identifier: Apache-2.0
import collections
from typing import Deque, Optional, Tuple

from ...truth.log import EventLog
from ..button import ButtonContact, Closing
from ..can_port import CanPort
from ..ecu import Command
from ..noise import uniform_pair
from ..parameters import RemoteParameters
from ..vehicle import Vehicle
from .attempts import Attempts
from .extender import Extender
from .frames import HonestFrames, database
from .handle import HandleActuator
from .instants import STEP_NS
from .key import RemoteKey
from .locks import Cause, Locks, LockState
from .parameters import HonestParameters
from .passive_entry import PassiveEntry, Poll
from .radio.key_antenna import Attitude

Point = Tuple[float, float, float]

# Largest number of pending handle requests, while the ECU boots or passive entry is off.
_MAX_REQUESTS = 4


class HonestCar:
    """Steps radio, key, contacts and locks.

    Attributes:
        locks: state of the locks.
        key: state of the key, for example whether it sleeps.
        vehicle: reported ignition and speed.
    """

    def __init__(self, seed: int, parameters: HonestParameters, port: CanPort, truth_log: EventLog):
        passive, remote = parameters.passive_entry, parameters.key
        self.locks = Locks(parameters.locks)
        self.key = RemoteKey(remote)
        self._port = port
        self._truth_log = truth_log
        self._passive_parameters = passive
        self.vehicle = Vehicle()
        self._frames = HonestFrames(seed, self.locks, parameters.bus, self.vehicle)
        self._attempts = Attempts(seed, parameters)
        self._passive = PassiveEntry(passive)
        self._polls = _Period(seed, "poll_phase", passive.poll_period_ms * 1_000_000)
        self._hand = _Period(seed, "hand_phase", round(passive.handle_period_s * 1e9))
        self._actuator = HandleActuator(database())
        self._extender = Extender(database(), passive.extender_db)
        self._handle_requests: Deque[Command] = collections.deque(maxlen=_MAX_REQUESTS)
        contact = RemoteParameters(contact_travel=remote.contact_travel, contact_ms=remote.contact_ms)
        self._contacts = ((Command.LOCK, ButtonContact(contact)), (Command.UNLOCK, ButtonContact(contact)))

    def request_handle(self, command: Command = Command.UNLOCK) -> None:
        """Simulate a hand that pulls the driver's handle, to open or to lock; it is handled in the next step."""
        self._handle_requests.append(command)

    def step(self, time_ns: int, key_xyz: Point, servo_us: Tuple[float, float], key_yaw_rad: float = 0.0) -> None:
        """Advance to time_ns, 20 ms after the previous step; place of the key in m in the true Car frame, and its
        heading.

        The frames of those 20 ms have the state at their beginning; then the Car detects the key's current place.
        """
        self._port.poll()
        self._follow_actuator()
        for frame in self._frames.due(time_ns - STEP_NS, time_ns):
            self._port.send(*frame)
        attitude = Attitude(key_yaw_rad)
        self._attempts.step(time_ns)
        self.key.step(time_ns, key_xyz)
        before = self.locks.state
        self._log(before, self.locks.step(time_ns), time_ns, key_xyz)
        for (command, contact), pulse_us in zip(self._contacts, servo_us):
            closing = contact.update(time_ns, pulse_us, key_xyz)
            if closing is not None:
                self._transmit(command, closing, time_ns, attitude)
        if self.locks.is_ready and self._passive_parameters.enabled:
            self._poll(time_ns, key_xyz, attitude)
            self._answer_handle(time_ns, key_xyz, attitude)

    def _follow_actuator(self) -> None:
        for frame in self._port.taken():
            self._extender.follow(frame)
            command = self._actuator.request(frame)
            if command is not None:
                self.request_handle(command)

    def _transmit(self, command: Command, closing: Closing, time_ns: int, attitude: Attitude) -> None:
        sent = closing.counts and self.locks.is_ready and self.key.buttons_work
        accepted = sent and self._attempts.press(closing.key_xyz, attitude)
        self._truth_log.press(closing.time_ns, closing.key_xyz, accepted)
        if accepted:
            self.locks.command(command, Cause.KEY_BUTTON, time_ns)

    def _poll(self, time_ns: int, key_xyz: Point, attitude: Attitude) -> None:
        if self._polls.has_come(time_ns):
            command = self._passive.poll(self._heard(key_xyz, attitude), time_ns)
            if command is not None:
                self.locks.command(command, Cause.PASSIVE_ENTRY, time_ns)

    def _answer_handle(self, time_ns: int, key_xyz: Point, attitude: Attitude) -> None:
        if self._hand.has_come(time_ns) and self.locks.state is LockState.LOCKED:
            self.request_handle()
        while self._handle_requests:
            command = self._handle_requests.popleft()
            accepted = self._heard(key_xyz, attitude) is Poll.IN_UNLOCK_ZONE
            self._truth_log.handle(time_ns, key_xyz, accepted)
            if accepted:
                self.locks.command(command, Cause.HANDLE, time_ns)

    def _heard(self, key_xyz: Point, attitude: Attitude) -> Poll:
        return self._attempts.poll(key_xyz, attitude, self._extender.now_db) if self.key.is_awake \
            else Poll.GONE

    def _log(self, before: LockState, after: Optional[LockState], time_ns: int, key_xyz: Point) -> None:
        """Log changes between locked and unlocked; the unlocking of the other doors after the driver's is not an
        event."""
        if after is LockState.LOCKED:
            self._truth_log.lock_event("locked", time_ns, key_xyz)
        elif after is not None and before is LockState.LOCKED:
            self._truth_log.lock_event("unlocked", time_ns, key_xyz)


class _Period:
    """Signals the end of each period; the seed determines the phase."""

    def __init__(self, seed: int, name: str, period_ns: int):
        self._period_ns = period_ns
        self._phase_ns = round(uniform_pair(seed, name, 0)[0] * period_ns)
        self._number: Optional[int] = None

    def has_come(self, time_ns: int) -> bool:
        """Return True once per period; never for a period of 0. The first call only initializes it."""
        if self._period_ns == 0:
            return False
        number = (time_ns - self._phase_ns) // self._period_ns
        first, comes = self._number is None, number != self._number
        self._number = number
        return comes and not first
