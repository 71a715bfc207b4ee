"""How long the host waits for the firmware's answer to a command, on the emulated board in real time, without ROS."""
# SPDX-License-Identifier: Apache-2.0
import io
import statistics
import threading
import time
from typing import Any, Dict, List, Optional

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
HELD_HEIGHT_M = float("nan")


class EchoTimer(LineObserver):
    """Notes when the echo of each command comes."""

    def __init__(self) -> None:
        self.arrivals: Dict[int, float] = {}
        self.linked = threading.Event()
        self._session: Optional[SerialSession] = None

    def attach(self, session: SerialSession) -> None:
        """The session whose events these are."""
        self._session = session

    def event(self, event: SessionEvent) -> None:
        """Something of the session."""
        if event.opened and names.FIRMWARE_COMMAND in self._session.endpoints.to_device:
            self.linked.set()
        if event.message and self._session.endpoints.by_id[event.message.topic_id].info.name == names.FIRMWARE_ECHO:
            self.arrivals[event.message.payload[0]] = time.monotonic()


def sentence(figures: Dict[str, Any]) -> str:
    """The figures for a person."""
    return (f"Command to echo at {figures['baud']} baud: {figures['echo_p50_ms']:.1f} ms (median), "
            f"{figures['echo_p95_ms']:.1f} ms (95 %), {figures['echoes']} of {figures['commands']} echoed.")


def figures() -> Dict[str, Any]:
    """Round trips of commands to the emulated board."""
    timer, parameters = EchoTimer(), SerialParameters()
    session = SerialSession(parameters, md5_of, time.time_ns)
    timer.attach(session)
    with Emulator("atmega2560") as board:
        line = SerialLine(lambda: SerialPort(str(board.pty), parameters.baud), session, timer)
        line.start()
        try:
            if not timer.linked.wait(LIMIT_S):
                raise SystemExit("The emulated firmware did not answer.")
            trips = [trip for number in range(COMMANDS) for trip in round_trip(line, timer, number)]
        finally:
            line.stop()
    return {"commands": COMMANDS, "echoes": len(trips), "baud": parameters.baud,
            "echo_p50_ms": statistics.median(trips), "echo_p95_ms": statistics.quantiles(trips, n=20)[18],
            "echo_max_ms": max(trips)}


def round_trip(line: SerialLine, timer: EchoTimer, number: int) -> List[float]:
    """Time in ms from giving a command to the line to hearing its echo; nothing when it was lost."""
    buffer = io.BytesIO()
    seal(FirmwareCommand(seq=number, lift_height_m=HELD_HEIGHT_M, led_pattern=2)).serialize(buffer)
    timer.arrivals.clear()
    begun = time.monotonic()
    line.send(names.FIRMWARE_COMMAND, buffer.getvalue())
    time.sleep(PERIOD_S + PERIOD_STEP_S * (number % 30))
    arrived = timer.arrivals.get(number % 256)
    return [] if arrived is None else [1e3 * (arrived - begun)]

