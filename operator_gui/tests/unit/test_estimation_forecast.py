"""Key press: what a radial will take, before it is started."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import pytest

from mtr_operator.domain.estimation.press.forecast import radial_forecast
from mtr_operator.domain.estimation.press.plan import RobotTimes, SearchPlan
from mtr_operator.domain.estimation.press.radial_search import MIN_PRESSES

PLAN = SearchPlan(3.0, 20.0, interval_m=0.3)


def test_forecast_of_the_transition_of_one_metre_is_what_searches_took():
    # Searches of development took 13 to 18 presses in the median, and 40 to 55 s.
    found = radial_forecast(PLAN, 1.0)
    assert found.is_reached and found.interval_m == 0.3
    assert 14 <= found.presses <= 18
    assert found.robot_time_s == pytest.approx(52.0, rel=0.25)


@pytest.mark.parametrize("width_m, half_width_m", [(2.2, 0.52), (4.0, 0.98), (6.6, 1.48)])
def test_forecast_of_a_wide_transition_says_the_interval_that_24_presses_reach(width_m, half_width_m):
    found = radial_forecast(PLAN, width_m)
    assert not found.is_reached and found.presses == 24
    assert found.interval_m == pytest.approx(half_width_m, rel=0.2)


def test_narrow_transition_takes_the_bisection_only():
    assert radial_forecast(PLAN, 0.1).presses == MIN_PRESSES


def test_slower_robot_takes_longer_for_the_same_presses():
    slow = SearchPlan(3.0, 20.0, interval_m=0.3, times=RobotTimes(speed_mps=0.3))
    assert radial_forecast(slow, 1.0).presses == radial_forecast(PLAN, 1.0).presses
    assert radial_forecast(slow, 1.0).robot_time_s > radial_forecast(PLAN, 1.0).robot_time_s + 20.0
