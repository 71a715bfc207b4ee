"""The emulator as a process, and its control socket."""
# SPDX-License-Identifier: Apache-2.0
import json
import pathlib
import socket
import subprocess
import tempfile
from dataclasses import dataclass
from typing import Any, Dict, Optional, Sequence, Tuple

BUILD = pathlib.Path(__file__).resolve().parents[3] / "build"
BINARY = BUILD / "mtr_emulator"
MCUS = ("atmega2560", "atmega328p")
START_TIMEOUT_S = 10.0
# The longest step anybody asks for, on a loaded machine.
ANSWER_TIMEOUT_S = 120.0


class EmulatorError(Exception):
    """The emulator did not start, or refused what it was asked."""


@dataclass(frozen=True)
class Probe:
    """What can be seen of the board from outside.

    Attributes:
        time_us: simulated time since power on.
        rx, tx: bytes taken from and given to the pseudo-terminal so far.
        servo_us: width of the newest pulse of lock and unlock servo; 0 when there is none.
        led: green, yellow, red.
        buzzer, beacon: True while the output is on.
        lift_m: true height above the lower stop.
        lift_duty: of the motor, -1 down to 1 up.
        untouched_ram: bytes that were never written since the start.
        resets: of whatever cause, since the start.
        overruns: bytes lost because the firmware did not fetch them in time.
        worst_lag_s: furthest behind the computer's clock; only in real time.
    """

    time_us: int
    rx: int
    tx: int
    servo_us: Tuple[float, float]
    led: Tuple[bool, bool, bool]
    buzzer: bool
    beacon: bool
    lift_m: float
    lift_duty: float
    untouched_ram: int
    resets: int
    overruns: int
    worst_lag_s: float


def firmware_of(mcu: str) -> pathlib.Path:
    """ELF file that `make firmware` builds for a microcontroller."""
    return BUILD / f"mtr_firmware_{mcu}.elf"


class Emulator:
    """A running board: `with Emulator("atmega2560", stepped=True) as board: ...`.

    Attributes:
        pty: path of the serial port for the host, once started.
    """

    def __init__(self, mcu: str, *, stepped: bool = False, elf: Optional[pathlib.Path] = None,
                 folder: Optional[pathlib.Path] = None, options: Sequence[str] = ()):
        self._arguments = ["--elf", str(elf or firmware_of(mcu)), "--mcu", mcu, *(["--stepped"] if stepped else []),
                           *options]
        self._folder = folder
        self._temporary: Optional[tempfile.TemporaryDirectory] = None
        self._process: Optional[subprocess.Popen] = None
        self._socket: Optional[socket.socket] = None
        self._lines: Any = None
        self.pty = pathlib.Path()

    def __enter__(self) -> "Emulator":
        self.start()
        return self

    def __exit__(self, *_: object) -> None:
        self.stop()

    def start(self) -> None:
        """Start the process and wait until its port and its control socket are there."""
        if self._folder is None:
            self._temporary = tempfile.TemporaryDirectory(prefix="mtr_emulator")
        folder = pathlib.Path(self._folder or self._temporary.name)
        self.pty, control = folder / "port", folder / "control"
        command = [str(BINARY), *self._arguments, "--pty", str(self.pty), "--control", str(control)]
        self._process = subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        if self._process.stdout.readline().strip() != "ready":
            _, errors = self._process.communicate(timeout=START_TIMEOUT_S)
            raise EmulatorError(errors.strip())
        self._socket = socket.socket(socket.AF_UNIX)
        self._socket.settimeout(ANSWER_TIMEOUT_S)
        self._socket.connect(str(control))
        self._lines = self._socket.makefile("rw", encoding="ascii")

    def stop(self) -> None:
        """End the process; the EEPROM is saved."""
        if self._socket:
            self._lines.close()
            self._socket.close()
            self._socket = None
        if self._process:
            self._process.terminate()
            self._process.communicate(timeout=START_TIMEOUT_S)
            self._process = None
        if self._temporary:
            self._temporary.cleanup()
            self._temporary = None

    @property
    def pid(self) -> int:
        """Of the running process."""
        return self._process.pid

    def step(self, us: int, rx_bytes: Optional[int] = None) -> Dict[str, int]:
        """Let simulated time pass; rx_bytes: bytes written to the port so far, which shall have arrived before.

        Returns time_us, rx and tx: bytes taken and given so far.
        """
        self.begin_step(us, rx_bytes)
        return self.end_step()

    def begin_step(self, us: int, rx_bytes: Optional[int] = None) -> None:
        """As step, but returns at once; end_step must follow before anything else is asked."""
        self._say(f"step {us}" if rx_bytes is None else f"step {us} {rx_bytes}")

    def end_step(self) -> Dict[str, int]:
        """Wait for the end of the step that was begun; returns what step returns."""
        return self._hear()

    def probe(self) -> Probe:
        """Look at the board."""
        seen = self._ask("probe")
        seen["servo_us"], seen["led"] = tuple(seen["servo_us"]), tuple(seen["led"])
        return Probe(**seen)

    def fault(self, name: str, one_in: int = 0) -> None:
        """Begin or end a fault, see emulator/README.md."""
        self._ask(f"fault {name} {one_in}")

    def set_stop_contact(self, state: str) -> None:
        """Open, close or bounce the contact at the stop input: "open", "closed", "bouncing"."""
        self._ask(f"stop_contact {state}")

    def _ask(self, question: str) -> Dict[str, Any]:
        self._say(question)
        return self._hear()

    def _say(self, question: str) -> None:
        self._lines.write(question + "\n")
        self._lines.flush()

    def _hear(self) -> Dict[str, Any]:
        line = self._lines.readline()
        if not line:
            raise EmulatorError(f"The emulator has ended: {self._process.stderr.read().strip()}")
        answer = json.loads(line)
        if "error" in answer:
            raise EmulatorError(answer["error"])
        del answer["ok"]
        return answer
