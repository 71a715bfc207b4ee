"""Simulated gentle Car: radio and locks while the key moves, with its CAN bus and the truth log."""
# SPDX-License-Identifier: Apache-2.0
from typing import Optional, Tuple

from ..truth.log import EventLog
from .button import ButtonContact, Closing
from .can_port import CanPort
from .ecu import BodyEcu, Command, LockState, PassiveEntry, Source
from .frames import CarFrames
from .parameters import CarParameters
from .radio import PassiveEntryRadio, RemoteRadio
from .vehicle import Vehicle

Point = Tuple[float, float, float]

STEP_NS = 20_000_000
_EVENT = {LockState.UNLOCKED: "unlocked", LockState.LOCKED: "locked"}


class SimulatedCar:
    """Steps radio, contacts and ECU.

    Attributes:
        ecu: the body ECU, for reading its state.
        vehicle: reported ignition and speed.
    """

    def __init__(self, seed: int, parameters: CarParameters, port: CanPort, truth_log: EventLog):
        correlation_m = parameters.shadow_correlation_m
        self.ecu = BodyEcu(parameters.boot_ms * 1_000_000)
        self._port = port
        self._truth_log = truth_log
        self.vehicle = Vehicle()
        self._frames = CarFrames(self.ecu, self.vehicle)
        self._passive_enabled = parameters.passive_entry.enabled
        self._passive_radio = PassiveEntryRadio(seed, parameters.passive_entry, correlation_m)
        self._passive = PassiveEntry(parameters.passive_entry)
        self._poll_ns = parameters.passive_entry.poll_period_ms * 1_000_000
        self._polls: Optional[int] = None
        self._remote_radio = RemoteRadio(seed, parameters.remote, correlation_m)
        self._contacts = (
            (Command.LOCK, ButtonContact(parameters.remote)),
            (Command.UNLOCK, ButtonContact(parameters.remote)),
        )
        self._transmissions = 0

    def request_handle(self, command: Command = Command.UNLOCK) -> None:
        """Do nothing: the gentle Car has no sensor at its handle."""

    def step(self, time_ns: int, key_xyz: Point, servo_us: Tuple[float, float], key_yaw_rad: float = 0.0) -> None:
        """Advance to time_ns, 20 ms after the previous step; key_xyz in m in the true Car frame.

        The frames of those 20 ms have the state at their beginning; then the Car detects the key's current place. The
        key's heading has no effect on this Car.
        """
        self._port.poll()
        for frame in self._frames.due(time_ns - STEP_NS, time_ns):
            self._port.send(*frame)
        self.ecu.step(time_ns)
        for (command, contact), pulse_us in zip(self._contacts, servo_us):
            closing = contact.update(time_ns, pulse_us, key_xyz)
            if closing is not None:
                self._transmit(command, closing, time_ns)
        # A key that arrives while the ECU boots is detected afterwards.
        if self._passive_enabled and self.ecu.lock_state is not LockState.UNKNOWN:
            self._poll_key(time_ns, key_xyz)

    def _transmit(self, command: Command, closing: Closing, time_ns: int) -> None:
        accepted = False
        if closing.counts and self.ecu.lock_state is not LockState.UNKNOWN:
            self._transmissions += 1
            accepted = self._remote_radio.is_received(closing.key_xyz, self._transmissions)
        self._truth_log.press(closing.time_ns, closing.key_xyz, accepted)
        if accepted:
            self._command(command, Source.KEY_BUTTON, time_ns, closing.key_xyz)

    def _poll_key(self, time_ns: int, key_xyz: Point) -> None:
        polls = time_ns // self._poll_ns
        if polls == self._polls:
            return
        self._polls = polls
        command = self._passive.poll(self._passive_radio.poll_db(key_xyz, polls))
        if command is not None:
            self._command(command, Source.PASSIVE_ENTRY, time_ns, key_xyz)

    def _command(self, command: Command, source: Source, time_ns: int, key_xyz: Point) -> None:
        if self.ecu.command(command, source, time_ns):
            self._truth_log.lock_event(_EVENT[self.ecu.lock_state], time_ns, key_xyz)
