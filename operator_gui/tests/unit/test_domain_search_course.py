"""How a search along a line goes: its moves, its end, what is asked of a line measured further, what it may take."""
# SPDX-License-Identifier: Apache-2.0
import math
import re
from dataclasses import replace

import pytest

from mtr_operator.domain.actions.distance import Distance
from mtr_operator.domain.actions.observer import RunObserver
from mtr_operator.domain.errors import RobotFailed
from mtr_operator.domain.geometry.ray import Ray
from mtr_operator.domain.ports import LockFacts
from mtr_operator.domain.requests import Direction
from mtr_operator.domain.results.line_result import LineStatus
from mtr_operator.domain.robot_status import CarDimensions
from mtr_operator.domain.scenarios.key_press import SCENARIO
from mtr_operator.domain.scenarios.key_press_parameters import KeyPressParameters
from mtr_operator.domain.scenarios.key_press_result import KeyPressResult
from mtr_operator.domain.scenarios.line_search import search
from mtr_operator.domain.scenarios.line_search.forecast import UsualWidths, search_forecast
from mtr_operator.domain.scenarios.line_search.moves import drive, wake_key
from mtr_operator.domain.scenarios.press.radial import WIDTHS

CAR = CarDimensions(4.5, 1.8, 0.02, 0.01)
PARAMETERS = KeyPressParameters.from_mapping(
    {"method": "adaptive", "angle_between_radials_deg": 90.0, "maximum_distance_m": 10.0, "interval_m": 0.3})
RAY = Ray(0.0, 0.0, 1.0, 0.0)
FORWARD, BACKWARD = Direction.FORWARD, Direction.BACKWARD


@pytest.fixture(autouse=True)
def passive_entry_off(world):
    world.unlock_m, world.lock_m = -1.0, -1.0


class Listed:
    """A robot that lists what it is ordered to do."""

    def __init__(self, kept=(), trouble=""):
        self.orders, self._kept, self._trouble = [], list(kept), trouble

    def go_to(self, _, distance_m, direction):
        self.orders.append((pytest.approx(distance_m), direction))

    def wait_until_reached(self):
        self.orders.append("there")

    def wait(self, duration_s):
        self.orders.append(duration_s)

    def say(self, action):
        self.orders.append(action)

    def trouble(self):
        return self._trouble

    def kept_point(self, word):
        number = int(word.removeprefix("press ")) - 1
        if not 0 <= number < len(self._kept):
            return None
        return (LineStatus.OK if self._kept[number] else LineStatus.NOT_REACHED), Distance(5.0, 0.03, 10.0)


def radial(number, d50_m=None, d95_m=None, **changes):
    """Result of a search."""
    return KeyPressResult(number, 0.0, LineStatus.OK, d95_m, None, 0.03, 12, 1.0, "", method="adaptive",
                          reach="measured", d50_m=d50_m, d95_m=d95_m, **changes)


# Moves


@pytest.mark.parametrize(("from_m", "to_m", "orders"), [
    (5.0, 4.0, [(4.0, FORWARD), "there"]), (5.0, 6.0, [(6.0, BACKWARD), "there"]),
    (0.0, 0.05, [(0.05, BACKWARD), "there"]), (0.05, 0.0, [(0.0, FORWARD), "there"]),
    (5.0, 5.04, []), (5.0, 4.96, []), (5.0, 5.0, [])])
def test_robot_faces_the_car_on_each_way_and_spares_itself_one_of_less_than_5_cm(from_m, to_m, orders):
    robot = Listed()
    drive(RAY, from_m, to_m, robot)
    assert robot.orders == orders


# 433.92 MHz: half a wavelength is 0.345 m; the first press is at 9.5 m, and nothing is farther.
@pytest.mark.parametrize(("place_m", "beside_m", "directions"), [
    (5.0, 5.345, (BACKWARD, FORWARD)), (9.4, 9.745, (BACKWARD, FORWARD)), (9.5, 9.155, (FORWARD, BACKWARD))])
