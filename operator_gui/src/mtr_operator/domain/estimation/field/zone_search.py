"""Selects the next press in a zone, and estimates the covered part of the zone.

The next press has the largest expected information per second of robot time. A place is covered if at least half of the
presses work there; the interval of the covered part follows from random fields of the posterior (propagation of
distributions, JCGM 101).
"""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import math
from typing import Callable

import numpy as np
from scipy.special import ndtr

from ..interval import LEVEL, FloatArray, Interval
from .latent_field import LatentField
from .prior import FieldPrior

COVERED = 0.5
_DRAWS, _SEED = 400, 1
# With fewer presses the variation of the field is unknown.
MIN_PRESSES = 6
_AT_ONCE = 32


class ZoneSearch:
    """State of one zone.

    Attributes: places: allowed places, rows of x, y, height, gap in m. areas_m2: area of each place.
    """

    def __init__(self, prior: FieldPrior, places: FloatArray, areas_m2: FloatArray):
        self._prior = prior
        self.places = places
        self.areas_m2 = areas_m2
        self._pressed: list[FloatArray] = []
        self._worked: list[float] = []
        self._field: LatentField | None = None
        self.presses = 0

    def recall(self, place: FloatArray, worked: bool) -> None:
        """Add a press of another zone, or an earlier one."""
        self._pressed.append(place)
        self._worked.append(float(worked))

    def add(self, place: FloatArray, worked: bool) -> None:
        """Add a press of this zone."""
        self.recall(place, worked)
        self.presses += 1

    @property
    def field(self) -> LatentField:
        """Posterior after the presses so far."""
        pressed, worked = np.array(self._pressed).reshape(-1, 4), np.array(self._worked)
        field = self._field
        if field is None:
            field = LatentField(self._prior, pressed[:_AT_ONCE], worked[:_AT_ONCE])
        # With many presses at once, the first ones select the slopes and fadings that are evaluated for the others.
        while field.presses < len(worked):
            known = min(max(2 * field.presses, _AT_ONCE), len(worked))
            field = LatentField(self._prior, pressed[:known], worked[:known], field)
        self._field = field
        return field

    def next_place(self, seconds: Callable[[FloatArray], FloatArray]) -> int:
        """Return the index of the next place; seconds: duration of a press at each of the places.

        Information is weighted by the uncertainty of the coverage: places deep in the zone, or far beyond it, do not
        change the outline (level set estimation: Bryan et al., Active learning for identifying function threshold
        boundaries, 2005).
        """
        covered = self.field.covered(self.places)
        told = self.field.information(self.places) * covered * (1.0 - covered)
        return int(np.argmax(told / seconds(self.places)))

    def coverage(self) -> Interval:
        """Return the covered part of the zone's area, from 0 to 1, with its 95 % interval."""
        covered = self.field.draws(self.places, _DRAWS, _SEED) >= COVERED
        parts = covered @ self.areas_m2 / np.sum(self.areas_m2)
        tail = (1.0 - LEVEL) / 2.0
        low, middle, high = np.quantile(parts, [tail, 0.5, 1.0 - tail])
        return Interval(float(middle), float(low), float(high), float(np.std(parts)))

    def is_finished(self, interval: float, attempts_limit: int) -> bool:
        """Return True if half the width of the coverage's interval is small enough, or no press is left."""
        if self.presses >= attempts_limit:
            return True
        return self.presses >= MIN_PRESSES and self.coverage().half_width_m <= interval

    def boundary(self, places: FloatArray, distances_m: FloatArray, sigmas: float = 0.0) -> float:
        """Return the largest distance on a ray, from near to far, at which half of the presses work, over the fading
        around it; NaN without one.

        places: on the ray. sigmas: of a normal distribution, for a certain boundary (below 0: a possible one).
        """
        above = np.flatnonzero(self.field.covered(places) >= ndtr(sigmas))
        return float(distances_m[above[-1]]) if len(above) else math.nan
