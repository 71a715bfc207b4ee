"""Likelihood of each hypothesis from the presses of a radial.

Presses at places half a wavelength apart are independent (lattice). Presses at one place share its fading. It displaces
the boundary there by a normal of sigma sqrt(shared) * sigma of the transition; the noise in time leaves a steeper curve
of scale sqrt(1 - shared) * scale. For a place with several presses the likelihood is

    L(d50) = integral of  prod_i p_steep(y_i; d50 + f)  N(f; 0, sigma_f)  df,

a convolution along d50; for one press it is the curve itself. A press between the places depends on the fading of
several places. line_boundary evaluates it for the line's own boundary; the grid ignores it.

The product of n undecided presses is near 0.5^n. It is convolved relative to its peak over d50, so that the evidence
for fading does not depend on the number of presses at a place.
"""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import collections
import math
from dataclasses import dataclass, field

import numpy as np
from scipy import fft

from ..interval import FloatArray
from .hypotheses import Hypotheses
from .lattice import Lattice
from .transition import SIGMA_PER_SCALE, WIDTH_PER_SCALE, falling

# Lower bound of a probability: with a transition of 5 cm, a single press on the wrong side would refute everything
# else.
_MIN_PROBABILITY = 1e-6
# Lower bound relative to the peak over d50: result of the convolution for an impossible sequence, above rounding
# errors.
_MIN_BLURRED = 1e-12
# The widest fading reaches this many sigmas beyond the grid.
_EDGE_SIGMAS = 2.0


@dataclass(frozen=True)
class Press:
    """One press of the button: position of the key, and success of the reaction."""

    distance_m: float
    worked: bool


@dataclass
class _Place:
    """Presses that share the fading of their half wavelength.

    log: of the likelihood; axes [shared, lapse, width, d50], or 0 for all.
    sums: for each steepness of the curve, the sum of the logarithms of the presses' likelihoods; axes [lapse, width,
    d50].
    """

    presses: list[Press] = field(default_factory=list)
    log: FloatArray | float = 0.0
    sums: dict[float, tuple[int, FloatArray | float]] = field(default_factory=dict)


class PressLikelihood:
    """Log likelihood over the grid.

    Attributes:
        lattice: places with independent fading.
        log: axes [shared, lapse, width, d50].
    """

    def __init__(self, hypotheses: Hypotheses, lattice: Lattice):
        self._hypotheses = hypotheses
        self.lattice = lattice
        self._places: dict[int, _Place] = {}
        self._between: collections.Counter[int] = collections.Counter()
        self.log: FloatArray = np.zeros((*hypotheses.shape_size, len(hypotheses.d50_m)))

    def presses_beside(self, distance_m: float) -> int:
        """Return the number of presses that share the fading with a distance."""
        number = self.lattice.place_of(distance_m)
        place = self._places.get(number)
        return self._between[number] + (0 if place is None else len(place.presses))

    def add(self, *presses: Press) -> None:
        """Add presses; one between the places is only counted."""
        changed = {}
        for press in presses:
            number = self.lattice.place_of(press.distance_m)
            if self.lattice.is_between(press.distance_m):
                self._between[number] += 1
            else:
                changed[number] = self._places.setdefault(number, _Place())
                changed[number].presses.append(press)
        for place in changed.values():
            log = np.stack([self._log_at(place, float(share)) for share in self._hypotheses.shared])
            self.log += log - place.log
            place.log = log

    def without(self, distance_m: float) -> FloatArray:
        """Return the log likelihood without the presses that share the fading of a place."""
        place = self._places.get(self.lattice.place_of(distance_m))
        return self.log if place is None else self.log - place.log

    def _log_at(self, place: _Place, share: float) -> FloatArray:
        """Return the log likelihood of a place's presses, for one permanent part of the fading; axes [lapse, width,
        d50]."""
        if share <= 0.0 or len(place.presses) == 1:
            # The fading of a single press is part of the curve.
            return self._sum(place, 1.0)
        steep = self._sum(place, math.sqrt(1.0 - share))
        peak = np.max(steep, axis=-1, keepdims=True)
        return np.asarray(np.log(self._blurred(np.exp(steep - peak), share)) + peak)

    def _sum(self, place: _Place, steepness: float) -> FloatArray:
        """Return the sum of the presses' log likelihoods, before the convolution."""
        count, total = place.sums.get(steepness, (0, 0.0))
        for press in place.presses[count:]:
            total = total + self._log_factor(press, steepness)
        place.sums[steepness] = len(place.presses), total
        return np.asarray(total)

    def _log_factor(self, press: Press, steepness: float) -> FloatArray:
        """Return the log likelihood of one press; axes [lapse, width, d50]."""
        grid = self._hypotheses
        width_m, lapse = steepness * grid.width_m[:, None], grid.lapse[:, None, None]
        if press.worked:
            likely = (1.0 - lapse) * falling(press.distance_m, grid.d50_m, width_m)
        else:
            # Computed as the complementary curve, because 1 less the curve loses digits near 1.
            likely = lapse + (1.0 - lapse) * falling(grid.d50_m, press.distance_m, width_m)
        return np.asarray(np.log(np.maximum(likely, _MIN_PROBABILITY)))

    def _blurred(self, product: FloatArray, shared: float) -> FloatArray:
        """Convolve a product whose peak is 1 along d50; outside the grid it has the value of its edge."""
        grid = self._hypotheses
        sigmas = np.sqrt(shared) * SIGMA_PER_SCALE * grid.width_m / WIDTH_PER_SCALE / grid.step_m
        edge = int(_EDGE_SIGMAS * sigmas[-1])
        padded = np.pad(product, ((0, 0), (0, 0), (edge, edge)), mode="edge")
        size = fft.next_fast_len(padded.shape[-1], real=True)
        # The kernel is sampled, because its analytic spectrum has negative lobes if the fading is narrower than a step.
        kernel = np.exp(-0.5 * (size * fft.fftfreq(size) / sigmas[:, None]) ** 2)
        transfer = fft.rfft(kernel / np.sum(kernel, axis=-1, keepdims=True))
        blurred = fft.irfft(fft.rfft(padded, size) * transfer, size)[..., edge:edge + product.shape[-1]]
        return np.asarray(np.maximum(blurred, _MIN_BLURRED))
