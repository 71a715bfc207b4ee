"""The Sleep time scenario on a kinematic robot with a key that sleeps at rest."""
# SPDX-License-Identifier: Apache-2.0
from dataclasses import replace

import pytest

from mtr_operator.domain.assistance import OPERATOR, OUTPUT
from mtr_operator.domain.errors import InvalidParameter, RobotFailed
from mtr_operator.domain.ports import HANDLE, LockFacts
from mtr_operator.domain.results.line_result import LineStatus, result_from_document
from mtr_operator.domain.results.progress import Progress
from mtr_operator.domain.robot_status import CarDimensions
from mtr_operator.domain.scenarios.sleep_time import SCENARIO
from mtr_operator.domain.scenarios.sleep_time.parameters import SleepTimeParameters
from mtr_operator.domain.scenarios.sleep_time.result import SleepTimeResult
from mtr_operator.domain.scenarios.sleep_time.still_trial import trials_of

CAR = CarDimensions(4.5, 1.8, 0.02, 0.01)
PARAMETERS = SleepTimeParameters(shortest_wait_s=2.0, longest_wait_s=16.0, interval_s=4.0, confirmations=1, requests=2,
                                 self_check=False)


@pytest.fixture(autouse=True)
def key(world):
    """Sleeps after so long at rest; `lapses` are requests that fail all the same, by their number from 1."""
    class Key:
        sleep_s, moved_s, asked, lapses = 7.0, 0.0, 0, ()

    drive, take_handle, key = world._drive, world.take_handle, Key()

    def step(dt_s):
        place = world.key()
        drive(dt_s)
        if world.key() != place:
            key.moved_s = world.time_s

    def take():
        key.asked += 1
        if world.time_s - key.moved_s < key.sleep_s and key.asked not in key.lapses:
            take_handle()

    world._drive, world.take_handle = step, take
    world.unlock_m, world.lock_m, world.facts = -1.0, -1.0, LockFacts(frozenset({HANDLE}))
    return key


def test_interval_holds_the_sleep_time(run_scenario, world, key, output):
    result, = run_scenario(SCENARIO, PARAMETERS)
    assert (result.status, result.asleep, result.side) == (LineStatus.OK, "measured", "left")
    assert result.answers_until_s <= key.sleep_s <= result.silent_from_s + 0.1
    # The requests of a silence take a while themselves.
    assert result.silent_from_s - result.answers_until_s <= PARAMETERS.interval_s + PARAMETERS.response_timeout_s
    assert result.trials == len(result.answered_after_s) + len(result.unanswered_after_s)
    assert (result.requested_by, result.cause, result.disturbed) == (OUTPUT, HANDLE, 0)
    assert result.distance_m == pytest.approx(PARAMETERS.minimum_distance_m, abs=0.02)
    assert result.findings == (f"asleep after {result.answers_until_s:.1f} to {result.silent_from_s:.1f} s",)
    assert world.locked and result_from_document(SleepTimeResult, result.to_document()) == result


def test_key_without_a_motion_sensor_is_awake_for_at_least_the_longest_rest(run_scenario, key, output):
    key.sleep_s = 1e9
    result, = run_scenario(SCENARIO, PARAMETERS)
    assert (result.status, result.asleep, result.silent_from_s) == (LineStatus.OK, "later", None)
    assert result.answers_until_s >= PARAMETERS.longest_wait_s - 0.1 and not result.unanswered_after_s
    assert result.findings == (f"awake for at least {result.answers_until_s:.1f} s",)


def test_key_that_sleeps_before_the_shortest_rest_has_an_upper_end_only(run_scenario, key, output):
    key.sleep_s = 1.5
    result, = run_scenario(SCENARIO, replace(PARAMETERS, trials_limit=4))
    assert (result.asleep, result.answers_until_s) == ("sooner", None)
    assert result.findings == (f"asleep after {result.silent_from_s:.1f} s at most",)


def test_single_request_that_is_lost_is_no_sleep(run_scenario, key, output):
    key.lapses = (1,)
    result, = run_scenario(SCENARIO, PARAMETERS)
    assert result.answers_until_s <= key.sleep_s <= result.silent_from_s + 0.1
    assert result.answered_after_s[0] == pytest.approx(2.0 + PARAMETERS.response_timeout_s, abs=0.3)


def test_silence_that_no_motion_ends_is_no_sleep_but_a_key_that_is_not_heard(run_scenario, world, output):
    world.handle_m = 0.1
    result, = run_scenario(SCENARIO, PARAMETERS)
    assert result.status is LineStatus.INVALID and "right after it was moved" in result.reason
    assert (result.trials, result.findings, result.asleep) == (0, (), "unknown")


