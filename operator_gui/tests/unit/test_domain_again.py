"""Lines that the Operator wants measured once more."""
# SPDX-License-Identifier: Apache-2.0
import dataclasses

import pytest

from mtr_operator.domain.actions.observer import RunObserver
from mtr_operator.domain.actions.trouble import Cancelled
from mtr_operator.domain.errors import OperatorError
from mtr_operator.domain.results.session_record import CONTROLLED_BY, MEASURED_AGAIN, again_text
from mtr_operator.domain.scenarios import SCENARIOS
from mtr_operator.domain.scenarios.key_press_parameters import KeyPressParameters
from mtr_operator.storage.progress_document import progress_from_document

SCENARIO = SCENARIOS["key_press"]
PARAMETERS = KeyPressParameters.from_mapping({"method": "scan", "angle_between_radials_deg": 90.0})


class Seen(RunObserver):
    """Attributes: plan: done and total as planned. done: after each line."""

    def __init__(self):
        self.plan, self.done = None, []

    def on_plan(self, done, total):
        self.plan = (done, total)

    def on_result(self, result, done, total):
        self.done.append((result.number, done))


@pytest.fixture
def measured(run_scenario):
    """The progress of a whole test."""
    run_scenario(SCENARIO, PARAMETERS)
    return run_scenario.progress


@pytest.fixture
def run_again(run_scenario, world, measured):
    """Goes on with that test in a new session, whose ids begin anew."""
    def run(**arguments):
        world.pressed.clear()
        world.presses.clear()
        world.waypoint = None
        return run_scenario(SCENARIO, PARAMETERS, measured, **arguments)
    return run


def test_chosen_lines_get_new_results_and_no_other_ones(run_again, measured):
    before, seen = list(measured.results), Seen()
    run_again(again=(2, 4), observer=seen)
    changed = [new.number for old, new in zip(before, measured.results) if new.robot_time_s != old.robot_time_s]
    assert (changed, [result.number for result in measured.results]) == ([2, 4], [1, 2, 3, 4])
    assert (seen.plan, seen.done) == ((2, 4), [(2, 3), (4, 4)])
    assert measured.session[MEASURED_AGAIN] == "2, 4"


def test_nothing_is_measured_again_without_a_wish(run_again, measured):
    seen = Seen()
    run_again(observer=seen)
    assert seen.done == [] and MEASURED_AGAIN not in measured.session


def test_line_without_a_result_is_measured_once(run_again, measured):
    measured.results = measured.results[:3]
    seen = Seen()
    run_again(again=(3, 4, 77), observer=seen)
    assert [number for number, _ in seen.done] == [4, 3]


def test_result_stays_when_its_line_cannot_be_measured_again(run_again, measured, world):
    before = measured.results[1]
    world.car_problem = lambda time_s: "No CAN frame."
    with pytest.raises(OperatorError, match="No CAN frame"):
        run_again(again=(2,))
    assert measured.results[1] == before


def test_interrupted_wish_keeps_every_result(run_again, measured):
    seen = Seen()
    with pytest.raises(Cancelled):
        run_again(again=(1, 2), observer=seen, is_cancelled=lambda: bool(seen.done))
    assert len(measured.results) == 4 and [number for number, _ in seen.done] == [1]


def test_progress_of_lines_measured_twice_is_read_back(run_again, measured):
    run_again(again=(2, 2))
    run_again(again=(2,))
    assert measured.session[MEASURED_AGAIN] == "2, 2, 2"
    document = measured.to_document()
    assert progress_from_document(document, SCENARIO, PARAMETERS.to_mapping()).results == measured.results


def test_record_names_all_that_were_measured_again():
    assert again_text({}, (3,)) == "3"
    assert again_text({MEASURED_AGAIN: "3"}, (1, 2)) == "3, 1, 2"


@pytest.mark.parametrize(("name", "recorded"), [("Jana's laptop", "Jana's laptop"), ("", None)])
def test_record_names_whose_key_controlled_the_robot(run_scenario, world, name, recorded):
    spoil = world.spoil
    world.spoil = lambda status: dataclasses.replace(spoil(status), controller_name=name)
    run_scenario(SCENARIO, PARAMETERS)
    session = run_scenario.progress.session
    assert session.get(CONTROLLED_BY) == recorded
    assert session.get("link") == ("encrypted" if recorded else None)
