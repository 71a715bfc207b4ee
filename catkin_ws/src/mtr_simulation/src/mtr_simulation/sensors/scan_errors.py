"""What a real LiDAR does wrong beyond white noise: constant offset, mixed pixels, dropouts, drops of rain."""
# SPDX-License-Identifier: Apache-2.0
from dataclasses import dataclass

import numpy as np

from mtr_core import sensor_figures as figures
from mtr_core.arrays import FloatArray
from mtr_core.parameters import ParameterSet, number

# A step from one beam to the next beyond this is the edge of something.
EDGE_M = 0.1
# Rain and spray return a beam from near; farther drops are too faint.
ECHO_NEAREST_M, ECHO_FARTHEST_M = 0.3, 6.0


@dataclass(frozen=True)
class ScanErrors(ParameterSet):
    """Each is off by default.

    Attributes:
        range_bias_m: added to every range.
        opposed_bias_m: added to every range of the front LiDAR and taken off those of the rear one.
        mixed_pixel_share: of the beams at an edge, that return a range between both sides.
        dropout_share: of all beams, that see nothing (black paint, glass).
        echo_share: of all beams, that return from a drop in the air: isolated points that are there for one sweep.
    """

    range_bias_m: float = number(*figures.SIMULATED_RANGE_BIAS_M)
    opposed_bias_m: float = number(*figures.SIMULATED_RANGE_BIAS_M)
    mixed_pixel_share: float = number(*figures.SIMULATED_MIXED_PIXEL_SHARE)
    dropout_share: float = number(*figures.SIMULATED_DROPOUT_SHARE)
    echo_share: float = number(*figures.SIMULATED_ECHO_SHARE)


def with_errors(ranges_m: FloatArray, errors: ScanErrors, noise: np.random.Generator,
                is_rear: bool = False) -> FloatArray:
    """Ranges of one sweep with these errors; infinity is a beam that sees nothing."""
    seen = ranges_m + errors.range_bias_m + (-1.0 if is_rear else 1.0) * errors.opposed_bias_m
    if errors.mixed_pixel_share:
        seen = _mixed(seen, errors.mixed_pixel_share, noise)
    if errors.dropout_share:
        seen = np.where(noise.random(len(seen)) < errors.dropout_share, np.inf, seen)
    if errors.echo_share:
        hit = noise.random(len(seen)) < errors.echo_share
        drops = noise.uniform(ECHO_NEAREST_M, ECHO_FARTHEST_M, len(seen))
        seen = np.where(hit & (drops < seen), drops, seen)
    return seen


def _mixed(ranges_m: FloatArray, share: float, noise: np.random.Generator) -> FloatArray:
    """Some of the beams at an edge fall on both sides of it and return what is between."""
    after = np.append(ranges_m[1:], ranges_m[-1])
    both = np.isfinite(ranges_m) & np.isfinite(after)
    step = np.where(both, after, 0.0) - np.where(both, ranges_m, 0.0)
    mixed = both & (np.abs(step) > EDGE_M) & (noise.random(len(ranges_m)) < share)
    return np.where(mixed, ranges_m + noise.random(len(ranges_m)) * step, ranges_m)
