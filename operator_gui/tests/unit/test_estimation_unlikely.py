"""Key press: a press that works where none should is believed only when it does so again."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import math
from dataclasses import replace

import pytest

from mtr_operator.domain.estimation.press.campaign import Campaign
from mtr_operator.domain.estimation.press.likelihood import Press
from mtr_operator.domain.estimation.press.plan import SearchPlan
from mtr_operator.domain.estimation.press.radial_estimate import estimate
from mtr_operator.domain.estimation.press.radial_search import RadialSearch
from mtr_operator.domain.ports import KEY_BUTTON
from mtr_operator.domain.scenarios.key_press import SCENARIO
from mtr_operator.domain.scenarios.key_press_parameters import KeyPressParameters

PLAN = SearchPlan(3.0, 10.0, interval_m=0.3)
BOUNDARY_M = 5.2
PARAMETERS = KeyPressParameters.from_mapping(
    {"method": "adaptive", "angle_between_radials_deg": 90.0, "maximum_distance_m": 10.0, "interval_m": 0.3})


def radial_with_border_known(plan=PLAN):
    """Of a sharp border, after some presses on both sides."""
    grid = plan.hypotheses()
    search = RadialSearch(plan, grid, Campaign(grid), 1, plan.maximum_m)
    for place_m in (10.0, 7.5, 6.5, 5.8, 5.5, 3.0, 4.0, 4.5, 4.8, 5.0):
        search.add(Press(place_m, place_m < BOUNDARY_M))
    assert not search.unconfirmed
    return search


def test_unlikely_success_is_tried_twice_again_and_left_out_when_it_does_not_return():
    search = radial_with_border_known()
    before = search.posterior().d50()
    search.add(Press(9.0, True))
    for _ in range(2):
        assert not search.is_finished() and search.next_place_m() == 9.0
        search.add(Press(9.0, False))
    assert search.unconfirmed == [Press(9.0, True)] and search.presses.count(Press(9.0, True)) == 0
    found = estimate(PLAN, search)
    assert found.d50.holds(BOUNDARY_M) and found.d50.value_m == pytest.approx(before.value_m, abs=0.05)
    assert found.farthest_success_m == 5.0


@pytest.mark.parametrize("repeats", [(True,), (False, True)])
def test_unlikely_success_that_returns_counts_with_all_its_presses(repeats):
    search = radial_with_border_known()
    search.add(Press(9.0, True))
    assert search.unconfirmed == [Press(9.0, True)]
    for worked in repeats:
        search.add(Press(9.0, worked))
    assert not search.unconfirmed
    assert [press.worked for press in search.presses[10:]] in ([True, True], [False, True, True])


def test_success_that_waits_for_its_repetition_does_not_count_at_the_presses_allowed():
    search = radial_with_border_known(replace(PLAN, attempts_limit=11))
    search.add(Press(9.0, True))
    assert search.is_finished() and search.unconfirmed == [Press(9.0, True)]
    assert estimate(PLAN, search).farthest_success_m == 5.0


def test_another_keys_button_beside_the_border_leaves_intervals_that_hold(run_scenario, world):
    """Somebody presses it within the time in which the Car may answer to a press that is too far away."""
    world.unlock_m, world.lock_m = -1.0, -1.0
    take, foreign = world.take, []

    def interfere(desired):
        before = len(world.presses)
        take(desired)
        # After some radials it is known where the border may lie.
        if len(world.presses) > max(before, 30) and math.hypot(*world.key()) > 5.5 and not foreign:
            foreign.append(math.hypot(*world.key()))
            world.foreign.append((world.presses[-1].start_s + 0.4, not world.locked, KEY_BUTTON))

    world.take = interfere
    results = run_scenario(SCENARIO, replace(PARAMETERS, angle_between_radials_rad=math.radians(30.0)))
    assert foreign and all(result.d50_low_m <= 5.2 <= result.d50_high_m for result in results)
    assert sum(foreign[0] in result.worked_at_m or bool(result.unconfirmed_m) for result in results) <= 1
    assert all(result.attempts == len(result.worked_at_m) + len(result.failed_at_m) + len(result.unconfirmed_m.split())
               for result in results)
