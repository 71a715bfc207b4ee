"""The field of a Car from presses around it: what it finds, how sure it is, and where it presses next."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import math

import numpy as np
import pytest

from mtr_operator.domain.estimation.field.latent_field import LatentField
from mtr_operator.domain.estimation.field.prior import FieldPrior
from mtr_operator.domain.estimation.field.zone_search import ZoneSearch

PRIOR = FieldPrior(0.35)


def zone(height_m=1.0):
    """Places and areas of an eighth of the surroundings of a Car without extent, 0.5 to 6 m out."""
    places, areas = [], []
    for angle in np.radians([-15.0, 0.0, 15.0]):
        for gap_m in np.arange(0.5, 6.01, 0.5):
            places.append((gap_m * math.cos(angle), gap_m * math.sin(angle), height_m, gap_m))
            areas.append(gap_m)
    return np.array(places), np.array(areas)


def share(places, d50_m=3.0, width_m=2.0):
    """True share of presses that work."""
    return 1.0 / (1.0 + np.exp((places[:, 3] - d50_m) * 4.394 / width_m))


def searched(seed, presses, d50_m=3.0, width_m=2.0):
    """A search that chose its presses itself, each place taking as long."""
    random = np.random.default_rng(seed)
    places, areas = zone()
    truth = share(places, d50_m, width_m)
    search = ZoneSearch(PRIOR, places, areas)
    for _ in range(presses):
        index = search.next_place(lambda all_places: np.ones(len(all_places)))
        search.add(places[index], random.random() < truth[index])
    return search


def test_without_presses_the_field_is_the_prior():
    places, _ = zone()
    field = LatentField(PRIOR, np.zeros((0, 4)), np.zeros(0))
    mean, sigma = field.marginals(places)
    assert mean == pytest.approx(PRIOR.mean(places))
    assert sigma ** 2 == pytest.approx(np.diag(PRIOR.covariance(places, places)))


def test_many_presses_find_the_share_that_works():
    random = np.random.default_rng(2)
    places, _ = zone()
    pressed = np.repeat(places, 8, axis=0)
    field = LatentField(PRIOR, pressed, (random.random(len(pressed)) < share(pressed)).astype(float))
    assert np.sqrt(np.mean((field.probability(places) - share(places)) ** 2)) < 0.12


def test_the_next_press_is_where_nobody_knows_whether_the_place_is_covered():
    search = searched(3, 16)
    information = search.field.information(search.places)
    assert np.all((information >= 0.0) & (information <= 1.0))
    place = search.next_place(lambda places: np.ones(len(places)))
    assert 0.1 < search.field.probability(search.places)[place] < 0.9


def test_a_second_press_at_a_place_tells_less_than_one_beside_it():
    places, areas = zone()
    search = ZoneSearch(PRIOR, places, areas)
    beside = np.array([places[4], places[4] + (0.0, 0.5, 0.0, 0.0)])
    search.add(places[4], True)
    search.add(places[4], False)
    information = search.field.information(beside)
    assert information[0] < information[1]


def test_a_place_that_takes_long_to_reach_waits():
    search = searched(4, 6)
    free = search.next_place(lambda places: np.ones(len(places)))
    dear = search.next_place(lambda places: np.where(np.arange(len(places)) == free, 1000.0, 1.0))
    assert dear != free


def test_coverage_becomes_narrower_with_presses_and_holds_the_truth():
    places, areas = zone()
    true_part = np.sum(areas[share(places) >= 0.5]) / np.sum(areas)
    wide, narrow = searched(5, 6).coverage(), searched(5, 40).coverage()
    assert narrow.half_width_m < 0.6 * wide.half_width_m
    assert narrow.holds(true_part)


@pytest.mark.parametrize("width_m", [0.5, 2.0])
def test_intervals_of_the_coverage_hold_the_truth_in_most_zones(width_m):
    places, areas = zone()
    held = []
    for seed in range(24):
        d50_m = 2.0 + 2.0 * seed / 24.0
        true_part = np.sum(areas[share(places, d50_m, width_m) >= 0.5]) / np.sum(areas)
        held.append(searched(100 + seed, 20, d50_m, width_m).coverage().holds(true_part))
    # 95 % of 24 are 22.8; 20 or fewer come by chance in 3 % of such sets.
    assert sum(held) >= 21


def test_a_sure_boundary_lies_nearer_than_a_possible_one():
    search = searched(6, 24)
    distances_m = np.arange(0.2, 6.0, 0.1)
    places = np.array([(gap_m, 0.0, 1.0, gap_m) for gap_m in distances_m])
    sure, middle, possible = (search.boundary(places, distances_m, sigmas) for sigmas in (1.96, 0.0, -1.96))
    assert sure <= middle <= possible
    assert middle == pytest.approx(3.0, abs=1.0)


def test_places_that_all_failed_have_no_boundary():
    places, areas = zone()
    search = ZoneSearch(PRIOR, places, areas)
    for index in range(0, len(places), 2):
        search.add(places[index], False)
    assert math.isnan(search.boundary(places[:12], places[:12, 3]))
    assert search.coverage().high_m < 0.3
    assert search.is_finished(0.15, 100)
