"""How well each hypothesis explains the presses of a radial.

Presses half a wavelength apart are independent. Nearer ones share the fading of their place: it moves the boundary
there by a normal of sigma sqrt(shared) * sigma of the transition, and what is left to time makes a steeper curve of
scale sqrt(1 - shared) * scale. For a place with several presses that is

    L(d50) = integral of  prod_i p_steep(y_i; d50 + f)  N(f; 0, sigma_f)  df,

a convolution along d50; for one press it is the curve itself.

Source: Clarke's model, isotropic scattering: the correlation of the field is sinc(2 pi r / wavelength), zero at half a
wavelength (R. Clarke, Bell System Technical Journal 47, 1968).
"""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy import fft

from ..interval import FloatArray
from .hypotheses import Hypotheses
from .transition import SIGMA_PER_SCALE, WIDTH_PER_SCALE, falling

# Of a probability: a transition of 5 cm would make one press at the wrong side refute all else.
_MIN_PROBABILITY = 1e-6
# What the convolution leaves of an impossible course, beyond the rounding of its transform.
_MIN_BLURRED = 1e-12
# A logarithm that can still be taken back.
_MIN_PRODUCT = 1e-300
# The widest fading reaches this many sigmas beyond the grid.
_EDGE_SIGMAS = 2.0


@dataclass(frozen=True)
class Press:
    """One press of the button: where the key was, and whether the Car did what it should."""

    distance_m: float
    worked: bool


@dataclass
class _Place:
    """Presses that share the fading of their half wavelength.

    products: per part of the fading that stays, the product of the presses' likelihoods before the convolution; axes
    [lapse, width, d50].
    """

    products: list[FloatArray]
    log: FloatArray
    presses: int = 1


class PressLikelihood:
    """Logarithm of the likelihood over the grid.

    Attributes:
        log: axes [shared, lapse, width, d50].
    """

    def __init__(self, hypotheses: Hypotheses, half_wavelength_m: float, first_m: float = 0.0):
        self._hypotheses = hypotheses
        self._half_wavelength_m = half_wavelength_m
        self._first_m = first_m
        self._places: dict[int, _Place] = {}
        self.log = np.zeros((*hypotheses.shape_size, len(hypotheses.d50_m)))

    def place_of(self, distance_m: float) -> int:
        """Number of the half wavelength in whose midst a distance lies, counted from first_m."""
        return round((distance_m - self._first_m) / self._half_wavelength_m)

    def presses_beside(self, distance_m: float) -> int:
        """Presses so far that share the fading with a distance."""
        place = self._places.get(self.place_of(distance_m))
        return 0 if place is None else place.presses

    def add(self, press: Press) -> None:
        """Take a press."""
        shares = self._hypotheses.shared
        factors = [self._factor(press, float(np.sqrt(1.0 - shared))) for shared in shares]
        number = self.place_of(press.distance_m)
        place = self._places.get(number)
        if place is None:
            # The fading of one press alone is part of the curve.
            log = np.log(np.broadcast_to(self._factor(press, 1.0), self.log.shape))
            self._places[number] = _Place(factors, log)
            self.log += log
            return
        place.products = [product * factor for product, factor in zip(place.products, factors)]
        place.presses += 1
        log = np.log(np.stack([self._blurred(product, shared) for product, shared in zip(place.products, shares)]))
        self.log += log - place.log
        place.log = log

    def without(self, distance_m: float) -> FloatArray:
        """The logarithm without the presses that share the fading of a place."""
        place = self._places.get(self.place_of(distance_m))
        return self.log if place is None else self.log - place.log

    def _factor(self, press: Press, steepness: float) -> FloatArray:
        """Likelihood of one press; axes [lapse, width, d50]."""
        grid = self._hypotheses
        works = (1.0 - grid.lapse[:, None, None]) * falling(press.distance_m, grid.d50_m,
                                                            steepness * grid.width_m[:, None])
        return np.maximum(works if press.worked else 1.0 - works, _MIN_PROBABILITY)

    def _blurred(self, product: FloatArray, shared: float) -> FloatArray:
        """The convolution along d50; what lies outside the grid is as its edge."""
        if shared <= 0.0:
            return np.maximum(product, _MIN_PRODUCT)
        grid = self._hypotheses
        sigmas = np.sqrt(shared) * SIGMA_PER_SCALE * grid.width_m / WIDTH_PER_SCALE / grid.step_m
        edge = int(_EDGE_SIGMAS * sigmas[-1])
        padded = np.pad(product, ((0, 0), (0, 0), (edge, edge)), mode="edge")
        size = fft.next_fast_len(padded.shape[-1], real=True)
        transfer = np.exp(-0.5 * (2.0 * np.pi * np.outer(sigmas, fft.rfftfreq(size))) ** 2)
        blurred = fft.irfft(fft.rfft(padded, size) * transfer, size)[..., edge:edge + product.shape[-1]]
        return np.asarray(np.maximum(blurred, _MIN_BLURRED))
