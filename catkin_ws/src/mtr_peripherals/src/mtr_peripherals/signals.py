"""Warning signals of the robot: which one, and whether the board reports it as given."""
# SPDX-License-Identifier: Apache-2.0
from typing import Optional

from mtr_core.liveness import NS, is_fresh

from .firmware import InputsReport, Signal, SignalOrder, StopInput

# FirmwareInputs come every 80 ms.
SIGNAL_SILENT_S = 0.5
# A closed input that is reported later says nothing; drive control then treats the topic as silent after 0.25 s.
STOP_LATE_S = 0.15


def signal_order(sets_off: bool, linear_mps: float, is_controlled: bool, uses_stop_input: bool) -> SignalOrder:
    """Return the signals at a tick.

    linear_mps: velocity sent to the wheels. is_controlled: an application controls the robot, which may move at any
    time; the beacon shows it.
    """
    signal = Signal.SETS_OFF if sets_off else Signal.REVERSES if linear_mps < 0.0 else Signal.NONE
    has_beacon = sets_off or is_controlled or linear_mps != 0.0
    return SignalOrder(signal, has_beacon, uses_stop_input)


def given_signal(report: Optional[InputsReport], now_ns: int) -> int:
    """Return the signal that the board reports as given; none when it is silent."""
    if report is None or not is_fresh((now_ns - report.stamp_ns) * NS, SIGNAL_SILENT_S):
        return Signal.NONE.value
    return report.signal


def is_stop(state: int, age_s: float) -> Optional[bool]:
    """Return whether a report of the stop input means stop: any state but closed does, however old it is.

    None for a closed input whose report waited on its way; it says nothing about now.
    """
    if state != StopInput.CLOSED.value:
        return True
    return False if is_fresh(age_s, STOP_LATE_S) else None
