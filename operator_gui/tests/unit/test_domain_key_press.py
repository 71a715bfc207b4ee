"""The Key press scenario against a kinematic robot and a Car with a range."""
# SPDX-License-Identifier: Apache-2.0
import contextlib
import math
from dataclasses import replace

import pytest

from mtr_operator.domain.errors import InvalidParameter, RobotFailed
from mtr_operator.domain.ports import KEY_BUTTON, PASSIVE_ENTRY, LockFacts
from mtr_operator.domain.results.figure import Figure, Kind, figure_of
from mtr_operator.domain.robot_status import CarDimensions
from mtr_operator.domain.scenarios.key_press import SCENARIO
from mtr_operator.domain.scenarios.key_press_parameters import KeyPressParameters

CAR = CarDimensions(4.5, 1.8, 0.02, 0.01)
PARAMETERS = KeyPressParameters.from_mapping({"angle_between_radials_deg": 90.0, "confirming_presses": 0})
CONFIRMED = replace(PARAMETERS, confirming_presses=1)


@pytest.fixture(autouse=True)
def passive_entry_off(world):
    world.unlock_m, world.lock_m = -1.0, -1.0


def buttons(robot_link):
    pressed = {desired.press.id: desired.press.buttons[0] for _, desired in robot_link.answers if desired.press}
    return [pressed[number] for number in sorted(pressed)]


def test_farthest_place_that_works_is_found_with_the_next_one_that_fails(run_scenario):
    results = run_scenario(SCENARIO, PARAMETERS)
    assert [result.angle_deg for result in results] == [0.0, 90.0, 180.0, 270.0]
    for result in results:
        assert result.status.value == "ok"
        assert result.distance_m == pytest.approx(5.0)
        assert result.failed_distance_m == pytest.approx(5.5)
        assert result.attempts == 3
        assert result.uncertainty_m == pytest.approx(0.03)


def test_button_is_the_one_that_changes_the_lock_state(run_scenario, robot_link):
    run_scenario(SCENARIO, PARAMETERS)
    assert buttons(robot_link) == [2, 2, 2, 1, 1, 1, 2, 2, 2, 1, 1, 1]


def test_time_is_the_beginning_of_the_press_that_worked(run_scenario, world):
    results = run_scenario(SCENARIO, PARAMETERS)
    assert [result.robot_time_s for result in results] == pytest.approx(
        [world.presses[index].start_s for index in (2, 5, 8, 11)])


def test_first_place_that_works_has_no_failed_one(run_scenario, world):
    world.press_range_m = 20.0
    result = run_scenario(SCENARIO, PARAMETERS)[0]
    assert (result.status.value, result.distance_m) == ("ok", pytest.approx(6.0))
    assert result.failed_distance_m is None
    assert result.attempts == 1


def works_on(world, *angles_deg):
    """The Car obeys on some radials only."""
    def obey(status):
        clockwise_deg = -math.degrees(math.atan2(status.y, status.x)) % 360.0
        world.press_range_m = 5.2 if any(abs(clockwise_deg - angle_deg) < 20.0 for angle_deg in angles_deg) else 0.0
        return status
    world.spoil = obey


def test_no_place_that_works_is_not_reached(run_scenario, world):
    works_on(world, 90.0, 180.0, 270.0)
    result = run_scenario(SCENARIO, PARAMETERS)[0]
    assert (result.status.value, result.distance_m, result.robot_time_s) == ("not_reached", None, None)
    assert result.failed_distance_m == pytest.approx(3.0)
    assert result.attempts == 7


def test_key_that_answers_on_no_radial_is_asked_for(run_scenario, world):
    world.press_range_m = 0.0
    with pytest.raises(RobotFailed, match="answered nowhere on 3 radials one after the other; see whether it sleeps"):
        run_scenario(SCENARIO, PARAMETERS)
    assert len(run_scenario.progress.results) == 2


def test_key_that_stops_to_answer_during_the_test_is_asked_for(run_scenario, world):
    works_on(world, 0.0)
    with pytest.raises(RobotFailed, match="answered nowhere on 3 radials"):
        run_scenario(SCENARIO, PARAMETERS)
    assert [result.status.value for result in run_scenario.progress.results] == ["ok", "not_reached", "not_reached"]


