"""The core of the peripherals with a fake firmware, for its tests."""
# SPDX-License-Identifier: Apache-2.0
from dataclasses import replace

from mtr_core.requests import DesiredState, Press
from mtr_description.shipped import shipped_geometry
from mtr_peripherals import problems
from mtr_peripherals.core import Inputs, Peripherals
from mtr_peripherals.firmware import FirmwareReport, PressState
from mtr_peripherals.key_lift import KeyLift
from mtr_peripherals.parameters import Parameters

MS = 1_000_000
TICK = 100 * MS
START = 1_000 * MS
STARTING, READY, FOLLOWING, FAULT = 1, 2, 4, 5
LIVE = Inputs(DesiredState(session_id=3, link_alive=True, stop=False), FOLLOWING)
PRESS = Press(1, 3, (2,), 0.8, 0.25)


def desired(inputs=LIVE, **changes):
    """Return inputs with changes of the desired state."""
    return replace(inputs, desired=replace(inputs.desired, **changes))


PRESSING_LIVE = desired(press=PRESS)
ENGAGED = problems.EMERGENCY_ENGAGED(owner="controller_input")


class FakeFirmware:
    """Executes one press at a time, like the firmware, in whole ticks.

    Attributes:
        pressed: ids that were pressed, in order.
        deaf: number of press messages that get lost.
        refuses: every press is refused.
    """

    def __init__(self, last_id=0):
        self.pressed, self.deaf, self.refuses = [], 0, False
        self.report = FirmwareReport(START, press_id=last_id,
                                     press_state=PressState.DONE if last_id else PressState.NONE)

    def step(self, order, now_ns):
        report = replace(self.report, stamp_ns=now_ns)
        if report.press_state is PressState.PRESSING and now_ns >= report.press_end_ns:
            report = replace(report, press_state=PressState.DONE)
        if order and self.deaf:
            self.deaf -= 1
        elif order and order.id != report.press_id:
            self.pressed.append(order)
            state = PressState.REFUSED if self.refuses else PressState.PRESSING
            report = replace(report, press_id=order.id, press_state=state, press_start_ns=now_ns,
                             press_end_ns=now_ns + order.hold_ms * MS)
        self.report = report


def restarted():
    """Return the core of a node that has just started, without any received message."""
    return Peripherals(Parameters(), KeyLift(shipped_geometry().key()))


def run(core, inputs, firmware, ticks, first=0):
    """Step core and firmware alternately; return the last outcome."""
    for i in range(first, first + ticks):
        outcome = core.step(inputs, firmware.report, START + i * TICK)
        firmware.step(outcome.press, START + i * TICK)
    return outcome
