"""What is possible for a radial: a grid over distance, width, lapse and the part of the fading that stays in its place.

An array over the grid has the axes [shared, lapse, width, d50]. The first three are the shape of the transition: they
belong to Car and key, and the radials of a campaign have them in common; d50 is the radial's own.
"""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np

from ..interval import FloatArray

# Widths beyond these are not told apart: the pose of the key is known to 2 mm, and 10 m is wider than what fading of
# 8 dB leaves at a range of 10 m (docs of the range benchmark).
MIN_WIDTH_M, MAX_WIDTH_M = 0.05, 12.0
WIDTH_RATIO = 1.25
LAPSES, LAPSE_PRIOR = (0.0, 0.03), (0.7, 0.3)
# Share of the latent variance that is fixed in space: noise in time alone, and 5 to 8 dB of fading next to 1 to 3 dB of
# noise in time.
SHARED = (0.0, 0.85)
# Prior probability of fading. Few UHF radios have no standing waves. A low-frequency field has none: its wavelength is
# kilometres. Steel nearby distorts it, and with a smaller probability the intervals of Handle request were too wide.
UHF_FADING, LF_FADING = 0.85, 0.35
# d50 may lie outside the range that is searched, by this share of it.
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
        """Numbers of shared parts, lapses and widths."""
        return len(self.shared), len(self.lapse), len(self.width_m)

    @property
    def edges_m(self) -> FloatArray:
        """Borders between neighbouring d50."""
        return np.append(self.d50_m - self.step_m / 2.0, self.d50_m[-1] + self.step_m / 2.0)

    def shape_prior(self) -> FloatArray:
        """Before anything is measured: all widths alike in their logarithm; axes [shared, lapse, width]."""
        widths = np.full(len(self.width_m), 1.0 / len(self.width_m))
        shared = (1.0 - self.fading, self.fading)
        return np.asarray(np.multiply.outer(np.multiply.outer(shared, LAPSE_PRIOR), widths))


def hypotheses_for(minimum_m: float, maximum_m: float, step_m: float, fading: float = UHF_FADING) -> Hypotheses:
    """For a range that is searched, which step_m divides finely against the interval that is wanted."""
    margin_m = MARGIN_SHARE * (maximum_m - minimum_m)
    low_m, high_m = max(0.0, minimum_m - margin_m), maximum_m + margin_m
    count = int(np.ceil((high_m - low_m) / step_m))
    levels = int(np.ceil(np.log(MAX_WIDTH_M / MIN_WIDTH_M) / np.log(WIDTH_RATIO)))
    return Hypotheses(low_m + step_m * (np.arange(count) + 0.5), MIN_WIDTH_M * WIDTH_RATIO ** np.arange(levels + 1.0),
                      step_m, fading)
