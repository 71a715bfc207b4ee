"""Parameters of the state machine."""
# SPDX-License-Identifier: Apache-2.0
from dataclasses import dataclass

from mtr_core.liveness import NS
from mtr_core.parameters import ParameterSet, number
from mtr_core.schedule import STATE_MACHINE


@dataclass(frozen=True)
class Parameters(ParameterSet):
    """What the state machine is started with.

    Attributes:
        silent_after_s: age of a part's newest message at which the part has failed at the latest; one tick earlier it
            may.
        resume_by_operator: after a fault, an emergency stop, an obstacle or manual driving the robot stands until the
            Operator has it go on; so it does after a stop by the Operator and after a longer silence of the link.
        hold_after_lost_s: time that the link may be lost without a hold. The dispatcher reports it as lost after its
            link_timeout_s, 1.0 s, so the robot is held after a silence of 2 s.
        empty_battery: charge below which the robot stops and is held once: near it a computer ends without warning.
            The application has lowered the key and ended its test at 10 %.
        signal_s: the signal before motion is given for so long before the robot sets off from rest; 0: no signal.
        signal_after_rest_s: standstill after which the next motion needs the signal; a shorter stop within a test does
            not.
    """

    silent_after_s: float = number(0.5, 0.4, 5.0, "s")
    resume_by_operator: bool = True
    hold_after_lost_s: float = number(1.0, 0.2, 10.0, "s")
    empty_battery: float = number(0.05, 0.0, 0.5)
    signal_s: float = number(2.0, 0.0, 10.0, "s")
    signal_after_rest_s: float = number(5.0, 1.0, 60.0, "s")

    @property
    def noticed_after_s(self) -> float:
        """Age at which a part has failed at a tick: before the next one silent_after_s would be over."""
        return self.silent_after_s - STATE_MACHINE.period_ns * NS