def test_two_radials_without_an_answer_are_a_range_that_ends_nearer(run_scenario, world):
    works_on(world, 0.0, 270.0)
    assert [result.status.value for result in run_scenario(SCENARIO, PARAMETERS)] == [
        "ok", "not_reached", "not_reached", "ok"]


def test_each_place_gets_all_its_attempts(run_scenario):
    results = run_scenario(SCENARIO, replace(PARAMETERS, attempts=3))
    assert results[0].attempts == 7
    assert results[0].failed_distance_m == pytest.approx(5.5)


def test_place_whose_second_attempt_works_is_none_that_failed(run_scenario, world):
    take, lapsed = world.take, set()

    def lapse(desired):
        """The first press at 5 m on each radial finds the Car deaf."""
        press, radial = desired.press, round(math.atan2(*world.key()), 1)
        is_lapsing = (press is not None and press.id not in world.pressed and radial not in lapsed
                      and math.hypot(*world.key()) == pytest.approx(5.0, abs=0.05))
        world.press_range_m = 0.0 if is_lapsing else 5.2
        lapsed.update([radial] if is_lapsing else [])
        take(desired)
    world.take = lapse
    results = run_scenario(SCENARIO, replace(PARAMETERS, attempts=2))
    assert [result.attempts for result in results] == 4 * [6] and len(lapsed) == 4
    for result in results:
        assert (result.distance_m, result.failed_distance_m) == pytest.approx((5.0, 5.5), abs=0.01)
        assert figure_of(result.distances[0]) == Figure(Kind.BETWEEN, result.distance_m, result.failed_distance_m)


def test_reaction_after_the_time_limit_is_invalid_and_says_so(run_scenario):  # B10
    results = run_scenario(SCENARIO, replace(PARAMETERS, response_timeout_s=0.1, press_duration_s=0.05))
    assert results[0].status.value == "invalid"
    assert "too late for the press at 5.00 m; increase response_timeout_s" in results[0].reason


def test_change_by_the_keys_vicinity_is_no_answer_to_a_press(run_scenario, world):
    world.source_of = lambda source: PASSIVE_ENTRY
    result = run_scenario(SCENARIO, PARAMETERS)[0]
    assert (result.status.value, result.distance_m, result.failed_distance_m) == ("invalid", None, 5.5)
    assert result.reason == ("The Car was unlocked by the vicinity of a key, not by the press at 5.00 m; switch "
                                "passive entry off, or increase minimum_distance_m.")


def test_line_spoilt_once_by_the_keys_vicinity_is_measured_again(run_scenario, world):
    sources = [PASSIVE_ENTRY]
    world.source_of = lambda source: sources.pop() if sources else source
    results = run_scenario(SCENARIO, PARAMETERS)
    assert [result.status.value for result in run_scenario.saved[3]] == ["invalid", "ok", "ok", "ok"]
    assert [result.status.value for result in results] == 4 * ["ok"]
    assert results[0].distance_m == pytest.approx(5.0)


def test_car_that_names_no_sources_is_believed_and_the_cause_recorded_as_unknown(run_scenario, world):  # B2
    world.source_of, world.facts = lambda source: "", LockFacts()
    results = run_scenario(SCENARIO, PARAMETERS)
    assert [(result.status.value, result.cause) for result in results] == 4 * [("ok", "unknown")]


def test_source_that_the_profile_does_not_list_is_invalid(run_scenario, world):  # B2
    world.source_of = lambda source: ""
    results = run_scenario(SCENARIO, PARAMETERS)
    assert [result.status.value for result in results] == 4 * ["invalid"]
    assert "by something that its profile does not list, not by the press at 5.00 m" in results[0].reason


def test_press_that_the_robot_cannot_make_is_invalid(run_scenario, world):
    world.spoil = lambda status: replace(status, presses=tuple(
        replace(press, error="The servo is stuck.") for press in status.presses))
    result = run_scenario(SCENARIO, PARAMETERS)[0]
    assert result.status.value == "invalid"
    assert "The servo is stuck." in result.reason


