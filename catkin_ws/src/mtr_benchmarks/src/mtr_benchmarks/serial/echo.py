"""Measures the round trip of a command to the firmware, on the emulated board in real time, without ROS."""
# SPDX-License-Identifier: Apache-2.0
import io
import statistics
import struct
import threading
import time
from dataclasses import dataclass
from typing import Dict, List, Optional

from mtr_core import names
from mtr_core.crc import seal
from mtr_emulator import Emulator
from mtr_msgs.msg import FirmwareCommand
from mtr_serial_link.connections import md5_of
from mtr_serial_link.line import LineObserver, SerialLine
from mtr_serial_link.parameters import SerialParameters
from mtr_serial_link.port import SerialPort
from mtr_serial_link.session import SerialSession, SessionEvent

COMMANDS = 400
PERIOD_S = 0.05
# The period is not a multiple of the firmware's reporting period, so that commands meet each of its phases.
PERIOD_STEP_S = 0.0013
LINK_LIMIT_S = 5.0
# An echo after this time counts as lost; the limit tolerates delays of a busy machine.
ECHO_LIMIT_S = 1.0
# Fewer round trips have no 95th percentile.
MIN_ECHOES = 20
# NaN: the lift keeps its height.
KEPT_HEIGHT_M = float("nan")
# Time of the firmware, first field of FirmwareState; lead by which a command expires after it.
TIME_US, LEAD_US = struct.Struct("<I"), 500_000


class EchoTimer(LineObserver):
    """Records the arrival of each command's echo.

    Attributes:
        linked: the device accepts commands.
        time_us: newest time of the firmware's clock.
    """

    def __init__(self, session: SerialSession) -> None:
        self._session = session
        self._arrivals: Dict[int, float] = {}
        self._arrived = threading.Condition()
        self.linked = threading.Event()
        self.time_us = 0

    def event(self, event: SessionEvent) -> None:
        """Handle an event of the session."""
        if event.opened and names.FIRMWARE_COMMAND in self._session.endpoints.to_device:
            self.linked.set()
        name = self._session.endpoints.by_id[event.message.topic_id].info.name if event.message else ""
        if event.message and name == names.FIRMWARE_STATE:
            self.time_us = TIME_US.unpack_from(event.message.payload)[0]
        if event.message and name == names.FIRMWARE_ECHO:
            with self._arrived:
                self._arrivals[event.message.payload[0]] = time.monotonic()
                self._arrived.notify_all()

    def clear(self) -> None:
        """Discard the recorded echoes."""
        with self._arrived:
            self._arrivals.clear()

    def wait_for(self, number: int, limit_s: float) -> Optional[float]:
        """Return the arrival of a command's echo on the monotonic clock; None if it did not arrive within the limit."""
        with self._arrived:
            self._arrived.wait_for(lambda: number in self._arrivals, limit_s)
            return self._arrivals.get(number)


@dataclass(frozen=True)
class EchoFigures:
    """Round trips of commands; times are None if there are too few."""

    commands: int
    echoes: int
    baud: int
    echo_p50_ms: Optional[float]
    echo_p95_ms: Optional[float]
    echo_max_ms: Optional[float]


def measure_echo() -> EchoFigures:
    """Measure round trips of commands to the emulated board."""
    parameters = SerialParameters()
    session = SerialSession(parameters, md5_of, time.time_ns)
    timer = EchoTimer(session)
    with Emulator("atmega2560") as board:
        line = SerialLine(lambda: SerialPort(str(board.pty), parameters.baud), session, timer)
        line.start()
        try:
            if not timer.linked.wait(LINK_LIMIT_S):
                raise SystemExit("The emulated firmware did not answer.")
            trips_ms = [trip for number in range(COMMANDS) for trip in round_trip(line, timer, number)]
        finally:
            line.stop()
    return figures_of(trips_ms, parameters.baud)


def figures_of(trips_ms: List[float], baud: int) -> EchoFigures:
    """Return median, 95th percentile and maximum."""
    if len(trips_ms) < MIN_ECHOES:
        return EchoFigures(COMMANDS, len(trips_ms), baud, None, None, None)
    return EchoFigures(COMMANDS, len(trips_ms), baud, statistics.median(trips_ms),
                       statistics.quantiles(trips_ms, n=20)[18], max(trips_ms))


def round_trip(line: SerialLine, timer: EchoTimer, number: int) -> List[float]:
    """Return the time in ms from queueing a command to receiving its echo; empty if it was lost."""
    buffer = io.BytesIO()
    seal(FirmwareCommand(seq=number, lift_height_m=KEPT_HEIGHT_M, led_pattern=2,
                         latest_us=(timer.time_us + LEAD_US) % 2 ** 32)).serialize(buffer)
    timer.clear()
    begun = time.monotonic()
    line.send(names.FIRMWARE_COMMAND, buffer.getvalue())
    arrived = timer.wait_for(number % 256, ECHO_LIMIT_S)
    time.sleep(max(0.0, begun + PERIOD_S + PERIOD_STEP_S * (number % 30) - time.monotonic()))
    return [] if arrived is None else [1e3 * (arrived - begun)]
