"""Peripherals' firmware as seen by the host: lift, servos, LEDs, and the reaction to a silent host."""
# SPDX-License-Identifier: Apache-2.0
import collections
import math
from typing import Deque, NamedTuple, Optional, Tuple

from .lift import Lift
from .press import RELEASED_US, Presser, PressRequest, PressState
from .signals import InputState, Signals

SILENCE_LIMIT_NS = 1_000_000_000
FAULT_LINK_LOST = 3
LED_LINK_LOST = 8
LED_LAST = 10
LED_SETS_OFF = 10
SIGNAL_SETS_OFF = 1

# Initial clock, two minutes before it wraps, so that every longer run includes the wrap (every 71 minutes on hardware).
CLOCK_START_US = (1 << 32) - 120_000_000
CLOCK_WRAP_US = 1 << 32
# An order with a later deadline belongs to another clock.
MAX_LEAD_US = 5_000_000
# Number of remembered ids, because a host may repeat a request for some time after the next one.
_REMEMBERED_IDS = 16


class State(NamedTuple):
    """Fields of mtr_msgs/FirmwareState except the checksum."""

    time_us: int
    lift_height_m: float
    servo_us: Tuple[int, int]
    press_id: int
    press_state: int
    press_start_us: int
    press_end_us: int
    led_pattern: int
    fault: int
    lift_state: int
    calibration_id: int
    calibration_state: int


