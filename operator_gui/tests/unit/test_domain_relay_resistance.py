"""The Relay resistance scenario on a kinematic robot, with an extender that makes the key nearer."""
# SPDX-License-Identifier: Apache-2.0
import math
from dataclasses import replace

import pytest

from mtr_operator.domain.assistance import OPERATOR, OUTPUT
from mtr_operator.domain.errors import ConnectionFailed, InvalidParameter, RobotFailed
from mtr_operator.domain.ports import HANDLE, LockFacts
from mtr_operator.domain.results.figure import Figure, Kind, figure_of
from mtr_operator.domain.results.line_result import LineStatus, result_from_document
from mtr_operator.domain.results.progress import Progress
from mtr_operator.domain.robot_status import CarDimensions
from mtr_operator.domain.scenarios.relay_resistance import SCENARIO
from mtr_operator.domain.scenarios.relay_resistance.parameters import RelayResistanceParameters
from mtr_operator.domain.scenarios.relay_resistance.result import RelayResistanceResult
from mtr_operator.domain.scenarios.relay_resistance.tally import upper_bound

CAR = CarDimensions(4.5, 1.8, 0.02, 0.01)
PARAMETERS = RelayResistanceParameters(places_m=(2.0, 3.0), requests_per_place=2, measurements_distance_m=10.0,
                                       self_check=False)
REQUESTS = 4


@pytest.fixture(autouse=True)
def handle_only(world):
    world.unlock_m, world.lock_m, world.facts = -1.0, -1.0, LockFacts(frozenset({HANDLE}))


def test_car_that_an_extender_opens_is_not_resistant(run_scenario, world, output, extender):
    result, = run_scenario(SCENARIO, PARAMETERS)
    assert (result.status, result.resistance, result.reason) == (LineStatus.OK, "not_resistant", "")
    assert (result.requests_off, result.unlocks_off, result.requests_on, result.unlocks_on) == (
        REQUESTS, 0, REQUESTS, REQUESTS)
    assert result.distance_m == pytest.approx(PARAMETERS.maximum_distance_m, abs=0.02)
    assert (result.requested_by, result.switched_by, result.cause) == (OUTPUT, OUTPUT, HANDLE)
    assert extender.switched == [False, True] and world.locked
    assert result.findings == (f"not resistant: with the extender 4 of 4 unlocked, up to {result.distance_m:.2f} m",)
    assert result_from_document(RelayResistanceResult, result.to_document()) == result


def test_car_that_stays_locked_is_bounded_and_never_just_resistant(run_scenario, output, extender):
    extender.nearer_m = 0.0
    result, = run_scenario(SCENARIO, PARAMETERS)
    assert (result.status, result.resistance, result.unlocks_on) == (LineStatus.NOT_REACHED, "bounded", 0)
    assert result.bound_on == pytest.approx(1.0 - 0.05 ** (1.0 / REQUESTS), abs=1e-6)
    assert result.findings == ("resistant but for at most 52.7 % (95 %): with the extender 0 of 4 unlocked",)
    # Before and after the silence the key was heard inside the zone.
    assert output.asked[0] == output.asked[-1] == pytest.approx(PARAMETERS.minimum_distance_m, abs=0.02)
    assert result_from_document(RelayResistanceResult, result.to_document()) == result


def test_single_unlock_beyond_the_border_is_enough_and_its_place_is_the_farthest(run_scenario, output, extender):
    extender.nearer_m = 0.8
    result, = run_scenario(SCENARIO, PARAMETERS)
    assert (result.resistance, result.unlocks_on) == ("not_resistant", 2)
    assert result.distance_m == pytest.approx(2.0, abs=0.02)
    # A silence farther away ends no range.
    assert figure_of(result.distances[0]) == Figure(Kind.VALUE, result.distance_m)


def test_zone_that_reaches_farther_by_itself_is_a_finding_of_its_own(run_scenario, world, output, extender):
    world.handle_m, extender.nearer_m = 2.2, 0.0
    result, = run_scenario(SCENARIO, PARAMETERS)
    assert (result.unlocks_off, result.unlocks_on, result.resistance) == (2, 2, "not_resistant")
    assert result.findings[1].startswith("zone beyond its border: without the extender 2 of 4 unlocked")