def test_person_who_takes_their_time_is_counted_by_the_rest_there_was(run_scenario, key, person):
    person.delay_s = 1.5
    result, = run_scenario(SCENARIO, PARAMETERS, person=person)
    assert result.requested_by == OPERATOR and result.answered_after_s[0] == pytest.approx(3.5, abs=0.3)
    assert result.answers_until_s <= key.sleep_s <= result.silent_from_s + 0.1


def test_disturbed_trial_is_made_again_and_told(run_scenario, world, output):
    world.foreign.append((20.0, False, "inside_switch"))
    result, = run_scenario(SCENARIO, PARAMETERS)
    assert (result.status, result.disturbed) == (LineStatus.OK, 1)


def test_trials_that_are_always_disturbed_make_the_line_invalid(run_scenario, world, output):
    world.car_problem = lambda time_s: "The bus is silent." if time_s > 10.0 and world.time_s % 4.0 < 0.3 else ""
    result, = run_scenario(SCENARIO, PARAMETERS)
    assert result.status is LineStatus.INVALID and result.disturbed >= 3 and "bus is silent" in result.reason


def test_interrupted_test_goes_on_with_the_trials_that_are_kept(run_scenario, key, output):
    class Enough(Exception):
        pass

    handle_request, asked = output.request, []

    def request(distance_m):
        asked.append(distance_m)
        if len(asked) == 4:
            raise RobotFailed("The robot has gone.")
        handle_request(distance_m)

    output.request = request
    with pytest.raises(RobotFailed):
        run_scenario(SCENARIO, PARAMETERS)
    before = run_scenario.progress
    kept = [word for word, point in before.points.items() if point.status is LineStatus.OK]
    assert kept
    result, = run_scenario(SCENARIO, PARAMETERS, Progress(**vars(before)))
    assert result.status is LineStatus.OK
    assert result.answers_until_s <= key.sleep_s <= result.silent_from_s + 0.1
    # None of the waits that were kept was waited again.
    assert len(asked) - 4 < len(result.answered_after_s) + 8 * len(result.unanswered_after_s)
    assert result.answered_after_s[0] == pytest.approx(2.0, abs=0.3)


@pytest.mark.parametrize(("changes", "sentence"), [
    ({"minimum_distance_m": 0.2}, "minimum_distance_m is 0.2 m; allowed is clearance_m, 0.3 m"),
    ({"wake_move_m": 1.9}, "wake_move_m is 1.9 m; allowed is at most 1.4 m"),
    ({"requests": 3}, "interval_s is 4 s; allowed is more than 6 s"),
    ({"longest_wait_s": 2.0}, "longest_wait_s is 2 s; it has to be longer than shortest_wait_s, 2 s")])
def test_parameters_that_contradict_each_other_are_refused(changes, sentence):
    with pytest.raises(InvalidParameter, match=sentence):
        replace(PARAMETERS, **changes)


def test_silence_counts_only_with_the_answer_that_followed_a_motion():
    points = {"held 1": (True, 5.0), "held 2": (False, 9.0), "held 3": (False, 8.0), "held 3 moved": (True, 0.3),
              "held 5": (True, 6.0)}
    assert [(trial.rest_s, trial.answered) for trial in trials_of(points)] == [(5.0, True), (8.0, False)]


@pytest.mark.parametrize("changes", [
    {"trials": 99}, {"asleep": "perhaps"}, {"answers_until_s": 3.21}, {"answered_after_s": [-1.0], "trials": 1},
    {"answers_until_s": None, "silent_from_s": None}])
def test_damaged_result_is_refused(changes):
    good = SleepTimeResult(1, "left", 1.0, LineStatus.OK, "measured", 5.0, 8.0, 2, (5.0,), (8.0,), distance_m=0.6)
    assert result_from_document(SleepTimeResult, good.to_document()) == good
    with pytest.raises(ValueError):
        result_from_document(SleepTimeResult, {**good.to_document(), **changes})


def test_picture_shows_where_the_key_was_held():
    result = SleepTimeResult(1, "left", 1.0, LineStatus.OK, "measured", 5.0, 8.0, 2, (5.0,), (8.0,), distance_m=0.6)
    held, invalid = SCENARIO.picture(PARAMETERS, CAR, [result]).point_sets
    assert held.points == ((0.0, pytest.approx(1.5)),) and invalid.points == ()
    _, invalid = SCENARIO.picture(PARAMETERS, CAR, [replace(result, status=LineStatus.INVALID, distance_m=None,
                                                             reason="None.")]).point_sets
    assert len(invalid.points) == 1


def test_forecast_counts_trials_and_rests_of_keys_that_sleep_soon_late_or_never():
    forecast = SCENARIO.forecast(SleepTimeParameters(), LockFacts(), ())
    few, many = forecast.attempts
    shortest_s, longest_s = forecast.line_s
    assert 4 <= few < many <= 24 and shortest_s < 600.0 and longest_s > 3600.0
    assert shortest_s < SCENARIO.expected_line_s(SleepTimeParameters()) < longest_s
