"""A host of the serial line for tests in lock-step: frames, messages, and the upstream host's answers."""
# SPDX-License-Identifier: Apache-2.0
import binascii
import collections
import contextlib
import os
import struct
import termios
import tty
from typing import Deque, Dict, List, NamedTuple, Optional, Tuple

from mtr_emulator import Emulator, Probe

NEGOTIATE, SUBSCRIBER, TIME, STOP = 0, 1, 10, 11
COMMAND, PRESS, CALIBRATE, SIGNALS, STATE, HEALTH, ECHO, INPUTS = 100, 101, 102, 103, 125, 126, 127, 128
HEADER = struct.Struct("<BBHBH")
STATE_FORMAT, HEALTH_FORMAT = struct.Struct("<IfHHIBIIBBBIBH"), struct.Struct("<BHHHHHHIHHBBH")
INPUTS_FORMAT = struct.Struct("<IBHBBH")
STEP_US = 10_000
COMMAND_PERIOD_US = 100_000
# The firmware's clock at power on; an order of the host may begin so long after it leaves.
CLOCK_START_US = 2 ** 32 - 1 - 120_000_000
LEAD_US = 500_000
# What became of a press.
DONE, REFUSED, CUT_SHORT = 2, 3, 4


class State(NamedTuple):
    """mtr_msgs/FirmwareState."""

    time_us: int
    lift_height_m: float
    lock_us: int
    unlock_us: int
    press_id: int
    press_state: int
    press_start_us: int
    press_end_us: int
    led_pattern: int
    fault: int
    lift_state: int
    calibration_id: int
    calibration_state: int
    crc: int


class Health(NamedTuple):
    """mtr_msgs/FirmwareHealth."""

    reset_cause: int
    resets: int
    uart_overruns: int
    dropped_bytes: int
    checksum_errors: int
    skipped_frames: int
    refused_commands: int
    worst_loop_us: int
    free_ram: int
    dropped_reports: int
    last_refusal: int
    calibration_copies: int
    stroke_mm: int


class Inputs(NamedTuple):
    """mtr_msgs/FirmwareInputs."""

    time_us: int
    stop: int
    stops: int
    signal: int
    beacon: int
    crc: int


class Topic(NamedTuple):
    """What the device says of a topic."""

    kind: int
    name: str
    type: str
    md5: str
    buffer_bytes: int


def frame(topic: int, payload: bytes = b"") -> bytes:
    """A frame of revision 2."""
    length = struct.pack("<H", len(payload))
    body = struct.pack("<H", topic) + payload
    return b"\xff\xfe" + length + bytes([255 - sum(length) % 256]) + body + bytes([255 - sum(body) % 256])


def sealed(fields: bytes) -> bytes:
    """The fields and their CRC."""
    return fields + struct.pack("<H", binascii.crc_hqx(fields, 0xFFFF))


def command(seq: int, height_m: float, latest_us: int, led: int = 4, stop: int = 0) -> bytes:
    """A FirmwareCommand."""
    return frame(COMMAND, sealed(struct.pack("<IfBBI", seq & 0xFFFFFFFF, height_m, led, stop, latest_us % 2 ** 32)))


def press(id: int, latest_us: int, servos: int = 1, strength: float = 1.0, hold_ms: int = 200) -> bytes:
    """A FirmwarePress."""
    return frame(PRESS, sealed(struct.pack("<IBfHI", id, servos, strength, hold_ms, latest_us % 2 ** 32)))


def calibrate(id: int, stroke_m: float, latest_us: int) -> bytes:
    """A FirmwareCalibrate."""
    return frame(CALIBRATE, sealed(struct.pack("<IfI", id, stroke_m, latest_us % 2 ** 32)))


def signals(latest_us: int, signal: int = 0, beacon: int = 0, stop_input: int = 0) -> bytes:
    """A FirmwareSignals."""
    return frame(SIGNALS, sealed(struct.pack("<BBBI", signal, beacon, stop_input, latest_us % 2 ** 32)))


def split(data: bytearray) -> List[Tuple[int, bytes]]:
    """Takes the whole frames from the start of the data; damaged ones are skipped."""
    found = []
    while len(data) >= HEADER.size:
        sync, revision, length, check, topic = HEADER.unpack_from(data)
        good = (sync, revision) == (0xFF, 0xFE) and (sum(data[2:4]) + check) % 256 == 255 and length < 200
        if good and len(data) < length + 8:
            return found
        if good and sum(data[5:length + 8]) % 256 == 255:
            found.append((topic, bytes(data[7:length + 7])))
            del data[:length + 8]
        else:
            del data[0]
    return found