def test_key_that_is_not_heard_inside_the_zone_proves_no_resistance(run_scenario, world, output, extender):
    world.handle_m, extender.nearer_m = 0.1, 0.0
    result, = run_scenario(SCENARIO, PARAMETERS)
    assert result.status is LineStatus.INVALID and "its silence beyond the border says nothing" in result.reason
    assert (result.resistance, result.findings) == ("", ())


def test_key_that_dies_during_the_silence_proves_no_resistance(run_scenario, world, output, extender):
    extender.nearer_m = 0.0
    request = output.request

    def dying(distance_m):
        if len(output.asked) > 3:
            world.handle_m = 0.1
        request(distance_m)

    output.request = dying
    result, = run_scenario(SCENARIO, PARAMETERS)
    assert result.status is LineStatus.INVALID and result.resistance == ""


def test_unlock_that_no_hand_asked_for_makes_the_axis_invalid(run_scenario, world, output, extender):
    world.foreign.append((20.0, False, "inside_switch"))
    extender.nearer_m = 0.0
    results = run_scenario(SCENARIO, PARAMETERS)
    # It is measured again at the end, undisturbed.
    assert [result.status for result in results] == [LineStatus.NOT_REACHED]
    assert any(result.status is LineStatus.INVALID for saved in run_scenario.saved for result in saved)


def test_place_that_is_not_surely_beyond_the_border_counts_for_nothing(run_scenario, spoil, output, extender):
    spoil(lambda status: True, position_sigma_m=0.4)
    result, = run_scenario(SCENARIO, PARAMETERS)
    assert result.status is LineStatus.INVALID and "not surely beyond the nominal border at 1.5 m" in result.reason
    assert result.requests_off == result.requests_on == 0


def test_robot_that_does_not_know_its_sigma_measures_nothing(run_scenario, spoil, output, extender):
    spoil(lambda status: True, position_sigma_m=math.nan)
    result, = run_scenario(SCENARIO, PARAMETERS)
    assert result.status is LineStatus.INVALID and result.resistance == ""


def test_person_switches_when_asked(run_scenario, world, output, extender):
    extender.by, extender.delay_s = OPERATOR, 3.0
    result, = run_scenario(SCENARIO, PARAMETERS)
    assert (result.switched_by, result.resistance) == (OPERATOR, "not_resistant")


def test_extender_that_nobody_switches_interrupts_the_test(run_scenario, extender, output):
    extender.delay_s = None
    with pytest.raises(RobotFailed, match="Nobody has switched the extender within 5 s"):
        run_scenario(SCENARIO, replace(PARAMETERS, switch_timeout_s=5.0))


def test_test_without_anybody_at_the_extender_does_not_begin(run_scenario, robot_link, output):
    with pytest.raises(ConnectionFailed, match="Nobody switches the extender"):
        run_scenario(SCENARIO, PARAMETERS)
    assert all(desired.waypoint is None for _, desired in robot_link.answers)


def test_key_that_stood_too_long_is_moved_before_it_is_asked(run_scenario, world, output, extender):
    extender.nearer_m = 0.0
    parameters = replace(PARAMETERS, key_rest_limit_s=5.0, response_timeout_s=3.0, requests_per_place=4)
    result, = run_scenario(SCENARIO, parameters)
    assert result.requests_on == 8 and result.resistance == "bounded"


def test_interrupted_test_goes_on_with_the_requests_that_are_kept(run_scenario, world, output, extender):
    request = output.request

    def failing(distance_m):
        if len(output.asked) == 1 + REQUESTS + 1:
            raise RobotFailed("The robot has gone.")
        request(distance_m)

    output.request = failing
    with pytest.raises(RobotFailed):
        run_scenario(SCENARIO, PARAMETERS)
    before = run_scenario.progress
    assert "relay on 1 1" in before.points and "relay on 1 2" not in before.points
    output.request, output.asked, extender.switched = request, [], []
    result, = run_scenario(SCENARIO, PARAMETERS, Progress(**vars(before)))
    assert (result.requests_off, result.requests_on, result.unlocks_on) == (REQUESTS, REQUESTS, REQUESTS)
    # The proof again, and what was missing; nobody knows what the extender did meanwhile.
    assert len(output.asked) == 1 + REQUESTS - 1 and extender.switched == [False, True]


