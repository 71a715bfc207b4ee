"""The peripherals' firmware as the host sees it: lift, servos, LEDs, and what it does when the host falls silent."""
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

# Its clock starts two minutes before it wraps, so that each longer run meets the wrap (each 71 minutes on hardware).
CLOCK_START_US = (1 << 32) - 120_000_000
CLOCK_WRAP_US = 1 << 32
# An order that may begin later is one of another clock.
MAX_LEAD_US = 5_000_000
# A host may repeat a request for some time after the next one; these many ids are remembered.
_REMEMBERED_IDS = 16


class State(NamedTuple):
    """Fields of mtr_msgs/FirmwareState but the check sum."""

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
    """Board without a board: command and press arrive from the host, step lets 20 ms pass.

    Attributes:
        refused_commands: commands that asked for what cannot be; the lift ignored them.
        lift_is_stuck: the lift does not move, and its sensor says so.
        servos_are_dead: they do not move, and nothing says so.
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
        """Pulse widths of lock and unlock servo, as they press on the key."""
        return (RELEASED_US, RELEASED_US) if self.servos_are_dead else self._presser.servo_us

    def command(self, lift_height_m: float, led_pattern: int, stop: bool = False,
                latest_us: Optional[int] = None) -> None:
        """Take a FirmwareCommand; a height that is out of range leaves the lift's order as it was."""
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
        """Take a FirmwareSignals."""
        if self._is_late(latest_us) or not self.inputs.order(signal, has_beacon, uses_stop_input, self._now_ns):
            self.refused_commands += 1
        elif self.inputs.is_stopped:
            self._hold()

    def press(self, id: int, servos: int, strength: float, hold_ms: int, latest_us: Optional[int] = None) -> None:
        """Take a FirmwarePress. What has been taken once, done or refused, is not taken again."""
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
        """Power off; there is nothing to do."""

    def stand(self, duration_ns: int) -> None:
        """The world stands still for so long, and the microcontroller's clock goes on."""
        self._clock_start_us += round(duration_ns * 1e-3)

    def begin_step(self, time_ns: int) -> None:
        """Its step takes no time worth sharing; there is nothing to begin."""

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
        """What it reports to the host now."""
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
        """What it reports of its inputs and signals now."""
        return self.inputs.state(self._clock_us(self._now_ns))

    def _hold(self) -> None:
        self._lift.order(math.nan)
        self._abort_press()

    def _is_receiving(self) -> bool:
        """Note that the host lives; False before the first step, when the board has no power yet."""
        self._received_ns = self._now_ns
        self._fault = 0
        return self._boot_ns is not None

    def _lose_link(self) -> None:
        self._fault, self._led = FAULT_LINK_LOST, LED_LINK_LOST
        self.inputs.signal = 0
        self._hold()

    def _is_late(self, latest_us: Optional[int]) -> bool:
        """True for an order that was under way for too long, or meant for another clock; None: it is never late."""
        if latest_us is None or self._boot_ns is None:
            return False
        return (latest_us - self._clock_us(self._now_ns)) % CLOCK_WRAP_US > MAX_LEAD_US

    def _abort_press(self) -> None:
        if self._presser.is_busy:
            self._presser.abort(self._now_ns)
            # A travel that was cut short may have pressed or not: nobody shall rely on it.
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
