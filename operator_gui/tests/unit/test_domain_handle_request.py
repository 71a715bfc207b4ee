"""The Handle request scenario on a kinematic robot and a Car that unlocks up to 1.5 m from its outline."""
# SPDX-License-Identifier: Apache-2.0
import math
from dataclasses import replace

import pytest

from mtr_operator.domain.actions.observer import RunObserver
from mtr_operator.domain.assistance import OPERATOR, OUTPUT
from mtr_operator.domain.errors import InvalidLimits, InvalidParameter, RobotFailed
from mtr_operator.domain.ports import HANDLE, KEY_BUTTON, PASSIVE_ENTRY, LockFacts
from mtr_operator.domain.requests import Direction
from mtr_operator.domain.results.line_result import LineStatus, result_from_document
from mtr_operator.domain.results.progress import Progress
from mtr_operator.domain.robot_status import CarDimensions
from mtr_operator.domain.scenarios.handle.hand import LOCK_PRESSES
from mtr_operator.domain.scenarios.handle_request import SCENARIO
from mtr_operator.domain.scenarios.handle_request.axis_trial import axes_of
from mtr_operator.domain.scenarios.handle_request.parameters import HandleRequestParameters
from mtr_operator.domain.scenarios.handle_request.result import HandleRequestResult
from mtr_operator.domain.verdict.limits import Limits
from mtr_operator.domain.verdict.requirement import Requirement
from mtr_operator.domain.verdict.suitability import check_before_start
from mtr_operator.storage.given_files import load_calibration

CAR = CarDimensions(4.5, 1.8, 0.02, 0.01)
ALL_SOURCES = LockFacts(frozenset({PASSIVE_ENTRY, KEY_BUTTON, HANDLE}))
# Three axes at the left side.
PARAMETERS = HandleRequestParameters(side="left", measurements_distance_m=2.0, self_check=False)
ONE_AXIS = replace(PARAMETERS, measurements_distance_m=10.0)


class Actions(RunObserver):
    """What the robot said it does."""

    def __init__(self):
        self.texts = []

    def on_action(self, text):
        self.texts.append(text)


@pytest.fixture(autouse=True)
def car_with_handle(world):
    """It unlocks by the handle only, and names its cause."""
    world.unlock_m, world.lock_m, world.facts = -1.0, -1.0, ALL_SOURCES


def test_border_is_found_on_every_axis_of_the_side(run_scenario, world, output):
    results = run_scenario(SCENARIO, PARAMETERS)
    assert [(result.axis, result.side) for result in results] == [(1, "left"), (2, "left"), (3, "left")]
    for result in results:
        assert result.status is LineStatus.OK and result.reach == "measured"
        assert result.d50_low_m <= world.handle_m <= result.d50_high_m
        assert (result.d50_high_m - result.d50_low_m) / 2.0 <= 1.05 * PARAMETERS.interval_m
        assert max(result.worked_at_m) <= world.handle_m + 0.01 < min(result.failed_at_m) + 0.02
        assert result.requested_by == OUTPUT and result.cause == HANDLE
        assert (result.inside, result.outside) == (len(result.worked_at_m), len(result.failed_at_m))
    assert len(output.asked) == output.released == sum(result.requests for result in results)


def test_place_of_the_key_is_as_unsure_as_the_outline_on_which_the_axis_begins(run_scenario, world, output):
    def measured(width_sigma):
        world.car = replace(CAR, width_sigma=width_sigma)
        return run_scenario(SCENARIO, ONE_AXIS)[-1]
    sure, unsure = measured(0.0), measured(0.07)
    assert unsure.uncertainty_m == pytest.approx(math.hypot(sure.uncertainty_m, 0.035), rel=0.01)
    assert unsure.d50_sigma_m > sure.d50_sigma_m
    assert unsure.d50_high_m - unsure.d50_low_m > sure.d50_high_m - sure.d50_low_m


@pytest.mark.parametrize(("handle_m", "at_border"), [(1.8, (2, 0)), (1.2, (0, 2))])
def test_decisions_at_the_nominal_border_are_counted(run_scenario, world, output, handle_m, at_border):
    world.handle_m = handle_m
    result, = run_scenario(SCENARIO, ONE_AXIS)
    assert (result.border_m, result.inside_at_border, result.outside_at_border) == (1.5, *at_border)
    assert output.asked[:2] == pytest.approx([1.5, 1.5], abs=0.01)