@pytest.mark.parametrize(("changes", "sentence"), [
    ({"minimum_distance_m": 0.2}, "minimum_distance_m is 0.2 m; allowed is clearance_m, 0.3 m"),
    ({"minimum_distance_m": 1.6}, "minimum_distance_m is 1.6 m; it has to be at most border_distance_m, 1.5 m"),
    ({"places_m": (2.0, 1.6)}, "places_m has 1.6 m; allowed is 1.7 m, which is 0.2 m beyond border_distance_m, to 3 m"),
    ({"places_m": (3.5,)}, "places_m has 3.5 m; allowed is 1.7 m"),
    ({"maximum_distance_m": 1.6}, "places_m has")])
def test_parameters_that_contradict_each_other_are_refused(changes, sentence):
    with pytest.raises(InvalidParameter, match=sentence):
        replace(PARAMETERS, **changes)


def test_places_are_tried_from_near_to_far_and_have_a_default():
    assert RelayResistanceParameters().tried_places_m == (2.25, 3.0)
    assert RelayResistanceParameters(places_m=(3.0, 1.7, 3.0)).tried_places_m == (1.7, 3.0)
    assert RelayResistanceParameters.from_mapping({"places_m": [2, 2.5]}).tried_places_m == (2.0, 2.5)


def test_axes_are_those_of_the_side():
    assert {line.side for line in SCENARIO.lines(PARAMETERS, CAR)} == {"left"}
    assert len({line.side for line in SCENARIO.lines(replace(PARAMETERS, side="all"), CAR)}) > 4


def good(**changes):
    return replace(RelayResistanceResult(
        1, "left", 1.0, LineStatus.NOT_REACHED, "bounded", 1.5, 1, 0, round(upper_bound(0, 1), 6), 2, 0,
        round(upper_bound(0, 2), 6), (), (2.0,), (), (2.0, 3.0)), **changes)


@pytest.mark.parametrize("changes", [
    {"requests_on": 3}, {"unlocks_off": 1}, {"bound_on": 0.1}, {"bound_off": None}, {"resistance": "not_resistant"},
    {"resistance": ""}, {"border_m": None}, {"border_m": 2.5}, {"silent_off_m": [], "requests_off": 0},
    {"silent_off_m": [], "requests_off": 0, "bound_off": None}])
def test_damaged_result_is_refused(changes):
    assert result_from_document(RelayResistanceResult, good().to_document()) == good()
    with pytest.raises(ValueError):
        result_from_document(RelayResistanceResult, {**good().to_document(), **changes})


def test_picture_shows_each_request_by_what_came_of_it():
    result = good(status=LineStatus.OK, resistance="not_resistant", unlocks_on=1, unlocked_on_m=(3.0,),
                  silent_on_m=(2.0,), distance_m=3.0, bound_on=0.975)
    farthest, unlocked, locked, invalid = SCENARIO.picture(PARAMETERS, CAR, [result]).point_sets
    assert farthest.points == unlocked.points == ((0.0, pytest.approx(3.9)),)
    assert len(locked.points) == 1 and invalid.points == ()


def test_expected_time_grows_with_the_requests():
    short_s, long_s = (SCENARIO.expected_line_s(replace(PARAMETERS, requests_per_place=count)) for count in (1, 11))
    assert long_s - short_s == pytest.approx(2 * 2 * 10 * 1.8)


def test_silence_is_no_distance_that_a_limit_could_pass_by():
    ends = SCENARIO.unreached(PARAMETERS, good(), "relay")
    assert ends == (None, None)
    assert figure_of(good().distances[0], ends) == Figure(Kind.NOT_REACHED)
