"""Parameters of the watch."""
# SPDX-License-Identifier: Apache-2.0
from dataclasses import dataclass

from mtr_core.parameters import ParameterSet, number


@dataclass(frozen=True)
class Parameters(ParameterSet):
    """Parameters of the node.

    Attributes:
        open_graph: permits commands past the link from any reachable computer, by a person's choice: an opening is an
            error in the log but does not lock motion.
        look_period_s: between two checks.
    """

    open_graph: bool = False
    look_period_s: float = number(3.0, 0.5, 5.0, "s")
