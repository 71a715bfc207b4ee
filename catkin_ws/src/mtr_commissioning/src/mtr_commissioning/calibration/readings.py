"""Statistics of repeated readings: mean, uncertainty and degrees of freedom."""
# SPDX-License-Identifier: Apache-2.0
import math
import statistics
from dataclasses import dataclass
from typing import Sequence

from mtr_core.errors import RobotError


class ReadingsUnusable(RobotError):
    """The readings are unusable; the sentence states the remedy."""


@dataclass(frozen=True)
class Estimate:
    """A value, its 1 sigma in the same unit, and the degrees of freedom of that sigma."""

    value: float
    sigma: float
    freedom: float


def mean_of(values: Sequence[float], resolution: float = 0.0) -> Estimate:
    """Return the mean of repeated readings.

    Args:
        resolution: step of the scale; equal readings are not exact, so sigma is at least that of a uniform value within
            the step (GUM 4.3.7).

    Raises:
        ReadingsUnusable: fewer than two readings.
    """
    if len(values) < 2:
        raise ReadingsUnusable(f"There is {len(values)} reading; at least 2 are needed. Read again.")
    spread = statistics.stdev(values) / math.sqrt(len(values))
    return Estimate(statistics.mean(values), max(spread, resolution / math.sqrt(12.0)), float(len(values) - 1))
