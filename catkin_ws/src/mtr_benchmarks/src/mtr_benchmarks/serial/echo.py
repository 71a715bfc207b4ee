"""How long the host waits for the firmware's answer to a command, on the emulated board in real time, without ROS."""
# SPDX-License-Identifier: Apache-2.0
import io
import statistics
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
# Not a whole part of the firmware's reporting period, so that commands meet each phase of it.
PERIOD_STEP_S = 0.0013
LIMIT_S = 5.0
# Fewer round trips have no 95 %.
MIN_ECHOES = 20
# The lift stays where it is.
KEPT_HEIGHT_M = float("nan")


class EchoTimer(LineObserver):
    """Takes the time at which the echo of each command arrives.

    Attributes:
        arrivals: times of a clock that never steps, by the number of the command.
        linked: the device takes commands.
    """

    def __init__(self, session: SerialSession) -> None:
        self._session = session
        self.arrivals: Dict[int, float] = {}
        self.linked = threading.Event()

    def event(self, event: SessionEvent) -> None:
        """The session has something to act on."""
        if event.opened and names.FIRMWARE_COMMAND in self._session.endpoints.to_device:
            self.linked.set()
        if event.message and self._session.endpoints.by_id[event.message.topic_id].info.name == names.FIRMWARE_ECHO:
            self.arrivals[event.message.payload[0]] = time.monotonic()


@dataclass(frozen=True)
class EchoFigures:
    """Round trips of commands; times are None when too few came back."""

    commands: int
    echoes: int
    baud: int
    echo_p50_ms: Optional[float]
    echo_p95_ms: Optional[float]
    echo_max_ms: Optional[float]


def measure_echo() -> EchoFigures:
    """Round trips of commands to the emulated board."""
    parameters = SerialParameters()
    session = SerialSession(parameters, md5_of, time.time_ns)
    timer = EchoTimer(session)
    with Emulator("atmega2560") as board:
        line = SerialLine(lambda: SerialPort(str(board.pty), parameters.baud), session, timer)
        line.start()
        try:
            if not timer.linked.wait(LIMIT_S):
                raise SystemExit("The emulated firmware did not answer.")
            trips_ms = [trip for number in range(COMMANDS) for trip in round_trip(line, timer, number)]
        finally:
            line.stop()
    return figures_of(trips_ms, parameters.baud)


def figures_of(trips_ms: List[float], baud: int) -> EchoFigures:
    """Median, 95 % and maximum."""
    if len(trips_ms) < MIN_ECHOES:
        return EchoFigures(COMMANDS, len(trips_ms), baud, None, None, None)
    return EchoFigures(COMMANDS, len(trips_ms), baud, statistics.median(trips_ms),
                       statistics.quantiles(trips_ms, n=20)[18], max(trips_ms))


def round_trip(line: SerialLine, timer: EchoTimer, number: int) -> List[float]:
    """Time in ms from queueing a command to receiving its echo; nothing when it was lost."""
    buffer = io.BytesIO()
    seal(FirmwareCommand(seq=number, lift_height_m=KEPT_HEIGHT_M, led_pattern=2)).serialize(buffer)
    timer.arrivals.clear()
    begun = time.monotonic()
    line.send(names.FIRMWARE_COMMAND, buffer.getvalue())
    time.sleep(PERIOD_S + PERIOD_STEP_S * (number % 30))
    arrived = timer.arrivals.get(number % 256)
    return [] if arrived is None else [1e3 * (arrived - begun)]

