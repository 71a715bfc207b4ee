"""Requests with an extender off and on, and the bound of the probability that one unlocks."""
# SPDX-License-Identifier: Apache-2.0
import pytest
from scipy.stats import binom

from mtr_operator.domain.scenarios.relay_resistance.axis_trial import tried_of, word_of
from mtr_operator.domain.scenarios.relay_resistance.tally import (
    Resistance,
    Tried,
    resistance_of,
    tally_columns,
    upper_bound,
)


@pytest.mark.parametrize("requests", [1, 3, 15, 59, 200])
def test_bound_without_an_unlock_has_its_closed_form(requests):
    assert upper_bound(0, requests) == pytest.approx(1.0 - 0.05 ** (1.0 / requests), rel=1e-9)


@pytest.mark.parametrize(("unlocks", "requests"), [(1, 15), (4, 9), (14, 15)])
def test_with_the_bound_so_few_unlocks_come_in_one_of_twenty_tests(unlocks, requests):
    assert binom.cdf(unlocks, requests, upper_bound(unlocks, requests)) == pytest.approx(0.05, rel=1e-6)


@pytest.mark.parametrize("requests", [0, 1, 7])
def test_nothing_is_bounded_by_no_request_or_by_unlocks_alone(requests):
    assert upper_bound(requests, requests) == 1.0


def test_more_unlocks_than_requests_are_a_mistake():
    with pytest.raises(ValueError, match="3 of 2 requests"):
        upper_bound(3, 2)


def test_columns_keep_the_states_apart_and_the_places_from_near_to_far():
    columns = tally_columns([Tried(False, 3.0, False), Tried(True, 3.0, True), Tried(True, 2.0, True),
                             Tried(False, 2.0, True), Tried(True, 2.5, False)])
    assert (columns["requests_off"], columns["unlocks_off"], columns["requests_on"], columns["unlocks_on"]) == (
        2, 1, 3, 2)
    assert (columns["unlocked_off_m"], columns["silent_off_m"]) == ((2.0,), (3.0,))
    assert (columns["unlocked_on_m"], columns["silent_on_m"]) == ((2.0, 3.0), (2.5,))
    assert columns["bound_off"] == pytest.approx(upper_bound(1, 2), abs=1e-6)
    assert tally_columns([])["bound_on"] is None


def test_single_unlock_is_enough_and_none_only_bounds():
    assert resistance_of(1) is Resistance.NOT_RESISTANT
    assert resistance_of(0) is Resistance.BOUNDED


def test_requests_are_found_again_by_the_words_they_were_kept_under_and_proofs_are_none():
    points = {word_of(False, 1, 1): (False, 2.0), word_of(True, 2, 10): (True, 3.0), "relay proof 1": (True, 0.6)}
    assert tried_of(points) == [Tried(False, 2.0, False), Tried(True, 3.0, True)]
