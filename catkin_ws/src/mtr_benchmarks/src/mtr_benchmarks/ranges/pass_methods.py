"""Methods for Autolock on one campaign of axes: one pass as in the thesis, and passes at two speeds."""
# SPDX-License-Identifier: Apache-2.0
from typing import List, NamedTuple, Tuple

import numpy as np

from mtr_operator.domain.estimation.passes.boundary import BoundaryCampaign, Pass
from mtr_operator.domain.estimation.passes.speeds import pass_sigma

from .cars import Polling, noticed_at
from .result import LineFound, point

AXES = 40
SPEEDS_MPS = (0.1, 0.4)
SINGLE_MPS = 0.3
# Distance around the boundary that is driven at the speed of a pass.
STRETCH_M = 1.0


class AxesDraw(NamedTuple):
    """Campaign of axes: `place` determines the boundaries, `noise` the phases and noise."""

    polling: Polling
    place: int
    noise: int
    speeds_mps: Tuple[float, ...] = SPEEDS_MPS

    def boundaries_m(self) -> List[float]:
        """Return the true boundaries."""
        return [float(value) for value in np.random.default_rng([self.place, 2]).uniform(1.0, 2.2, AXES)]


def single(draw: AxesDraw) -> List[LineFound]:
    """Run one pass per axis; its sigma includes pose and bus cycle, as in the application."""
    noise = np.random.default_rng([draw.noise, 3])
    sigma_m = pass_sigma(SINGLE_MPS, 0.0, draw.polling.cycle_s) + 0.002
    return [LineFound(boundary_m, point(boundary_m - noticed_at(draw.polling, SINGLE_MPS, noise), sigma_m), 1,
                      STRETCH_M / SINGLE_MPS, STRETCH_M) for boundary_m in draw.boundaries_m()]


def passes(draw: AxesDraw) -> List[LineFound]:
    """Run passes at all speeds."""
    noise = np.random.default_rng([draw.noise, 4])
    campaign = BoundaryCampaign(draw.polling.cycle_s)
    for axis, boundary_m in enumerate(draw.boundaries_m()):
        outward, sign = bool(axis % 2), 1.0 if axis % 2 else -1.0
        campaign.keep(axis, [Pass(boundary_m + sign * noticed_at(draw.polling, speed, noise), speed, outward)
                             for speed in draw.speeds_mps])
    time_s = sum(STRETCH_M / speed for speed in draw.speeds_mps)
    count = len(draw.speeds_mps)
    return [LineFound(boundary_m, campaign.boundary(axis).static, count, time_s, count * STRETCH_M)
            for axis, boundary_m in enumerate(draw.boundaries_m())]