def test_without_requests_at_the_border_it_is_searched_only(run_scenario, output):
    result, = run_scenario(SCENARIO, replace(ONE_AXIS, border_requests=0))
    assert (result.border_m, result.inside_at_border, result.outside_at_border) == (None, 0, 0)
    assert result.status is LineStatus.OK


def test_person_is_asked_where_there_is_no_output(run_scenario, world, person):
    result, = run_scenario(SCENARIO, ONE_AXIS, person=person)
    assert result.requested_by == OPERATOR and result.status is LineStatus.OK
    assert len(person.asked) == person.released == result.requests


def test_output_goes_before_the_person(run_scenario, output, person):
    run_scenario(SCENARIO, ONE_AXIS, person=person)
    assert output.asked and not person.asked


def test_car_that_unlocks_tells_that_the_handle_was_taken(run_scenario, world, person):
    """Nobody presses a key on the laptop with a hand at the handle."""
    said = person.request

    def take_only(distance_m):
        said(distance_m)
        world.take_handle()
        person.due_s = world.time_s + (0.5 if world.gap_m() > world.handle_m else math.inf)

    person.request = take_only
    result, = run_scenario(SCENARIO, ONE_AXIS, person=person)
    assert result.inside and result.outside and result.d50_low_m <= world.handle_m <= result.d50_high_m


def test_without_an_output_and_a_person_the_test_ends_with_a_sentence(run_scenario):
    with pytest.raises(RobotFailed, match="declares no handle_request, and there is no Operator"):
        run_scenario(SCENARIO, ONE_AXIS)


def test_person_who_does_not_come_is_waited_for_and_the_test_ends(run_scenario, world, person):
    person.delay_s = None
    with pytest.raises(RobotFailed, match="Nobody has taken the Car's handle within 20 s"):
        run_scenario(SCENARIO, replace(ONE_AXIS, handle_timeout_s=20.0), person=person)
    assert person.released == len(person.asked) == 1
    assert run_scenario.progress.results == []


def test_handle_taken_when_the_key_may_sleep_is_asked_for_again(run_scenario, world, person):
    """The first three times somebody is late, and the Car does not unlock."""
    delays, asked = [60.0, 60.0], person.request
    world_handle_m = world.handle_m

    def request(distance_m):
        person.delay_s = delays.pop() if delays else 0.5
        world.handle_m = world_handle_m if person.delay_s < 45.0 else 0.0
        asked(distance_m)

    person.request = request
    actions = Actions()
    result, = run_scenario(SCENARIO, ONE_AXIS, person=person, observer=actions)
    assert result.d50_low_m <= world_handle_m <= result.d50_high_m
    assert len(person.asked) == result.requests + 2
    assert actions.texts.count("move the key so that it does not sleep") >= 2


def test_person_who_is_always_late_makes_the_axis_invalid(run_scenario, world, person):
    person.delay_s, world.handle_m = 60.0, 0.0
    result, = run_scenario(SCENARIO, ONE_AXIS, person=person)
    assert result.status is LineStatus.INVALID and "had stood for more than 45 s" in result.reason


def presses(world):
    return len(world.presses)


def test_car_is_locked_by_the_button_after_each_unlock(run_scenario, world, output):
    result, = run_scenario(SCENARIO, ONE_AXIS)
    assert presses(world) == result.inside


def test_press_without_effect_is_repeated(run_scenario, world, output):
    take, failing = world.take, [2]

    def take_with_lapses(desired):
        is_new = desired.press is not None and desired.press.id not in world.pressed
        world.press_range_m = 0.0 if is_new and failing[0] > 0 else 99.0
        failing[0] -= is_new
        take(desired)

    world.take = take_with_lapses
    result, = run_scenario(SCENARIO, ONE_AXIS)
    assert result.status is LineStatus.OK and presses(world) == result.inside + 2


def test_car_that_is_not_locked_again_makes_the_axis_invalid(run_scenario, world, output):
    world.press_range_m = 0.0
    result, = run_scenario(SCENARIO, replace(ONE_AXIS, lock_timeout_s=5.0))
    assert result.status is LineStatus.INVALID
    assert result.reason.startswith("The Car was not locked again, not even 5 s after the key had gone away")
    assert presses(world) == 2 * LOCK_PRESSES  # the axis is measured twice