def test_lost_position_makes_the_line_invalid_and_it_is_measured_again(run_scenario, spoil):
    spoil(lambda status: 4.0 < status.stamp_s < 4.5, pose_valid=False)
    results = run_scenario(SCENARIO, PARAMETERS)
    assert run_scenario.saved[0][0].status.value == "invalid"
    assert [result.status.value for result in results] == 4 * ["ok"]


def test_places_inside_the_car_are_refused_before_the_robot_moves(run_scenario, world):
    with pytest.raises(InvalidParameter, match=r"minimum_distance_m is 2 m; on the radial of 0 degrees .* 0\.00 m"):
        run_scenario(SCENARIO, replace(PARAMETERS, minimum_distance_m=2.0))
    assert world.waypoint is None


def test_last_place_is_exactly_the_minimum_distance(run_scenario, world, robot_link):
    works_on(world, 180.0)
    run_scenario(SCENARIO, PARAMETERS)
    nearest = min(desired.waypoint.pose.x for _, desired in robot_link.answers
                  if desired.waypoint and desired.waypoint.id <= 8)
    assert nearest == pytest.approx(3.25)


def test_picture_shows_both_places(run_scenario):
    results = run_scenario(SCENARIO, PARAMETERS)
    worked, failed, _, invalid = SCENARIO.picture(PARAMETERS, CAR, results).point_sets
    assert worked.points[1] == pytest.approx((0.0, -5.0), abs=1e-6)
    assert failed.points[1] == pytest.approx((0.0, -5.5), abs=1e-6)
    assert invalid.known == ()


def test_another_keys_button_is_not_taken_for_the_press(run_scenario, world, robot_link):
    take = world.take

    def interfere(desired):
        take(desired)
        if len(world.presses) == 1 and not world.foreign and world.locked:
            world.foreign.append((world.presses[0].start_s + 0.3, False, KEY_BUTTON))

    world.take = interfere
    result = run_scenario(SCENARIO, CONFIRMED)[0]
    assert (result.status.value, result.distance_m, result.failed_distance_m) == (
        "ok", pytest.approx(5.0), pytest.approx(5.5))
    # At 6 m, there again to tell that it was another key's, at 5.5 m, at 5 m, and there again to confirm it.
    assert (result.attempts, buttons(robot_link)[:5]) == (5, [2, 1, 1, 1, 2])


@pytest.mark.parametrize("reaction_s", [1.6, 2.0, 2.4])
def test_late_answer_to_the_press_before_is_not_taken_for_the_next_one(run_scenario, world, reaction_s):
    """The Car answers late to every press: none works in time."""
    world.reaction_s = reaction_s
    # On several radials one after the other that looks like a key that does not answer.
    with contextlib.suppress(RobotFailed):
        run_scenario(SCENARIO, CONFIRMED)
    results = run_scenario.progress.results
    assert len(results) >= 2 and all(result.distance_m is None for result in results)


def test_confirmed_place_is_the_first_press_that_worked(run_scenario, world):
    result = run_scenario(SCENARIO, CONFIRMED)[0]
    assert (result.status.value, result.distance_m, result.attempts) == ("ok", pytest.approx(5.0), 4)
    assert result.robot_time_s == pytest.approx(world.presses[2].start_s)


def test_instant_of_a_press_is_known_and_adds_nothing_to_the_uncertainty_of_a_key_that_creeps(run_scenario, spoil):
    spoil(lambda status: True, speed_mps=0.05)
    result = run_scenario(SCENARIO, PARAMETERS)[0]
    assert (result.status.value, result.uncertainty_m) == ("ok", pytest.approx(0.03))


def test_robot_that_moves_while_the_button_is_pressed_makes_the_radial_invalid(run_scenario, spoil):
    spoil(lambda status: True, speed_mps=0.2)
    result = run_scenario(SCENARIO, PARAMETERS)[0]
    assert result.status.value == "invalid"
    assert result.reason == "The robot was too fast for a measurement: 0.20 m/s; allowed is 0.10 m/s."
