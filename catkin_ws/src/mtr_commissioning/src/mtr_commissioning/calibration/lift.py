"""The lift's height: what the robot says of the key's height against a tape measure."""
# SPDX-License-Identifier: Apache-2.0
from dataclasses import dataclass
from typing import Sequence, Tuple

import numpy as np

from .readings import Estimate, ReadingsUnusable

MIN_HEIGHTS = 3
MIN_SPAN_M = 0.3


@dataclass(frozen=True)
class HeightError:
    """Tape less what the robot says, m: in the middle of the heights, and the largest beside the straight line.

    scale: by which a travel that the robot says has to be multiplied.
    """

    middle: Estimate
    scale: float
    largest_m: float


def height_error(pairs: Sequence[Tuple[float, float]]) -> HeightError:
    """From heights above ground in m as the robot said and as the tape showed.

    Raises:
        ReadingsUnusable: fewer than three, or too near to each other.
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
