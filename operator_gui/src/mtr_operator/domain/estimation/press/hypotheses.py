"""Hypotheses on a radial: a grid over distance, width, rate of random misses (lapse), and permanent part of the fading.

An array over the grid has the axes [shared, lapse, width, d50]. The first three are the shape of the transition, which
belongs to Car and key and is common to the radials of a campaign; d50 belongs to the radial.
"""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np

from ..interval import FloatArray

# Widths beyond these are indistinguishable: the pose of the key is known to 2 mm, and 10 m is wider than the effect of
# 8 dB fading at a range of 10 m (docs of the range benchmark).
MIN_WIDTH_M, MAX_WIDTH_M = 0.05, 12.0
WIDTH_RATIO = 1.25
LAPSES, LAPSE_PRIOR = (0.0, 0.03), (0.7, 0.3)
# Share of the latent variance that is fixed in space: noise in time alone, and 5 to 8 dB of fading next to 1 to 3 dB of
# noise in time.
SHARED = (0.0, 0.85)
# Prior probability of fading. Few UHF radios have no standing waves. A low-frequency field has none: its wavelength is
# kilometres. Steel nearby distorts it, and with a smaller probability the intervals of Handle request were too wide.
UHF_FADING, LF_FADING = 0.85, 0.35
# Share of the searched range by which d50 may lie outside it.
MARGIN_SHARE = 0.25


@dataclass(frozen=True)
class Hypotheses:
    """The grid. d50_m has equal steps of step_m; width_m has equal ratios; fading: its prior probability."""

    d50_m: FloatArray
    width_m: FloatArray
    step_m: float
    fading: float = UHF_FADING
    lapse: FloatArray = field(default_factory=lambda: np.array(LAPSES))
    shared: FloatArray = field(default_factory=lambda: np.array(SHARED))

    @property
    def shape_size(self) -> tuple[int, int, int]:
        """Numbers of shared parts, rates of random misses and widths."""
        return len(self.shared), len(self.lapse), len(self.width_m)

    @property
    def edges_m(self) -> FloatArray:
        """Borders between neighbouring d50."""
        return np.append(self.d50_m - self.step_m / 2.0, self.d50_m[-1] + self.step_m / 2.0)

    def shape_prior(self) -> FloatArray:
        """Return the prior: uniform in the logarithm of the width; axes [shared, lapse, width]."""
        widths = np.full(len(self.width_m), 1.0 / len(self.width_m))
        shared = (1.0 - self.fading, self.fading)
        return np.asarray(np.multiply.outer(np.multiply.outer(shared, LAPSE_PRIOR), widths))


def hypotheses_for(minimum_m: float, maximum_m: float, step_m: float, fading: float = UHF_FADING) -> Hypotheses:
    """Return the grid for a searched range; step_m must be fine compared with the required interval."""
    margin_m = MARGIN_SHARE * (maximum_m - minimum_m)
    low_m, high_m = max(0.0, minimum_m - margin_m), maximum_m + margin_m
    count = int(np.ceil((high_m - low_m) / step_m))
    levels = int(np.ceil(np.log(MAX_WIDTH_M / MIN_WIDTH_M) / np.log(WIDTH_RATIO)))
    return Hypotheses(low_m + step_m * (np.arange(count) + 0.5), MIN_WIDTH_M * WIDTH_RATIO ** np.arange(levels + 1.0),
                      step_m, fading)
