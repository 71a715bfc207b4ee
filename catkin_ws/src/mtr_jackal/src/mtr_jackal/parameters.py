"""Parameters of the relay of the base's hardware stop."""
# SPDX-License-Identifier: Apache-2.0
from dataclasses import dataclass

from mtr_core.parameters import ParameterSet, number


@dataclass(frozen=True)
class Parameters(ParameterSet):
    """Parameters of the node.

    Attributes:
        silent_after_s: age of the newest status at which the stop counts as engaged. A Jackal sends one per second.
    """

    silent_after_s: float = number(2.5, 1.1, 10.0, "s")