class SimulatedFirmware:
    """Simulated board: commands and presses arrive from the host, step advances by 20 ms.

    Attributes:
        refused_commands: number of impossible commands, which the lift ignored.
        lift_is_stuck: the lift does not move, and its sensor shows it.
        servos_are_dead: the servos do not move, and no sensor shows it.
        inputs: stop input, buzzer and beacon.
    """

    def __init__(self, clock_start_us: int = CLOCK_START_US):
        self.refused_commands = 0
        self.lift_is_stuck = self.servos_are_dead = False
        self._clock_start_us = clock_start_us
        self._boot_ns: Optional[int] = None
        self._now_ns = 0
        self._received_ns = 0
        self._lift = Lift()
        self._presser = Presser()
        self._running_id = 0
        self._seen_ids: Deque[int] = collections.deque(maxlen=_REMEMBERED_IDS)
        self._press_id = 0
        self._press_state = PressState.NONE
        self._press_start_us = 0
        self._press_end_us = 0
        self._led = 0
        self._fault = 0
        self._stopped = False
        self.inputs = Signals()

    @property
    def lift_height_m(self) -> float:
        """Height above the lower stop."""
        return self._lift.height_m

    @property
    def servo_us(self) -> Tuple[float, float]:
        """Pulse widths of lock and unlock servo that act on the key."""
        return (RELEASED_US, RELEASED_US) if self.servos_are_dead else self._presser.servo_us

    def command(self, lift_height_m: float, led_pattern: int, stop: bool = False,
                latest_us: Optional[int] = None) -> None:
        """Execute a FirmwareCommand; a height out of range does not change the lift's order."""
        if self._is_late(latest_us):
            self.refused_commands += 1
            return
        if not self._is_receiving():
            return
        self._stopped = stop
        stop = stop or self.inputs.is_stopped
        if stop:
            self._abort_press()
        if not self._lift.order(math.nan if stop else lift_height_m):
            self.refused_commands += 1
        if 0 <= led_pattern <= LED_LAST:
            self._led = led_pattern

    def signals(self, signal: int, has_beacon: bool, uses_stop_input: bool, latest_us: Optional[int] = None) -> None:
        """Execute a FirmwareSignals message."""
        if self._is_late(latest_us) or not self.inputs.order(signal, has_beacon, uses_stop_input, self._now_ns):
            self.refused_commands += 1
        elif self.inputs.is_stopped:
            self._hold()

    def press(self, id: int, servos: int, strength: float, hold_ms: int, latest_us: Optional[int] = None) -> None:
        """Execute a FirmwarePress. A press that was done or refused before is ignored."""
        is_late = self._is_late(latest_us)
        if not (is_late or self._is_receiving()) or id == 0 or id in self._seen_ids:
            return
        self._seen_ids.append(id)
        request = PressRequest(id, servos, strength, hold_ms)
        if is_late or self._stopped or self.inputs.is_stopped or self._presser.is_busy or not request.is_valid():
            self._report(id, PressState.REFUSED)
            return
        self._presser.start(request, self._now_ns)
        self._running_id = id
        self._report(id, PressState.PRESSING, start_ns=self._presser.reached_ns)

    def start(self, time_ns: int) -> None:
        """Power on."""
        self.step(time_ns)

    def close(self) -> None:
        """Power off; nothing to release."""

    def stand(self, duration_ns: int) -> None:
        """Advance the microcontroller's clock while the world stops."""
        self._clock_start_us += round(duration_ns * 1e-3)

    def begin_step(self, time_ns: int) -> None:
        """Do nothing: a step is too short for parallel execution."""

    def step(self, time_ns: int) -> None:
        """Advance to time_ns."""
        if self._boot_ns is None:
            self._boot_ns = self._received_ns = self._now_ns = time_ns
        dt_s = (time_ns - self._now_ns) * 1e-9
        self._now_ns = time_ns
        if time_ns - self._received_ns > SILENCE_LIMIT_NS:
            self._lose_link()
        if self.inputs.step(time_ns):
            self._hold()
        if dt_s > 0.0 and not self.lift_is_stuck:
            self._lift.step(dt_s)
        released_ns = self._presser.step(time_ns)
        if released_ns is not None:
            self._report(self._running_id, PressState.DONE, self._presser.reached_ns, released_ns)

    def state(self) -> State:
        """Return the current report to the host."""
        lock_us, unlock_us = self._presser.servo_us
        return State(
            time_us=self._clock_us(self._now_ns),
            lift_height_m=self._lift.height_m,
            servo_us=(round(lock_us), round(unlock_us)),
            press_id=self._press_id,
            press_state=int(self._press_state),
            press_start_us=self._press_start_us,
            press_end_us=self._press_end_us,
            led_pattern=LED_SETS_OFF if self.inputs.signal == SIGNAL_SETS_OFF else self._led,
            fault=self._fault,
            lift_state=int(abs(self._lift.speed_mps) > 0.0),
            calibration_id=0,
            calibration_state=0,
        )

    def input_state(self) -> InputState:
        """Return the current report of inputs and signals."""
        return self.inputs.state(self._clock_us(self._now_ns))

    def _hold(self) -> None:
        self._lift.order(math.nan)
        self._abort_press()

    def _is_receiving(self) -> bool:
        """Register a sign of life of the host; return False before the first step, while the board has no power."""
        self._received_ns = self._now_ns
        self._fault = 0
        return self._boot_ns is not None

    def _lose_link(self) -> None:
        self._fault, self._led = FAULT_LINK_LOST, LED_LINK_LOST
        self.inputs.signal = 0
        self._hold()

    def _is_late(self, latest_us: Optional[int]) -> bool:
        """Return True if an order was delayed for too long or belongs to another clock; None: it is never late."""
        if latest_us is None or self._boot_ns is None:
            return False
        return (latest_us - self._clock_us(self._now_ns)) % CLOCK_WRAP_US > MAX_LEAD_US

    def _abort_press(self) -> None:
        if self._presser.is_busy:
            self._presser.abort(self._now_ns)
            # An interrupted travel may or may not have pressed, so its result must not be relied on.
            reached_ns = self._presser.reached_ns
            done = self._now_ns >= reached_ns
            self._report(self._running_id, PressState.DONE if done else PressState.REFUSED, reached_ns, self._now_ns)

    def _report(self, id: int, state: PressState, start_ns: Optional[int] = None, end_ns: Optional[int] = None) -> None:
        self._press_id, self._press_state = id, state
        self._press_start_us = 0 if start_ns is None else self._clock_us(start_ns)
        self._press_end_us = 0 if end_ns is None else self._clock_us(end_ns)

    def _clock_us(self, time_ns: int) -> int:
        boot_ns = self._boot_ns or 0
        return ((time_ns - boot_ns) // 1000 + self._clock_start_us) & 0xFFFFFFFF