class Host:
    """Sends commands each 100 ms, answers TIME, repeats a press until its id is reported.

    As the upstream's, it asks for topics when a message comes that it knows nothing of.

    Attributes:
        topics: what the device has announced, by id.
        states, healths, echoes, inputs: all that have arrived.
        signals: fields of the FirmwareSignals sent with each command; None: none is sent.
        height_m, led, stop: sent with each command.
        is_talking: False sends no commands.
        answers_time: False does not answer TIME.
    """

    def __init__(self, board: Emulator):
        self.board = board
        self.topics: Dict[int, Topic] = {}
        self.states: List[State] = []
        self.healths: List[Health] = []
        self.echoes: List[int] = []
        self.inputs: List[Inputs] = []
        self.signals: Optional[Dict[str, int]] = None
        self.damaged_states = 0
        self.height_m = float("nan")
        self.led = 4
        self.is_talking = self.answers_time = True
        self.log: List[Probe] = []
        self.stop = 0
        self._press: Optional[Tuple[int, Dict[str, float]]] = None
        self._outbox: Deque[bytes] = collections.deque()
        self._port = os.open(str(board.pty), os.O_RDWR | os.O_NOCTTY)
        tty.setraw(self._port, termios.TCSANOW)
        self._received = bytearray()
        self._read = self._written = 0
        self._time_us = 0
        self._seq = 0

    def close(self) -> None:
        """Close the port."""
        os.close(self._port)

    @property
    def state(self) -> State:
        """The newest one."""
        return self.states[-1]

    @property
    def latest_us(self) -> int:
        """Firmware's clock up to which an order of now may begin."""
        return (self.state.time_us if self.states else CLOCK_START_US + self._time_us) + LEAD_US

    def send(self, data: bytes) -> None:
        """Send bytes before the next step."""
        self._outbox.append(data)

    def order_press(self, id: int, **fields: float) -> None:
        """Repeat a press with each command until it is reported."""
        self._press = (id, fields)

    def run(self, seconds: float, step_us: int = STEP_US) -> Probe:
        """Let time pass; returns what the board shows then."""
        end_us = self._time_us + round(seconds * 1e6)
        while self._time_us < end_us:
            if self.is_talking and self._time_us % COMMAND_PERIOD_US == 0:
                self._speak()
            self._step(step_us)
            self.log.append(self.board.probe())
        return self.log[-1]

    def _speak(self) -> None:
        self._seq += 1
        if self.signals is not None:
            self._outbox.append(signals(self.latest_us, **self.signals))
        self._outbox.append(command(self._seq, self.height_m, self.latest_us, self.led, self.stop))
        if self._press:
            self._outbox.append(press(self._press[0], self.latest_us, **self._press[1]))

    def _step(self, step_us: int) -> None:
        while self._outbox:
            data = self._outbox.popleft()
            self._written += os.write(self._port, data)
        total = self.board.step(step_us, self._written)["tx"]
        self._time_us += step_us
        while self._read < total:
            chunk = os.read(self._port, total - self._read)
            self._read += len(chunk)
            self._received += chunk
        for topic, payload in split(self._received):
            self._take(topic, payload)

    def _take(self, topic: int, payload: bytes) -> None:
        if topic == TIME:
            self.send(frame(TIME, struct.pack("<II", 1, 0)) if self.answers_time else b"")
        elif topic in (NEGOTIATE, SUBSCRIBER):
            self._announced(topic, payload)
        elif topic not in self.topics:
            self.send(frame(NEGOTIATE))
        elif topic == STATE and len(payload) == STATE_FORMAT.size:
            self._report(payload)
        elif topic == HEALTH and len(payload) == HEALTH_FORMAT.size:
            self.healths.append(Health(*HEALTH_FORMAT.unpack(payload)))
        elif topic == INPUTS and len(payload) == INPUTS_FORMAT.size and sealed(payload[:-2]) == payload:
            self.inputs.append(Inputs(*INPUTS_FORMAT.unpack(payload)))
        elif topic == ECHO and len(payload) == 1:
            self.echoes.append(payload[0])

    def _report(self, payload: bytes) -> None:
        if sealed(payload[:-2]) != payload:
            self.damaged_states += 1
            return
        self.states.append(State(*STATE_FORMAT.unpack(payload)))
        if self._press and self.state.press_id == self._press[0]:
            self._press = None

    def _announced(self, kind: int, payload: bytes) -> None:
        texts, offset = [], 2
        # On a bad line a damaged one may pass the sum; it will be told again when it is missed.
        with contextlib.suppress(UnicodeDecodeError, struct.error):
            for _ in range(3):
                length = struct.unpack_from("<I", payload, offset)[0]
                texts.append(payload[offset + 4:offset + 4 + length].decode("ascii"))
                offset += 4 + length
            topic, buffer_bytes = struct.unpack_from("<H", payload)[0], struct.unpack_from("<i", payload, offset)[0]
            self.topics[topic] = Topic(kind, *texts, buffer_bytes)
