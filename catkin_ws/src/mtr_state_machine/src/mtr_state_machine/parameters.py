"""Parameters of the state machine."""
# SPDX-License-Identifier: Apache-2.0
from dataclasses import dataclass

from mtr_core.parameters import ParameterSet, number


@dataclass(frozen=True)
class Parameters(ParameterSet):
    """What the state machine is started with.

    Attributes:
        silent_after_s: age of a part's newest message at which the part has failed.
        resume_by_operator: after a fault, an obstacle or manual driving the robot stands until the Operator has it go
            on.
    """

    silent_after_s: float = number(0.5, 0.2, 5.0, "s")
    resume_by_operator: bool = True
