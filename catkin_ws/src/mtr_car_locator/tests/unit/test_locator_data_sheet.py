"""Data sheet and scan plane: published size, measured size, and warnings."""
# SPDX-License-Identifier: Apache-2.0
import re

import numpy as np
import pytest
from locator_surfels import LENGTH_M, WIDTH_M, box, prior, surfels

from mtr_car_locator.find.fit import fit_car
from mtr_car_locator.located import found
from mtr_car_locator.parameters import DataSheet, LocatorParameters


def fit_with(sides=("front", "rear", "left", "right"), **sheet):
    return fit_car(surfels(box(sides=sides)), prior(0.2, 0.1, 0.05), LocatorParameters(sheet=DataSheet(**sheet)))


def test_size_is_that_of_the_data_sheet_and_the_measured_one_stays_in_the_fit():
    plain, known = fit_with(), fit_with(known_length_m=LENGTH_M + 0.04, known_width_m=WIDTH_M + 0.03)
    assert (known.rectangle.length, known.rectangle.width) == (LENGTH_M + 0.04, WIDTH_M + 0.03)
    assert (known.length_sigma, known.width_sigma) == (0.005, 0.005)
    assert (known.in_plane.length, known.in_plane.width) == pytest.approx((plain.in_plane.length, plain.in_plane.width))
    assert known.in_plane.length == pytest.approx(LENGTH_M, abs=0.006)
    # The assignment of the 4 cm inset to the ends is unknown.
    assert known.rectangle.pose.distance_to(plain.rectangle.pose) < 0.003
    assert known.sigmas[1:] == pytest.approx(plain.sigmas[1:]) and 0.008 < known.sigmas[0] < plain.sigmas[0]
    assert not known.warning and not plain.warning


def test_outline_grows_with_the_data_sheet_and_never_shrinks():
    plain, large, small = (np.abs(fit_with(**sheet).outline).max(axis=0) for sheet in (
        {}, {"known_length_m": LENGTH_M + 0.05}, {"known_length_m": LENGTH_M - 0.2}))
    assert large == pytest.approx((0.5 * LENGTH_M + 0.025, plain[1]), abs=0.003)
    assert small == pytest.approx(plain, abs=0.001)


@pytest.mark.parametrize("sheet, words", [({"known_length_m": LENGTH_M - 0.05}, "m long .* cm more"),
                                          ({"known_width_m": WIDTH_M - 0.05}, "m wide .* cm more"),
                                          ({"known_length_m": LENGTH_M + 0.36}, "m long .* cm less"),
                                          ({"known_width_m": WIDTH_M + 0.2}, "m wide .* cm less")])
def test_data_sheet_of_another_car_is_warned_of(sheet, words):
    assert re.match(f"The Car is [0-9.]+ {words} than its data sheet says; check which car stands there[.]",
                    fit_with(**sheet).warning)


@pytest.mark.parametrize("more_m", [-0.005, 0.0, 0.06])
def test_ordinary_inset_is_not_warned_of(more_m):
    assert not fit_with(known_length_m=LENGTH_M + more_m, known_width_m=WIDTH_M + more_m).warning


@pytest.mark.parametrize("more_m", [0.10, 0.119, 0.2])
def test_ends_that_the_length_leaves_vague_are_warned_of(more_m):
    assert re.fullmatch(r"The Car's front and rear are known to [0-9.]+ cm .* front_overhang_m and wheelbase_m .*",
                        fit_with(known_length_m=LENGTH_M + more_m).warning)


# Both sides have an inset from 0 to 60 mm: twice its root mean square. The insets of front and rear are independent,
# with half-normal priors.
UNSURE = {"length": np.hypot(0.11, 0.075), "width": 2.0 * 0.06 / np.sqrt(3.0)}


@pytest.mark.parametrize("sheet, unsure", [({}, ("length", "width")), ({"known_width_m": WIDTH_M}, ("length",)),
                                           ({"known_length_m": LENGTH_M}, ("width",))])
def test_what_no_data_sheet_says_is_unsure_by_what_may_be_wider_above_the_plane(sheet, unsure):
    fit = fit_with(**sheet)
    assert {name: getattr(fit, f"{name}_sigma") for name in unsure} == pytest.approx(
        {name: UNSURE[name] for name in unsure}, rel=0.02)


def test_end_that_was_not_seen_is_not_compared():
    fit = fit_with(sides=("front", "left", "right"), known_length_m=LENGTH_M + 0.3)
    assert fit.in_plane.length is None and "than its data sheet" not in fit.warning
    assert fit.rectangle.length == LENGTH_M + 0.3


@pytest.mark.parametrize("sheet, is_contradicted", [
    ({"known_length_m": LENGTH_M - 0.05}, True), ({"known_width_m": WIDTH_M + 0.2}, True),
    ({"known_length_m": LENGTH_M + 0.06, "known_width_m": WIDTH_M + 0.06}, False), ({}, False),
    # Vague ends are a warning, and no contradiction.
    ({"known_length_m": LENGTH_M + 0.119}, False)])
def test_contradicted_data_sheet_is_what_the_locator_tells(sheet, is_contradicted):
    fit = fit_with(**sheet)
    assert bool(fit.contradiction) is is_contradicted and fit.contradiction in fit.warning
    message = found(fit)
    assert (message.code == "car_locator.sheet_contradicted") is is_contradicted
    assert [each.code for each in message.chain()][-1] == "car_locator.found"
    assert fit.contradiction in message.text and "The Car was found" in message.text
