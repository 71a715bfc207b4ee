"""The peripherals' core and the host's session with the flashed firmware on an emulated board, in step."""
# SPDX-License-Identifier: Apache-2.0
import io
import pathlib
from typing import Any, List, Optional, Tuple

from mtr_core import names
from mtr_core.crc import is_sound
from mtr_core.problems import NO_PROBLEM, Problem
from mtr_core.requests import NO_PRESS, DesiredState, Press, PressReport
from mtr_core.states import State
from mtr_description.shipped import shipped_geometry
from mtr_emulator import Emulator
from mtr_msgs.msg import FirmwareState
from mtr_peripherals.conversions import firmware_report
from mtr_peripherals.core import Inputs, Outcome, Peripherals
from mtr_peripherals.firmware_clock import FirmwareClock
from mtr_peripherals.key_lift import KeyLift
from mtr_peripherals.orders import FirmwareOrders
from mtr_peripherals.parameters import Parameters
from mtr_serial_link.connections import md5_of
from mtr_simulation.firmware.emulated import EmulatedFirmware

ELF = pathlib.Path(__file__).resolve().parents[2] / "firmware" / "build" / "mtr_firmware_atmega2560.elf"
TICK_NS = 20_000_000
DECISION_TICKS = 5
NS = 1e-9
START_NS = 1_000_000_000
SESSION = 5
RELEASED_US = 1000


def new_core() -> Peripherals:
    """The peripherals as they start."""
    return Peripherals(Parameters(), KeyLift(shipped_geometry().key()))


class EmulatedBoard:
    """Everything between the desired state and the servo, without the wires of ROS.

    Attributes:
        board: the emulator, for faults and probes.
        outcome: of the newest decision.
        pulses: (time ns, pulse of the lock servo in us) at each tick.
        heights: (time ns, true height of the lift in m) at each tick.
        results: all presses that ended, in order.
    """

    def __init__(self) -> None:
        self.board = Emulator("atmega2560", stepped=True, elf=ELF)
        self._firmware = EmulatedFirmware(self.board, md5_of)
        self._core = new_core()
        self._clock = FirmwareClock()
        self._orders = self._new_orders()
        self._report: Any = None
        self._waiting: Optional[List[Tuple[str, bytes]]] = None
        self._ticks = 0
        self.now_ns = START_NS
        self.outcome: Optional[Outcome] = None
        self.pulses: List[tuple] = []
        self.heights: List[tuple] = []
        self.results: List[PressReport] = []

    def __enter__(self) -> "EmulatedBoard":
        self._firmware.start(START_NS)
        return self

    def __exit__(self, *_: object) -> None:
        self._firmware.close()

    def run(self, duration_s: float, key_height_m: float, press: Press = NO_PRESS, stop: bool = False,
            emergency: Problem = NO_PROBLEM) -> None:
        """Let time pass with these requests; stop is the Operator's."""
        desired = DesiredState(session_id=SESSION, link_alive=True, stop=stop, key_height_m=key_height_m, press=press)
        inputs = Inputs(desired, State.FOLLOWING_WAYPOINT, emergency=emergency)
        if emergency and self.outcome and not self.outcome.stop:
            # As the node does it, without waiting for the next tick.
            self._decide(inputs)
        for _ in range(round(duration_s / (TICK_NS * NS))):
            if self._ticks % DECISION_TICKS == 0:
                self._decide(inputs)
            self._ticks += 1
            self.now_ns += TICK_NS
            self._firmware.step(self.now_ns)
            self._listen()
            self.pulses.append((self.now_ns, self._firmware.servo_us[0]))
            self.heights.append((self.now_ns, self._firmware.lift_height_m))

    def closings(self) -> int:
        """How often the lock servo has left its released place."""
        pressed = [pulse > RELEASED_US + 500 for _, pulse in self.pulses]
        return sum(now and not before for before, now in zip([False, *pressed], pressed))

    def _decide(self, inputs: Inputs) -> None:
        self.outcome = self._core.step(inputs, self._report, self.now_ns)
        for result in self.outcome.results:
            if result not in self.results:
                self.results.append(result)
        self._orders.send(self.outcome, self.now_ns)

    def restart_node(self) -> None:
        """The peripherals' node starts again and knows nothing."""
        self._core, self._clock, self._report = new_core(), FirmwareClock(), None
        self._orders = self._new_orders()

    def _new_orders(self) -> FirmwareOrders:
        return FirmwareOrders(self._clock, lambda message: self._send(names.FIRMWARE_COMMAND, message),
                              lambda message: self._send(names.FIRMWARE_PRESS, message),
                              lambda message: self._send(names.FIRMWARE_SIGNALS, message))

    def ask_again(self, damaged: bytes) -> None:
        """The host asks for all topics anew; the first byte of this text in the answer is flipped on the line, once."""
        read, left = self._firmware._read, [damaged]

        def read_damaged(total: int) -> bytes:
            data = bytearray(read(total))
            at = data.find(left[0]) if left else -1
            if at >= 0:
                data[at] ^= 1
                left.clear()
            return bytes(data)
        self._firmware._read = read_damaged
        self._firmware.session.endpoints.clear()
        self._firmware.session.start(self.now_ns * NS)

    def hold_line(self) -> None:
        """What is ordered from now on waits in the host, as in a program that is stopped."""
        self._waiting = []

    def release_line(self) -> None:
        """What has waited leaves, and what is ordered from now on."""
        waiting, self._waiting = self._waiting or [], None
        for topic, payload in waiting:
            self._firmware.send(topic, payload)

    def _send(self, topic: str, message: Any) -> None:
        buffer = io.BytesIO()
        message.serialize(buffer)
        if self._waiting is None:
            self._firmware.send(topic, buffer.getvalue())
        else:
            self._waiting.append((topic, buffer.getvalue()))

    def _listen(self) -> None:
        for topic, payload in self._firmware.take_messages():
            if topic != names.FIRMWARE_STATE:
                continue
            state = FirmwareState().deserialize(payload)
            if is_sound(state):
                stamp_ns = self._clock.observe(state.time_us, self.now_ns)
                self._report = firmware_report(state, stamp_ns, self._clock)
