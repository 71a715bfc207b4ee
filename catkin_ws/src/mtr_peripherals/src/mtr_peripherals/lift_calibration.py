"""Calibration of the lift: the order to the firmware, its lifetime, and the result."""
# SPDX-License-Identifier: Apache-2.0
from typing import Callable, NamedTuple, Optional, Tuple

from mtr_core.errors import check_range

UNDER_WAY, DONE, REFUSED = 1, 2, 3
# Limits of FirmwareCalibrate.stroke_m.
MIN_STROKE_M, MAX_STROKE_M = 0.05, 2.0
PERIOD_S, ANSWER_WITHIN_S = 0.1, 3.0
# Limit for the way down and up at the lift's slow speed, with a margin.
DONE_WITHIN_S = 180.0
# Lifetime of an order for the firmware.
LIFETIME_US = 500_000


class Order(NamedTuple):
    """Order to the firmware, with fields of FirmwareCalibrate."""

    id: int
    stroke_m: float
    latest_us: int = 0


class Report(NamedTuple):
    """The firmware's report on its calibration, and its time, with fields of FirmwareState."""

    calibration_id: int
    calibration_state: int
    time_us: int = 0


State = Callable[[], Optional[Report]]


def order_of(stroke_m: float, last_id: int) -> Order:
    """Return an order with an id other than the firmware's last; ConfigurationError for a stroke out of range."""
    check_range("stroke", stroke_m, MIN_STROKE_M, MAX_STROKE_M, "m")
    return Order(last_id % (2 ** 32 - 1) + 1, stroke_m)


def latest_us_of(state: Optional[Report]) -> int:
    """Return the firmware time until which an order is valid; the state is at most 40 ms old."""
    return (state.time_us + LIFETIME_US) % 2 ** 32 if state else 0


def verdict_of(state: Optional[Report], wanted_id: int, waited_s: float) -> Optional[Tuple[bool, str]]:
    """Return True if the calibration has succeeded, with a sentence; None while the result is unknown."""
    if state is None or state.calibration_id != wanted_id:
        return (False, "The firmware has not taken the order.") if waited_s > ANSWER_WITHIN_S else None
    if state.calibration_state == DONE:
        return True, "The lift is calibrated."
    if state.calibration_state == REFUSED:
        return False, "The firmware has refused the calibration, or it has failed; what it knew before stays."
    if waited_s > DONE_WITHIN_S:
        return False, f"The calibration has not ended within {DONE_WITHIN_S:.0f} s; look at the lift."
    return None


class Calibration:
    """Repeats the order until the firmware has finished."""

    def __init__(self, publish: Callable[[Order], None], state: State, sleep: Callable[[float], None]):
        self._publish, self._state, self._sleep = publish, state, sleep

    def run(self, stroke_m: float) -> Tuple[bool, str]:
        """Return True if the calibration has succeeded, with a sentence."""
        for _ in range(round(ANSWER_WITHIN_S / PERIOD_S)):
            state = self._state()
            if state is not None:
                return self._order(order_of(stroke_m, state.calibration_id))
            self._sleep(PERIOD_S)
        return False, "The firmware is silent, so nothing was ordered."

    def _order(self, order: Order) -> Tuple[bool, str]:
        waited_s = 0.0
        while True:
            verdict = verdict_of(self._state(), order.id, waited_s)
            if verdict:
                return verdict
            # Orders are repeated to the end, because the peripherals node aborts a calibration without them.
            self._publish(order._replace(latest_us=latest_us_of(self._state())))
            self._sleep(PERIOD_S)
            waited_s += PERIOD_S