@pytest.mark.parametrize("cause", [PASSIVE_ENTRY, ""])
def test_car_may_lock_by_itself_as_the_key_goes_away(run_scenario, world, output, cause):
    """By walk-away, or by something that its bus does not name."""
    turn_locks = world.turn_locks

    def lock_later(locked, time_s, source):
        turn_locks(locked, time_s, source)
        if not locked:
            world.foreign.append((time_s + 4.0, True, cause))

    world.turn_locks = lock_later
    result, = run_scenario(SCENARIO, replace(ONE_AXIS, relock="itself"))
    assert result.status is LineStatus.OK and presses(world) == 0
    assert result.d50_low_m <= world.handle_m <= result.d50_high_m


def test_robot_comes_back_to_the_place_after_the_car_has_locked_by_itself(run_scenario, world, output, robot_link):
    turn_locks = world.turn_locks

    def lock_later(locked, time_s, source):
        turn_locks(locked, time_s, source)
        if not locked:
            world.foreign.append((time_s + 4.0, True, PASSIVE_ENTRY))

    world.turn_locks, world.handle_m = lock_later, 1.8
    run_scenario(SCENARIO, replace(ONE_AXIS, relock="itself"))
    assert output.asked[:2] == pytest.approx([1.5, 1.5], abs=0.02)
    assert Direction.BACKWARD in {desired.waypoint.direction for _, desired in robot_link.answers if desired.waypoint}


def test_unlocked_car_is_locked_before_the_first_request(run_scenario, world, output):
    world.locked = False
    result, = run_scenario(SCENARIO, ONE_AXIS)
    assert result.status is LineStatus.OK and presses(world) == result.inside + 1


def test_unlock_that_nobody_asked_for_makes_the_axis_invalid(run_scenario, world, output):
    take = world.take

    def unlock_on_the_way(desired):
        if len(output.asked) == 3 and output.released == 3 and world.locked and world.speed_mps > 0.0:
            world.foreign.append((world.time_s, False, PASSIVE_ENTRY))
        take(desired)

    world.take, world.handle_m = unlock_on_the_way, 1.2
    result, = run_scenario(SCENARIO, ONE_AXIS)
    invalid = [saved[0] for saved in run_scenario.saved if saved[0].status is LineStatus.INVALID]
    assert invalid and "too late for the handle request" in invalid[0].reason
    assert result.status is LineStatus.OK


@pytest.mark.parametrize(("source", "words"), [(KEY_BUTTON, "by the button of a key"),
                                               (PASSIVE_ENTRY, "by the vicinity of a key")])
def test_unlock_by_another_cause_is_no_answer_to_the_handle(run_scenario, world, output, source, words):
    world.source_of = lambda true: source if true == HANDLE else true
    result, = run_scenario(SCENARIO, ONE_AXIS)
    assert result.status is LineStatus.INVALID and words in result.reason


@pytest.mark.parametrize("sources", [frozenset(), frozenset({PASSIVE_ENTRY, KEY_BUTTON})])
def test_bus_that_tells_no_handle_is_believed_by_what_it_tells(run_scenario, world, output, sources):
    told = PASSIVE_ENTRY if sources else ""
    world.facts, world.source_of = LockFacts(sources), lambda true: told if true == HANDLE else true if sources else ""
    result, = run_scenario(SCENARIO, ONE_AXIS)
    assert result.status is LineStatus.OK and result.cause == (told or "unknown")


def test_key_that_answers_nowhere_is_no_border_of_zero(run_scenario, world, output):
    world.handle_m = -1.0
    result, = run_scenario(SCENARIO, ONE_AXIS)
    assert result.status is LineStatus.INVALID and result.reach == "no_answer" and result.d50_m is None
    assert "none of 3 at 0.50 m either" in result.reason


def test_key_that_answers_on_no_axis_is_asked_for(run_scenario, world, output):
    world.handle_m = -1.0
    with pytest.raises(RobotFailed, match="on 3 axes one after the other"):
        run_scenario(SCENARIO, PARAMETERS)


