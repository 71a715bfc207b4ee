"""What repeated readings say: their mean, how sure it is, and how many of them say so."""
# SPDX-License-Identifier: Apache-2.0
import math
import statistics
from dataclasses import dataclass
from typing import Sequence

from mtr_core.errors import RobotError


class ReadingsUnusable(RobotError):
    """The readings tell nothing; the sentence says what to do."""


@dataclass(frozen=True)
class Estimate:
    """A value, its 1 sigma in the same unit, and the degrees of freedom of that sigma."""

    value: float
    sigma: float
    freedom: float


def mean_of(values: Sequence[float], resolution: float = 0.0) -> Estimate:
    """Mean of repeated readings.

    Args:
        resolution: step of the scale that was read; readings that are all alike are not exact, so sigma is at least
            that of a value somewhere in the step (GUM 4.3.7).

    Raises:
        ReadingsUnusable: there are fewer than two.
    """
    if len(values) < 2:
        raise ReadingsUnusable(f"There is {len(values)} reading; at least 2 are needed. Read again.")
    spread = statistics.stdev(values) / math.sqrt(len(values))
    return Estimate(statistics.mean(values), max(spread, resolution / math.sqrt(12.0)), float(len(values) - 1))
