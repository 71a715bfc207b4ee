"""Range of a probability along a line, also with holes caused by fading and nulls.

p(d) of a real Car neither falls steadily nor crosses 50 % only once. Its range is defined by the non-increasing curve
with the least squared distance from it, over equal steps of distance. This is antitonic regression by pooling adjacent
violators (Barlow et al., Statistical Inference under Order Restrictions, 1972). If p falls steadily, the curve is p.
"""
# SPDX-License-Identifier: Apache-2.0
import math
from typing import List, Tuple

import numpy as np

from mtr_core.arrays import FloatArray


def falling(values: FloatArray) -> FloatArray:
    """Return the non-increasing curve that is nearest to the values."""
    blocks: List[Tuple[float, int]] = []
    for value in values.tolist():
        mean, count = value, 1
        while blocks and blocks[-1][0] < mean:
            before, before_count = blocks.pop()
            mean = (mean * count + before * before_count) / (count + before_count)
            count += before_count
        blocks.append((mean, count))
    return np.repeat([mean for mean, _ in blocks], [count for _, count in blocks])


def falls_below(distances_m: FloatArray, values: FloatArray, level: float) -> float:
    """Return the distance at which the non-increasing curve passes the level; NaN if it is always below or always
    above."""
    curve = falling(values)
    below = np.flatnonzero(curve < level)
    if len(below) == 0 or below[0] == 0:
        return math.nan
    i = below[0]
    share = (curve[i - 1] - level) / (curve[i - 1] - curve[i])
    return float(distances_m[i - 1] + share * (distances_m[i] - distances_m[i - 1]))
