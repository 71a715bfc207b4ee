"""Result of a method on one line, with the truth."""
# SPDX-License-Identifier: Apache-2.0
import math
from typing import Dict, List, NamedTuple, Optional

import numpy as np

from mtr_operator.domain.estimation.interval import UNKNOWN, Interval


class LineFound(NamedTuple):
    """One line: intervals of the measured distance and, if there is one, of the 95 % distance, and the effort."""

    truth_m: float
    found: Interval
    presses: int = 0
    time_s: float = 0.0
    way_m: float = 0.0
    truth_95_m: float = math.nan
    found_95: Interval = UNKNOWN


def point(value_m: float, sigma_m: float) -> Interval:
    """Return the interval of a method that reports a value and a sigma."""
    return Interval(value_m, value_m - 1.96 * sigma_m, value_m + 1.96 * sigma_m, sigma_m)


def figures(lines: List[LineFound]) -> Dict[str, Optional[float]]:
    """Return the figures of one method on one kind of Car; the names are a stable interface.

    A line without an interval counts as not covered, unless the method has no intervals at all.
    """
    errors = np.array([line.found.value_m - line.truth_m for line in lines])
    far = [line for line in lines if math.isfinite(line.truth_95_m)]
    sure = [line for line in lines if is_known(line.found)]
    return {
        "lines": float(len(lines)), "bias_m": float(np.mean(errors)), "rms_m": float(np.sqrt(np.mean(errors ** 2))),
        "coverage_95": share([line.found.holds(line.truth_m) for line in lines]) if sure else None,
        "half_width_median_m": float(np.median([line.found.half_width_m for line in sure])) if sure else None,
        "d95_bias_m": float(np.mean([line.found_95.value_m - line.truth_95_m for line in far])) if far else None,
        "d95_coverage_95": share([line.found_95.holds(line.truth_95_m) for line in far]),
        "presses_median": float(np.median([line.presses for line in lines])),
        "robot_time_s_median": float(np.median([line.time_s for line in lines])),
        "way_m_median": float(np.median([line.way_m for line in lines])),
    }


def is_known(interval: Interval) -> bool:
    """Return True if value and both ends are finite."""
    return math.isfinite(interval.value_m) and math.isfinite(interval.half_width_m)


def without_interval(lines: List[LineFound]) -> int:
    """Return the number of lines without an interval, also of the 95 % distance if there is one."""
    return sum(not is_known(line.found) or (math.isfinite(line.truth_95_m) and not is_known(line.found_95))
               for line in lines)


def share(values: List[bool]) -> Optional[float]:
    """Return the share of true values; None without values."""
    return float(np.mean(values)) if values else None


# Distance of the limit beyond the Car's distance: a Car just outside the limit, slightly, and far.
BEYOND_M = (0.0, 0.1, 1.0)


def false_passes(lines: List[LineFound]) -> Dict[str, float]:
    """Return the share of verdicts Pass on Cars that must fail, by limit; only lines with an interval have a verdict.

    The verdict is Pass if the whole 95 % interval is on the good side of the limit (guard band, JCGM 106), as in
    mtr_operator.domain.verdict.
    """
    shares = {}
    lines = [line for line in lines if is_known(line.found)]
    for beyond_m in BEYOND_M:
        shares[f"at least, missed by {beyond_m:g} m"] = share([line.found.low_m >= line.truth_m + beyond_m
                                                               for line in lines])
        shares[f"at most, missed by {beyond_m:g} m"] = share([line.found.high_m <= line.truth_m - beyond_m
                                                              for line in lines])
    return {name: math.nan if value is None else value for name, value in shares.items()}
