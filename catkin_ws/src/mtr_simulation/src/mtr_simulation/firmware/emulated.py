"""Flashed firmware on an emulated microcontroller behind a pseudo-terminal, in step with simulated time.

The host's side of the line is the robot's own session. It runs here and not in a separate node, so that each byte is
transmitted at a known simulated time and a run is the same on any machine.
"""
# SPDX-License-Identifier: Apache-2.0
import select
from typing import Any, Callable, List, Optional, Tuple

from mtr_core.errors import RobotError
from mtr_serial_link.parameters import SerialParameters
from mtr_serial_link.port import SerialPort
from mtr_serial_link.session import SerialSession

NS_PER_US = 1000
NS = 1e-9
TICK_NS = 20_000_000
# Limit of wall time in which the emulator's bytes must arrive through the pseudo-terminal.
ARRIVAL_LIMIT_MS = 2000


class EmulationError(RobotError):
    """The emulated microcontroller does not answer."""


class EmulatedFirmware:
    """Same interface as SimulatedFirmware, executed by the binary.

    Attributes:
        lift_height_m: height of the emulated lift above its lower stop.
        servo_us: pulse widths of the emulated servos.
        session: the host's side of the line.
    """

    def __init__(self, board: Any, md5_of: Callable[[str], Optional[str]]):
        self._board = board
        self._now_ns = 0
        self._sent = self._received = 0
        self._port: Optional[SerialPort] = None
        self._messages: List[Tuple[str, bytes]] = []
        self.session = SerialSession(SerialParameters(), md5_of, lambda: self._now_ns)
        self.lift_height_m = 0.0
        self.servo_us: Tuple[float, float] = (0.0, 0.0)

    def start(self, time_ns: int) -> None:
        """Power on at time 0, so that its clock equals the simulated one, and run to the given time."""
        self._board.start()
        self._port = SerialPort(str(self._board.pty), SerialParameters().baud)
        self.session.start(0.0)
        while self._now_ns < time_ns:
            self.step(min(time_ns, self._now_ns + TICK_NS))

    def send(self, topic: str, payload: bytes) -> None:
        """Send a message to the firmware."""
        self.session.send(topic, payload)

    def take_messages(self) -> List[Tuple[str, bytes]]:
        """Return the firmware's messages since the last call: topics and payloads."""
        messages, self._messages = self._messages, []
        return messages

    def begin_step(self, time_ns: int) -> None:
        """Let the microcontroller run to time_ns in parallel until the caller calls step."""
        self._write()
        self._board.begin_step((time_ns - self._now_ns) // NS_PER_US, rx_bytes=self._sent)
        self._now_ns = time_ns

    def step(self, time_ns: int) -> None:
        """Let the microcontroller run to time_ns, unless begin_step has started it, and read its messages."""
        if self._now_ns != time_ns:
            self.begin_step(time_ns)
        reply = self._board.end_step()
        for event in self.session.receive(self._read(reply["tx"]), time_ns * NS) + self.session.tick(time_ns * NS):
            if event.message:
                name = self.session.endpoints.by_id[event.message.topic_id].info.name
                self._messages.append((name, event.message.payload))
            elif event.refused:
                raise EmulationError(event.refused)
        seen = self._board.probe()
        self.lift_height_m, self.servo_us = seen.lift_m, seen.servo_us

    def stand(self, duration_ns: int) -> None:
        """Do nothing: while the world stops, this microcontroller stops too, and its program notices no time."""

    def close(self) -> None:
        """Power off."""
        if self._port:
            self._port.close()
        self._board.stop()

    def _open_port(self) -> SerialPort:
        if self._port is None:
            raise EmulationError("The emulated board has not been started.")
        return self._port

    def _write(self) -> None:
        data = b"".join(self.session.outbox)
        self.session.outbox.clear()
        self._sent += len(data)
        while data:
            data = data[self._open_port().write(data):]

    def _read(self, total: int) -> bytes:
        """Read up to the given number of bytes since the start; a pseudo-terminal delivers with a delay."""
        pieces, port = [], self._open_port()
        while self._received < total:
            if not select.select([port.fd], [], [], ARRIVAL_LIMIT_MS * 1e-3)[0]:
                raise EmulationError(f"The emulated firmware sent {total} bytes, of which {self._received} came.")
            pieces.append(port.read())
            self._received += len(pieces[-1])
        return b"".join(pieces)
