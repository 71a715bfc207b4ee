"""Errors of a real LiDAR in addition to white noise: constant offset, mixed pixels, dropouts and raindrops."""
# SPDX-License-Identifier: Apache-2.0
from dataclasses import dataclass

import numpy as np

from mtr_core import sensor_figures as figures
from mtr_core.arrays import FloatArray
from mtr_core.parameters import ParameterSet, number

# Smallest step between neighbouring beams that counts as an edge.
EDGE_M = 0.1
# Range of echoes from rain and spray; drops at larger distances are too faint.
ECHO_NEAREST_M, ECHO_FARTHEST_M = 0.3, 6.0


@dataclass(frozen=True)
class ScanErrors(ParameterSet):
    """Errors of a scan; each is off by default.

    Attributes:
        range_bias_m: added to every range.
        opposed_bias_m: added to every range of the front LiDAR and subtracted from the rear LiDAR's ranges.
        mixed_pixel_share: share of the beams at an edge that return a range between both sides.
        dropout_share: share of all beams without a return (black paint, glass).
        echo_share: share of all beams that return from a raindrop: isolated points that exist for one sweep.
    """

    range_bias_m: float = number(*figures.SIMULATED_RANGE_BIAS_M)
    opposed_bias_m: float = number(*figures.SIMULATED_RANGE_BIAS_M)
    mixed_pixel_share: float = number(*figures.SIMULATED_MIXED_PIXEL_SHARE)
    dropout_share: float = number(*figures.SIMULATED_DROPOUT_SHARE)
    echo_share: float = number(*figures.SIMULATED_ECHO_SHARE)


def with_errors(ranges_m: FloatArray, errors: ScanErrors, noise: np.random.Generator,
                is_rear: bool = False) -> FloatArray:
    """Return the ranges of one sweep with these errors; infinity is a beam without a return."""
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
    """Return the ranges with mixed pixels: some beams at an edge cover both sides and return a range between them."""
    after = np.append(ranges_m[1:], ranges_m[-1])
    both = np.isfinite(ranges_m) & np.isfinite(after)
    step = np.where(both, after, 0.0) - np.where(both, ranges_m, 0.0)
    mixed = both & (np.abs(step) > EDGE_M) & (noise.random(len(ranges_m)) < share)
    return np.where(mixed, ranges_m + noise.random(len(ranges_m)) * step, ranges_m)