def test_key_that_may_sleep_is_moved_by_half_a_wavelength_and_back(place_m, beside_m, directions):
    robot = Listed()
    wake_key(RAY, place_m, replace(PARAMETERS, settle_time_s=0.7), robot)
    said, there, first, back, second, settled = robot.orders
    assert said == "move the key so that it does not sleep" and first == second == "there"
    assert there == (pytest.approx(beside_m, abs=1e-3), directions[0]) and back == (place_m, directions[1])
    assert settled == 0.7


class Actions(RunObserver):
    """What the Operator was told."""

    def __init__(self):
        self.said = []

    def on_action(self, text):
        self.said.append(text)


@pytest.mark.parametrize(("settle_time_s", "moves_each"), [(0.3, 0), (6.0, 1)])
def test_key_is_moved_before_a_press_only_after_it_has_rested_for_its_time(run_scenario, settle_time_s, moves_each):
    actions = Actions()
    run_scenario(SCENARIO, replace(PARAMETERS, settle_time_s=settle_time_s, key_rest_limit_s=5.0), observer=actions)
    presses = sum(text.startswith("press at ") for text in actions.said)
    assert presses >= 4 * 6
    assert actions.said.count("move the key so that it does not sleep") == moves_each * presses


# The end of a line, and lines without an answer


def test_radials_that_answer_in_between_let_the_test_go_on(run_scenario, world):
    take = world.take

    def answer_on_the_right(desired):
        world.press_range_m = 5.2 if world.y < -1.0 else 0.0
        take(desired)
    world.take = answer_on_the_right
    results = run_scenario(SCENARIO, PARAMETERS)
    assert [result.reach for result in results] == ["no_answer", "measured", "no_answer", "no_answer"]
    assert [len(saved) for saved in run_scenario.saved[:4]] == [1, 2, 3, 4]


def test_third_silent_radial_in_a_row_ends_the_test_after_one_that_answered(run_scenario, world):
    take = world.take

    def answer_in_front(desired):
        world.press_range_m = 5.2 if world.x > 2.0 and abs(world.y) < 0.1 else 0.0
        take(desired)
    world.take = answer_in_front
    with pytest.raises(RobotFailed, match="answered nowhere on 3 radials"):
        run_scenario(SCENARIO, PARAMETERS)
    assert [result.reach for result in run_scenario.progress.results] == ["measured", "no_answer", "no_answer"]


@pytest.mark.parametrize(("kept", "trouble", "goes_on"), [
    ([], "", False), ([False, False], "", False), ([False, True], "", True), ([True, False], "", True),
    ([True], "The link was interrupted.", False)])
def test_search_goes_on_with_presses_of_which_one_worked(kept, trouble, goes_on):
    line = SCENARIO.lines(PARAMETERS, CAR)[0]
    assert SCENARIO.can_go_on(line, PARAMETERS, Listed(kept, trouble), None) is goes_on
    assert SCENARIO.can_go_on(line, replace(PARAMETERS, method="scan"), Listed(kept, trouble), None) is False


# One more measurement of a line


@pytest.fixture(name="wanted")
def wanted_fixture(monkeypatch):
    """wanted(result, **parameters): plan of the further measurement of a radial, None when there is none."""
    monkeypatch.setattr(search, "_measured", lambda trial, plan, robot, so_far: plan)

    def ask(result, **changes):
        parameters = replace(PARAMETERS, **changes)
        return SCENARIO.measure_further(SCENARIO.lines(parameters, CAR)[0], parameters, Listed(), None, result)
    return ask


@pytest.mark.parametrize(("low_m", "high_m", "interval_m", "next_m"), [
    (4.0, 5.6, 0.5, 0.4), (4.0, 6.4, 0.5, 0.5), (4.0, 4.1, 0.5, 0.05), (4.0, 4.1, 0.05, 0.05),
    (None, 5.0, 0.5, 0.5), (4.0, None, 0.5, 0.5)])
