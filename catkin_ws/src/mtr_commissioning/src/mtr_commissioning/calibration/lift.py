"""Calibrates the lift's height: the robot's key height compared with a tape measure."""
# SPDX-License-Identifier: Apache-2.0
from dataclasses import dataclass
from typing import Sequence, Tuple

import numpy as np

from .readings import Estimate, ReadingsUnusable

MIN_HEIGHTS = 3
MIN_SPAN_M = 0.3


@dataclass(frozen=True)
class HeightError:
    """Tape measure less reported height, m: at the middle height, and the largest deviation from a straight line.

    scale: factor from reported to true travel.
    """

    middle: Estimate
    scale: float
    largest_m: float


def height_error(pairs: Sequence[Tuple[float, float]]) -> HeightError:
    """Evaluate pairs of reported and true heights above ground in m.

    Raises:
        ReadingsUnusable: fewer than three, or too close together.
    """
    if len(pairs) < MIN_HEIGHTS:
        raise ReadingsUnusable(f"There are {len(pairs)} heights; at least {MIN_HEIGHTS} are needed.")
    said, tape = (np.array(column) for column in zip(*pairs))
    if np.ptp(said) < MIN_SPAN_M:
        raise ReadingsUnusable(f"The heights are {np.ptp(said):.2f} m apart; at least {MIN_SPAN_M:.2f} m are needed.")
    errors = tape - said
    rows = np.column_stack((np.ones_like(said), said - said.mean()))
    offset, slope = np.linalg.lstsq(rows, errors, rcond=None)[0]
    freedom = len(said) - 2
    deviation = float(np.sqrt(np.sum((errors - rows @ (offset, slope)) ** 2) / freedom))
    return HeightError(Estimate(float(offset), deviation / len(said) ** 0.5, float(freedom)), 1.0 + float(slope),
                       float(np.max(np.abs(errors))))