def test_zone_that_ends_beyond_the_places_has_a_lower_end_only(run_scenario, world, output):
    world.handle_m = 9.0
    result, = run_scenario(SCENARIO, ONE_AXIS)
    assert result.status is LineStatus.NOT_REACHED and result.reach == "farther"
    assert result.d50_m is None and result.d50_low_m is not None and result.d50_high_m is None


def test_heights_are_lines_of_their_own(run_scenario, world, output):
    results = run_scenario(SCENARIO, replace(ONE_AXIS, heights=2))
    assert [(result.axis, result.key_height_m) for result in results] == [(1, 1.0), (2, 1.4)]
    assert world.height_m == 1.4


def test_axes_of_all_sides_go_round():
    axes = axes_of(replace(PARAMETERS, side="all"), CAR)
    assert [axis.number for axis in axes] == list(range(1, len(axes) + 1))
    assert len({axis.side for axis in axes}) == 8
    assert {axis.side for axis in axes_of(replace(PARAMETERS, side="rear_left"), CAR)} == {"rear_left"}


def test_result_is_read_back_from_its_document_and_a_miscounted_one_is_not(run_scenario, output):
    result, = run_scenario(SCENARIO, ONE_AXIS)
    document = result.to_document()
    assert result_from_document(HandleRequestResult, document) == result
    with pytest.raises(ValueError, match="none of the scenario's"):
        result_from_document(HandleRequestResult, {**document, "inside": result.inside + 1})


def test_inconclusive_axis_gets_more_requests_and_keeps_its_counts(run_scenario, world, output):
    progress = Progress(SCENARIO.name, ONE_AXIS.to_mapping())
    progress.calibration = load_calibration()
    progress.limits = Limits((Requirement("zone", "handle", 1.45, None),), 30.0)
    check_before_start(progress.limits, SCENARIO, ONE_AXIS)
    first, = run_scenario(SCENARIO, ONE_AXIS)
    world.pressed, world.presses = set(), []
    more, = run_scenario(SCENARIO, ONE_AXIS, progress)
    assert more.requests == more.inside + more.outside > first.requests
    assert (more.inside_at_border, more.outside_at_border) == (first.inside_at_border, first.outside_at_border)
    assert more.d50_high_m - more.d50_low_m < first.d50_high_m - first.d50_low_m


def test_limit_that_names_no_axis_of_the_side_is_refused():
    limits = Limits((Requirement("right", "handle", 1.0, None, sides=("right",)),), 300.0)
    with pytest.raises(InvalidLimits, match="names no axis"):
        check_before_start(limits, SCENARIO, ONE_AXIS)


def test_picture_shows_border_and_every_decision(run_scenario, output):
    results = run_scenario(SCENARIO, PARAMETERS)
    sets = {points.label: points for points in SCENARIO.picture(PARAMETERS, CAR, results).point_sets}
    assert len(sets["Border: half of the requests inside"].points) == 3
    assert len(sets["Border: half of the requests inside"].intervals) == 3
    assert len(sets["Inside"].points) == sum(result.inside for result in results)
    assert len(sets["Outside"].points) == sum(result.outside for result in results)


def test_interval_that_cannot_be_reached_is_told_before_the_start():
    assert SCENARIO.cautions(PARAMETERS, LockFacts()) == ()
    too_few = replace(PARAMETERS, interval_m=0.02, attempts_limit=6, border_requests=0)
    sentence, = SCENARIO.cautions(too_few, LockFacts())
    assert sentence.startswith("6 requests on each axis reach an interval of")
    forecast = SCENARIO.forecast(PARAMETERS, LockFacts(), ())
    assert 2 < forecast.attempts[0] <= forecast.attempts[1] <= PARAMETERS.attempts_limit


@pytest.mark.parametrize(("values", "words"), [
    ({"minimum_distance_m": 0.2}, "allowed is clearance_m, 0.3 m, and more"),
    ({"maximum_distance_m": 1.5}, "the search needs 1.05 m"),
    ({"border_distance_m": 3.6}, "allowed is 0.5 to 3.5 m"),
    ({"border_requests": 30}, "at most attempts_limit, 20"),
    ({"heights": 2, "highest_key_height_m": 0.9}, "above key_height_m, 1 m")])
def test_parameters_that_contradict_are_refused(values, words):
    with pytest.raises(InvalidParameter, match=words):
        replace(PARAMETERS, **values)