def test_further_presses_are_to_halve_the_interval(wanted, low_m, high_m, interval_m, next_m):
    plan = wanted(radial(1, 4.5, 4.0, d50_low_m=low_m, d50_high_m=high_m, worked_at_m=10 * (4.0,),
                         failed_at_m=2 * (6.0,)), interval_m=interval_m)
    assert (plan.interval_m, plan.attempts_limit) == (pytest.approx(next_m), 12 + 8)


@pytest.mark.parametrize(("presses", "goes_on"), [(29, True), (30, False)])
def test_line_gets_three_times_the_presses_that_are_allowed_at_most(wanted, presses, goes_on):
    assert (wanted(radial(1, 4.5, 4.0, worked_at_m=presses * (4.0,)), attempts_limit=10) is not None) is goes_on


def test_invalid_line_is_not_measured_further(wanted):
    assert wanted(replace(radial(1), status=LineStatus.INVALID)) is None


# What a search may take


def test_widths_of_the_radials_that_are_measured_stand_for_those_of_the_others():
    def of_width(width_m):
        # The width is that from 90 to 10 %, and d95 lies ln 19 of the logistic curve's scales before d50.
        return radial(1, 6.0, 6.0 - width_m / (2.0 * math.log(9.0)) * math.log(19.0))
    measured = [of_width(width_m) for width_m in (0.5, 1.5, 5.0)]
    found = SCENARIO.forecast(PARAMETERS, LockFacts(), [*measured, radial(4, 6.0), radial(5)])
    expected = search_forecast(PARAMETERS.search_plan, UsualWidths(1.5, 9.0, 1.5), ())
    assert found.attempts == expected.attempts and found.interval_m == pytest.approx(expected.interval_m)
    assert found.line_s == pytest.approx(expected.line_s)
    assert found != SCENARIO.forecast(PARAMETERS, LockFacts(), ())


def test_forecast_before_the_first_radial_is_from_a_sharp_to_a_soft_end_of_the_range():
    assert SCENARIO.forecast(PARAMETERS, LockFacts(), ()) == search_forecast(PARAMETERS.search_plan, WIDTHS, ())
    sharp, soft = (search_forecast(PARAMETERS.search_plan, UsualWidths(width_m, 1.0, width_m), ())
                   for width_m in (0.4, 2.2))
    both = search_forecast(PARAMETERS.search_plan, UsualWidths(0.4, 1.0, 2.2), ())
    assert (both.attempts, both.interval_m, both.line_s) == (
        (sharp.attempts[0], soft.attempts[1]), (sharp.interval_m[0], soft.interval_m[1]),
        (sharp.line_s[0], soft.line_s[1]))


def test_scan_has_no_interval_and_no_cautions_and_its_radials_say_nothing_of_each_other():
    scan = replace(PARAMETERS, method="scan", attempts_limit=6)
    assert SCENARIO.forecast(scan, LockFacts(), ()).interval_m is None and SCENARIO.cautions(scan, LockFacts()) == ()
    assert SCENARIO.concluded(scan, [radial(1, 5.0, 4.0, worked_at_m=(4.0,), failed_at_m=(6.0,))]) == ()
    assert SCENARIO.can_go_on(SCENARIO.lines(scan, CAR)[0], scan, None, None) is False


def test_widest_interval_that_may_be_asked_for_is_the_most_that_a_caution_asks_for():
    coarse = replace(PARAMETERS, minimum_distance_m=3.0, maximum_distance_m=50.0, attempts_limit=6, interval_m=0.05)
    caution, = SCENARIO.cautions(coarse, LockFacts())
    assert 0.05 < float(caution.rsplit("ask for ", 1)[1].split()[0]) <= 5.0
    assert caution.startswith("6 presses on each radial reach an interval of ")
    assert "where the Car's range ends within 1 m; interval_m asks for 0.05 m: " in caution


def test_caution_names_the_presses_that_would_do_with_their_parameter():
    caution, = SCENARIO.cautions(replace(PARAMETERS, attempts_limit=10, interval_m=0.2), LockFacts())
    assert re.search(r": allow \d+ presses \(attempts_limit\), or ask for 0\.\d\d m\.$", caution)
