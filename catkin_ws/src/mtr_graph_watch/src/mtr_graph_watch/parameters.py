"""Parameters of the watch."""
# SPDX-License-Identifier: Apache-2.0
from dataclasses import dataclass

from mtr_core.parameters import ParameterSet, number


@dataclass(frozen=True)
class Parameters(ParameterSet):
    """What the node is started with.

    Attributes:
        open_graph: whoever reaches the robot may command it past the link, by a person's choice: an opening is an
            error in the log and locks nothing.
        look_period_s: between two looks.
    """

    open_graph: bool = False
    look_period_s: float = number(3.0, 0.5, 5.0, "s")
