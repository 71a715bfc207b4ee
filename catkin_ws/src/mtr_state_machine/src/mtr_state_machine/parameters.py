"""Parameters of the state machine."""
# SPDX-License-Identifier: Apache-2.0
from dataclasses import dataclass

from mtr_core.liveness import NS
from mtr_core.parameters import ParameterSet, number
from mtr_core.schedule import STATE_MACHINE


@dataclass(frozen=True)
class Parameters(ParameterSet):
    """Start parameters of the state machine.

    Attributes:
        silent_after_s: age of a part's newest message at which the part has failed at the latest; it may fail one
            tick earlier.
        resume_by_operator: after a fault, an emergency stop, an obstacle or manual driving the robot is on hold
            until the Operator resumes it. The same applies after a stop by the Operator and a longer silence of the
            link.
        hold_after_lost_s: longest loss of the link without a hold. The dispatcher reports a loss after its
            link_timeout_s, 1.0 s, so the robot is on hold after a silence of 2 s.
        empty_battery: charge below which the robot stops and is on hold once, because a computer may then shut down
            without warning. At 10 % the application has already lowered the key and ended its test.
        signal_s: duration of the signal before a robot drives off from rest; 0: no signal.
        signal_after_rest_s: rest after which the next motion needs the signal; a shorter stop within a test needs
            none.
    """

    silent_after_s: float = number(0.5, 0.4, 5.0, "s")
    resume_by_operator: bool = True
    hold_after_lost_s: float = number(1.0, 0.2, 10.0, "s")
    empty_battery: float = number(0.05, 0.0, 0.5)
    signal_s: float = number(2.0, 0.0, 10.0, "s")
    signal_after_rest_s: float = number(5.0, 1.0, 60.0, "s")

    @property
    def noticed_after_s(self) -> float:
        """Age at which a part counts as failed at a tick, because silent_after_s would be over before the next tick."""
        return self.silent_after_s - STATE_MACHINE.period_ns * NS
