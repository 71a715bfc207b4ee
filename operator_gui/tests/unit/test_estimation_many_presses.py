"""Key press: many presses at one place, as further attempts make them, keep the evidence for fading true."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import math

import numpy as np
import pytest
from scipy import fft
from scipy.special import expit

from mtr_operator.domain.estimation.press.campaign import Campaign
from mtr_operator.domain.estimation.press.likelihood import Press, PressLikelihood
from mtr_operator.domain.estimation.press.line_boundary import LineBoundary
from mtr_operator.domain.estimation.press.plan import SearchPlan
from mtr_operator.domain.estimation.press.posterior import RadialPosterior
from mtr_operator.domain.estimation.press.transition import SIGMA_PER_SCALE, WIDTH_PER_SCALE

PLAN = SearchPlan(3.0, 10.0, interval_m=0.3)
D50_M, WIDTH_M = 6.5, 1.0
COUNTS = (1, 10, 30, 46, 60, 200, 500)
MIN_PROBABILITY = np.longdouble(1e-6)


def steady_presses(count, places):
    """Presses of a steady Car, as many at each place: the expected share of them works."""
    made = []
    for number in places:
        place_m = PLAN.minimum_m + number * PLAN.half_wavelength_m
        worked = round(count * expit((D50_M - place_m) * WIDTH_PER_SCALE / WIDTH_M))
        made += [Press(place_m, index < worked) for index in range(count)]
    return made


def likelihood_of(presses):
    likelihood = PressLikelihood(PLAN.hypotheses(), PLAN.lattice)
    for press in presses:
        likelihood.add(press)
    return likelihood


def posterior_of(presses):
    campaign = Campaign(PLAN.hypotheses())
    return RadialPosterior(PLAN.hypotheses(), likelihood_of(presses).log, campaign.log_shape_prior(1),
                           campaign.log_place_prior(1))


def log_steep(presses, steepness):
    """Sum of the logarithms over presses at one place, in long double; axes [lapse, width, d50]."""
    grid = PLAN.hypotheses()
    d50_m, width_m = grid.d50_m.astype(np.longdouble), grid.width_m.astype(np.longdouble)
    total = np.zeros((len(grid.lapse), len(width_m), len(d50_m)), np.longdouble)
    for press in presses:
        curve = 1.0 / (1.0 + np.exp((press.distance_m - d50_m) * WIDTH_PER_SCALE / (steepness * width_m[:, None])))
        works = (1.0 - grid.lapse[:, None, None].astype(np.longdouble)) * curve
        total += np.log(np.maximum(works if press.worked else 1.0 - works, MIN_PROBABILITY))
    return total


def blurred_without_floor(product, share):
    """Convolved along d50 with the fading that stays, in long double, what lies outside being as the edge."""
    grid = PLAN.hypotheses()
    sigmas = math.sqrt(share) * SIGMA_PER_SCALE * grid.width_m / WIDTH_PER_SCALE / grid.step_m
    edge = int(2.0 * sigmas[-1])
    padded = np.pad(product, ((0, 0), (0, 0), (edge, edge)), mode="edge")
    size = fft.next_fast_len(padded.shape[-1], real=True)
    steps = np.arange(size)
    kernel = np.exp(-0.5 * (np.minimum(steps, size - steps) / sigmas[:, None].astype(np.longdouble)) ** 2)
    kernel /= np.sum(kernel, axis=-1, keepdims=True)
    rolled = np.stack([np.roll(kernel, number, axis=-1)[:, edge:edge + product.shape[-1]] for number in range(size)])
    return np.einsum("lwp,pwd->lwd", padded, rolled[:padded.shape[-1]])


@pytest.mark.parametrize("count", COUNTS)
def test_likelihood_of_many_presses_at_a_place_is_as_without_a_floor(count):
    presses = steady_presses(count, (10,))
    likelihood = likelihood_of(presses)
    share = float(PLAN.hypotheses().shared[1])
    steep = log_steep(presses, math.sqrt(1.0 - share)) if count > 1 else log_steep(presses, 1.0)
    peak = np.max(steep, axis=-1, keepdims=True)
    product = np.exp(steep - peak)
    wanted = blurred_without_floor(product, share) if count > 1 else product
    found = np.exp(likelihood.log[1] - peak)
    # The evidence: d50 integrated out.
    assert np.allclose(np.log(np.sum(found, axis=-1)), np.log(np.sum(wanted, axis=-1)).astype(float), rtol=0.0,
                       atol=1e-9)
    likely = wanted > 1e-3 * np.max(wanted, axis=-1, keepdims=True)
    assert np.max(np.abs(np.log(found[likely]) - np.log(wanted[likely]))) < 1e-9
    assert np.max(np.abs(likelihood.log[0] - log_steep(presses, 1.0))) < 1e-9


def test_evidence_for_fading_falls_with_the_presses_on_a_steady_car():
    """The floor made fading certain from some 40 presses at a place on."""
    shares = [float(np.sum(posterior_of(steady_presses(count, range(7, 14))).shapes[1])) for count in (1, 10, 30, 60)]
    assert shares == sorted(shares, reverse=True) and shares[-1] < 0.05


@pytest.mark.parametrize("count", COUNTS[2:])
def test_interval_narrows_with_the_presses_at_each_place(count):
    few, many = (posterior_of(steady_presses(each, range(8, 13))).d50() for each in (10, count))
    assert many.half_width_m < few.half_width_m and abs(many.value_m - D50_M) < PLAN.hypotheses().step_m


@pytest.mark.parametrize("count", COUNTS)
def test_draws_of_a_line_hold_its_end_however_many_presses_were_made(count):
    presses = steady_presses(count, range(8, 13))
    d50 = LineBoundary(posterior_of(presses), presses, PLAN.lattice, 400).d50()
    assert abs(d50.value_m - D50_M) < max(d50.half_width_m, PLAN.hypotheses().step_m)
    assert d50.half_width_m <= (3.0 if count == 1 else 0.5)


@pytest.mark.parametrize("count", COUNTS)
def test_a_place_that_always_works_says_nothing_of_the_fading_beyond_its_own(count):
    """All presses of one place at one side: no hypothesis about fading is excluded by their number alone."""
    shapes = posterior_of([Press(5.1, True)] * count).shapes
    assert np.all(np.isfinite(shapes)) and float(np.sum(shapes[1])) == pytest.approx(0.85, abs=0.1)
