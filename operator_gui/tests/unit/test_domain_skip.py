"""Lines that the Operator skips while they are measured."""
# SPDX-License-Identifier: Apache-2.0
from dataclasses import replace

import pytest

from mtr_operator.domain.actions.observer import RunObserver
from mtr_operator.domain.actions.skipping import Skipping
from mtr_operator.domain.actions.trouble import LineSkipped
from mtr_operator.domain.errors import ProgressFileError
from mtr_operator.domain.ports import HANDLE, LockFacts
from mtr_operator.domain.results.journal import SKIPPED
from mtr_operator.domain.results.notebook import apply
from mtr_operator.domain.scenarios import SCENARIOS
from mtr_operator.storage.progress_document import progress_from_document

KEY_PRESS = SCENARIOS["key_press"]
PARAMETERS = KEY_PRESS.parameters_type.from_mapping({"method": "scan", "angle_between_radials_deg": 90.0})
ZONES = {"presses_limit": 6, "coverage_percent": 1.0, "angle_between_radials_deg": 45.0}
SAID = "The line was skipped by the Operator."


class Skips(RunObserver):
    """Skips lines so many Statuses after they began, or when an action begins so.

    Attributes: begun: lines, in order; 0 for the end of each. said: actions.
    """

    def __init__(self, lines, after=20, said=""):
        self.skipping, self.begun, self.said = Skipping(), [], []
        self._lines, self._after, self._action, self._count = list(lines), after, said, 0

    def on_line(self, number):
        self.begun.append(number)
        self._count = 0

    def on_status(self, status):
        self._count += 1
        if self._count == self._after and not self._action:
            self._skip()

    def on_action(self, text):
        self.said.append(text)
        if self._action and text.startswith(self._action):
            self._skip()

    def _skip(self):
        if self.begun and self._lines and self.begun[-1] == self._lines[0]:
            self.skipping.skip(self._lines.pop(0))


@pytest.fixture
def run(run_scenario):
    """run(lines, scenario, parameters): a test in which these lines are skipped; its progress, and what was told."""
    def run(lines=(), scenario=KEY_PRESS, parameters=PARAMETERS, *, after=20, said="", **arguments):
        seen = Skips(lines, after, said)
        run_scenario(scenario, parameters, observer=seen, skipping=seen.skipping, **arguments)
        return run_scenario.progress, seen
    return run


@pytest.fixture
def anew(world):
    """The next run is a session of its own, whose ids begin anew."""
    def begin():
        world.pressed.clear()
        world.presses.clear()
        world.waypoint = None
    return begin


def skipped_of(progress):
    return [result.number for result in progress.results if SAID in result.reason]


def test_line_that_is_skipped_says_so_and_the_test_goes_on_with_the_next(run):
    progress, seen = run([2])
    assert [result.number for result in progress.results] == [1, 2, 3, 4]
    assert (skipped_of(progress), progress.skipped, progress.retried) == ([2], [2], [])
    assert all(not result.invalid_count for result in progress.results if result.number != 2)
    # Not tried once more at the end, as other invalid lines are.
    assert seen.begun == [1, 0, 2, 0, 3, 0, 4, 0]


def test_skip_comes_before_the_rest_of_the_line_is_measured(run, robot_link):
    run([1, 2, 3, 4], after=2)
    assert not any(desired.press for _, desired in robot_link.answers)


@pytest.mark.parametrize(("name", "values"), [("autolock", {}), ("zone_map", ZONES), ("key_press", {}),
                                              ("key_press", {"method": "scan"})])
def test_every_way_of_measuring_can_be_skipped(run, name, values):
    scenario = SCENARIOS[name]
    parameters = scenario.parameters_type.from_mapping({**values, "self_check": False})
    progress, _ = run([1, 3], scenario, parameters)
    assert skipped_of(progress) == progress.skipped == [1, 3]


def test_sleep_time_that_is_skipped_makes_no_further_trial(run, world, output):
    scenario = SCENARIOS["sleep_time"]
    world.unlock_m, world.lock_m, world.facts = -1.0, -1.0, LockFacts(frozenset({HANDLE}))
    parameters = scenario.parameters_type.from_mapping({
        "shortest_wait_s": 2.0, "longest_wait_s": 16.0, "interval_s": 4.0, "requests": 2, "self_check": False})
    progress, seen = run([1], scenario, parameters, said="trial 1")
    assert skipped_of(progress) == [1] and not any("made again" in text for text in seen.said)


def test_further_pass_that_is_skipped_leaves_what_is_measured(run):
    scenario = SCENARIOS["autolock"]
    parameters = replace(scenario.parameters_type(), self_check=False, measurements_distance_m=10.0, passes=2,
                         measuring_speeds_mps=(0.4, 0.1))
    progress, _ = run([1], scenario, parameters, said="pass 2: approach")
    assert [result.unlock_passes for result in progress.results][:2] == [1, 2]
    assert progress.skipped == [] and not any(result.invalid_count for result in progress.results)


def test_request_for_a_line_that_is_over_skips_no_other():
    skipping = Skipping()
    skipping.begin(3)
    skipping.skip(2)
    skipping.look()
    skipping.skip(3)
    with pytest.raises(LineSkipped):
        skipping.look()
    skipping.look()
    assert skipping.is_skipped
    skipping.skip(4)
    skipping.end()
    skipping.begin(4)
    skipping.look()
    assert not skipping.is_skipped


def test_skipped_line_is_measured_again_on_request_only(run, anew):
    progress, _ = run([2])
    anew()
    progress, seen = run(progress=progress)
    assert seen.begun == [] and progress.skipped == [2]
    anew()
    progress, seen = run(progress=progress, again=(2,))
    assert seen.begun == [2, 0] and progress.skipped == [] and not skipped_of(progress)
    assert all(not result.invalid_count for result in progress.results)


def test_skip_while_a_line_is_measured_again_keeps_its_former_result(run, anew):
    progress, _ = run()
    before = list(progress.results)
    anew()
    progress, _ = run([3], progress=progress, again=(3,))
    assert progress.results == before and progress.skipped == []


def test_progress_file_says_which_lines_were_skipped_and_one_without_is_as_before(run, anew):
    whole, _ = run()
    assert "skipped" not in whole.to_document()
    anew()
    progress, _ = run([2])
    document = progress.to_document()
    assert document["skipped"] == [2]
    assert progress_from_document(document, KEY_PRESS, PARAMETERS.to_mapping()).skipped == [2]
    for wrong in ([9], ["2"], 2):
        with pytest.raises(ProgressFileError, match="damaged"):
            progress_from_document({**document, "skipped": wrong}, KEY_PRESS, PARAMETERS.to_mapping())


def test_journal_alone_says_that_a_line_was_skipped(run):
    progress, _ = run([2])
    progress.skipped = []
    apply(progress, KEY_PRESS.result_type, SKIPPED, {"line": 2})
    assert progress.to_retry() == []
