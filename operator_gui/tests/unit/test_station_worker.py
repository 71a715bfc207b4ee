"""The thread of the links, with the kinematic robot and Car of these tests."""
# SPDX-License-Identifier: Apache-2.0
import itertools
import json
import sys

import pytest
from post import LIMIT_S, Post

from mtr_operator.domain.absent_car import AbsentCarLink
from mtr_operator.domain.actions.standstill import Standstill
from mtr_operator.domain.errors import ConnectionFailed, InvalidParameter
from mtr_operator.domain.results.session_record import ENDED_BY
from mtr_operator.domain.scenarios import SCENARIOS
from mtr_operator.station.connection import SIMULATED, CanChoice, Connection, LinkOpener, robot_choice
from mtr_operator.station.events import (
    CarLinkOpened,
    EventLogged,
    LineMeasured,
    LinkRefused,
    LinksOpened,
    Outcome,
    ProgressSaved,
    RunEnded,
    StandstillSeen,
)
from mtr_operator.station.links.attention import Attention
from mtr_operator.station.links.idle_loop import CalibrationRequest, CarRequest
from mtr_operator.station.links.worker import Worker
from mtr_operator.station.test import new_test, open_test

CONNECTION = Connection(can=CanChoice(SIMULATED))
HUNG = "The window did not react for 1 s, nor would its Stop have: the robot was stopped."


class Opener(LinkOpener):
    """Hands out the world's links, or refuses."""

    def __init__(self, robot, car):
        self._robot, self._car = robot, car
        self.refusal = None

    def robot(self, choice):
        if self.refusal:
            raise self.refusal
        return self._robot

    def car(self, choice):
        return AbsentCarLink() if choice is None else self._car


@pytest.fixture
def post():
    return Post()


@pytest.fixture
def opener(robot_link, car_link):
    return Opener(robot_link, car_link)


@pytest.fixture
def worker(opener, post):
    made = Worker(CONNECTION, opener, post.box)
    yield made
    assert made.close(LIMIT_S)


@pytest.fixture
def four_lines(tmp_path):
    scenario = SCENARIOS["key_press"]
    parameters = scenario.parameters_type.from_mapping({"angle_between_radials_deg": 90.0})
    return new_test(scenario, parameters, tmp_path / "progress", CONNECTION)


def stored(test):
    return json.loads(test.path.read_text(encoding="utf-8"))["results"]


def test_whole_test_is_told_line_by_line_and_is_on_disk(worker, post, four_lines):
    worker.start()
    post.wait_for(LinksOpened)
    worker.run_test(four_lines)
    counts = [post.wait_for(LineMeasured).done for _ in range(4)]
    ended = post.wait_for(RunEnded)
    assert counts == [1, 2, 3, 4]
    assert (ended.outcome, ended.text, len(ended.results)) == (Outcome.COMPLETE, "", 4)
    assert len(stored(four_lines)) == 4
    assert open_test(four_lines.path).is_complete


@pytest.mark.parametrize(("refusal", "part"), [
    (InvalidParameter("Robot address is x."), "address"), (ConnectionFailed("Nothing listens there."), "robot")])
def test_refusal_names_the_part_and_ends_the_thread(worker, post, opener, refusal, part):
    opener.refusal = refusal
    worker.start()
    refused = post.wait_for(LinkRefused)
    assert (refused.part, refused.text) == (part, str(refusal))


def test_defect_while_the_links_are_opened_is_a_refusal_too(worker, post, opener):
    opener.refusal = ValueError("a driver's own")
    worker.start()
    refused = post.wait_for(LinkRefused)
    assert (refused.part, refused.text) == ("robot", "The application has a defect: ValueError: a driver's own")


def test_missing_contract_is_a_sentence_in_the_window_too(post, monkeypatch):
    for name in [name for name in sys.modules if name.startswith(("mtr_proto", "mtr_operator.robot_link."))]:
        monkeypatch.delitem(sys.modules, name)
    monkeypatch.setitem(sys.modules, "mtr_proto", None)
    worker = Worker(Connection(), LinkOpener(), post.box)
    worker.start()
    refused = post.wait_for(LinkRefused)
    assert worker.close(LIMIT_S)
    assert refused.part == "robot" and "mtr_proto, the contract with the robot, is not installed" in refused.text


def test_stop_ends_the_test_and_the_rest_is_measured_later(worker, post, four_lines, robot_link):
    worker.start()
    worker.run_test(four_lines)
    post.wait_for(LineMeasured)
    worker.stop()
    assert post.wait_for(RunEnded).outcome is Outcome.STOPPED
    before = stored(four_lines)
    assert any(desired.stop for _, desired in robot_link.answers)
    later = open_test(four_lines.path)
    worker.run_test(later)
    assert post.wait_for(RunEnded).outcome is Outcome.COMPLETE
    assert stored(later)[:len(before)] == before


def sleepy(post, opener, passed_s):
    """Worker on a laptop that sleeps when the time in passed_s leaps."""
    return Worker(CONNECTION, opener, post.box, lambda: Standstill(30.0, lambda: 0.0, lambda: passed_s[0]))


def test_laptop_that_sleeps_in_the_middle_of_a_line_pauses_the_test_which_goes_on_later(
        post, opener, four_lines, robot_link):
    passed_s, awake, next_status = [0.0], [], robot_link.next_status

    def asleep_in_the_second_line(timeout_s):
        if len(four_lines.progress.results) == 1 and not passed_s[0]:
            passed_s[0] = 40.0
            awake.append(len(robot_link.answers))
        return next_status(timeout_s)

    robot_link.next_status = asleep_in_the_second_line
    worker = sleepy(post, opener, passed_s)
    worker.start()
    worker.run_test(four_lines)
    ended = post.wait_for(RunEnded)
    said = ("The laptop slept for 40 s, and the robot stood meanwhile. The line at hand is measured anew when the test "
            "goes on.")
    assert (ended.outcome, ended.text, len(ended.results)) == (Outcome.FAILED, said, 1)
    assert all(desired.stop or desired.waypoint is None for _, desired in robot_link.answers[awake[0]:])
    assert said in [event.entry.text for event in post.events if isinstance(event, EventLogged)]
    robot_link.next_status = next_status
    later = open_test(four_lines.path)
    assert later.progress.session[ENDED_BY] == said
    worker.run_test(later)
    assert post.wait_for(RunEnded).outcome is Outcome.COMPLETE
    assert worker.close(LIMIT_S) and len(stored(later)) == 4


def test_robot_that_maps_the_car_stops_when_the_laptop_has_slept(post, opener, robot_link):
    passed_s = [0.0]
    worker = sleepy(post, opener, passed_s)
    worker.start()
    post.wait_for(LinksOpened)
    worker.request_car(CarRequest.MAP)
    worker.note("mapping")
    while "mapping" not in post.wait_for(EventLogged).entry.text:
        pass
    passed_s[0] = 7.0
    assert post.wait_for(StandstillSeen).text == "The laptop slept for 7 s, and the robot stood meanwhile."
    worker.note("awake")
    while "awake" not in post.wait_for(EventLogged).entry.text:
        pass
    assert worker.close(LIMIT_S)
    orders = [desired for _, desired in robot_link.answers]
    first = next(index for index, desired in enumerate(orders) if desired.map_car_id)
    assert not orders[first].stop and orders[-1].stop


@pytest.fixture
def hanging(opener, post):
    """A worker whose every look takes a twentieth of a second, and a list that grows as often as the view is seen."""
    seen, ticks = [], itertools.count()
    made = Worker(CONNECTION, opener, post.box, attention=Attention(lambda: len(seen), lambda: 0.05 * next(ticks)))
    yield made, seen
    assert made.close(LIMIT_S)


def test_test_of_a_window_that_hangs_is_stopped_and_kept(hanging, post, four_lines, robot_link):
    worker, seen = hanging
    next_status = robot_link.next_status

    def hangs_in_the_second_line(timeout_s):
        if not four_lines.progress.results:
            seen.append(timeout_s)
        return next_status(timeout_s)
    robot_link.next_status = hangs_in_the_second_line
    worker.start()
    worker.run_test(four_lines)
    ended = post.wait_for(RunEnded)
    assert (ended.outcome, ended.text, len(ended.results)) == (Outcome.STOPPED, HUNG, 1)
    assert robot_link.answers[-1][1].stop and len(stored(four_lines)) == 1
    assert HUNG in [event.entry.text for event in post.events if isinstance(event, EventLogged)]
    robot_link.next_status = lambda timeout_s: (seen.append(timeout_s), next_status(timeout_s))[1]
    worker.run_test(four_lines)
    assert post.wait_for(RunEnded).outcome is Outcome.COMPLETE


def test_robot_that_maps_the_car_for_a_window_that_hangs_is_stopped(hanging, post, robot_link):
    worker, seen = hanging
    next_status = robot_link.next_status

    def hangs_while_the_car_is_mapped(timeout_s):
        if not any(desired.map_car_id for _, desired in robot_link.answers):
            seen.append(timeout_s)
        return next_status(timeout_s)
    robot_link.next_status = hangs_while_the_car_is_mapped
    worker.start()
    post.wait_for(LinksOpened)
    worker.request_car(CarRequest.MAP)
    assert post.wait_for(StandstillSeen).text == HUNG
    assert worker.close(LIMIT_S)
    orders = [desired for _, desired in robot_link.answers]
    first = next(index for index, desired in enumerate(orders) if desired.map_car_id)
    assert not orders[first].stop and orders[-1].stop


def test_window_counts_as_hanging_only_while_the_application_runs():
    taken, now_s = [0], [0.0]
    attention = Attention(lambda: taken[0], lambda: now_s[0])

    def look_after(passed_s):
        now_s[0] += passed_s
        return attention.look()
    # The whole application was stopped: the window has had no time either.
    assert look_after(60.0) == ""
    assert look_after(0.4) == ""
    taken[0] += 1
    assert [look_after(0.4) for _ in range(3)] == [""] * 3
    assert [look_after(0.4) for _ in range(4)] == [HUNG] * 4
    taken[0] += 1
    assert [look_after(0.4) for _ in range(4)] == [""] * 3 + [HUNG]


def test_defect_of_a_scenario_is_a_sentence_and_the_thread_goes_on(worker, post, four_lines, monkeypatch):
    worker.start()
    monkeypatch.setattr(type(four_lines.scenario), "lines", lambda *_: 1 / 0)
    worker.run_test(four_lines)
    ended = post.wait_for(RunEnded)
    assert ended.outcome is Outcome.FAILED
    assert "ZeroDivisionError" in ended.text
    worker.use_can(None)
    post.wait_for(CarLinkOpened)


def test_robot_that_cannot_be_reached_ends_the_test_and_loses_nothing(worker, post, four_lines, opener):
    worker.start()
    worker.run_test(four_lines)
    post.wait_for(LineMeasured)
    worker.stop()
    post.wait_for(RunEnded)
    before = stored(four_lines)
    opener.refusal = ConnectionFailed("No answer from the subscriber port.")
    worker.run_test(four_lines)
    ended = post.wait_for(RunEnded)
    assert (ended.outcome, ended.text) == (Outcome.FAILED, "No answer from the subscriber port.")
    assert stored(four_lines) == before


def test_progress_is_saved_on_request_while_measuring(worker, post, four_lines):
    worker.start()
    worker.run_test(four_lines)
    post.wait_for(LineMeasured)
    worker.save(four_lines)
    assert post.wait_for(ProgressSaved).text == ""
    assert post.wait_for(RunEnded).outcome is Outcome.COMPLETE


def test_unwritable_folder_is_told_before_the_robot_moves(worker, post, four_lines, robot_link, tmp_path):
    (tmp_path / "progress").write_text("a file", encoding="utf-8")
    worker.start()
    worker.run_test(four_lines)
    ended = post.wait_for(RunEnded)
    assert ended.outcome is Outcome.NOT_SAVED
    assert "cannot be written" in ended.text
    assert all(desired.waypoint is None for _, desired in robot_link.answers)


def test_calibration_presses_once_and_keeps_the_height(worker, post, robot_link, world):
    worker.start()
    post.wait_for(LinksOpened)
    worker.calibrate(CalibrationRequest(0.8, (1,), 0.5, 0.2))
    worker.calibrate(CalibrationRequest(None, (), 1.0, 0.3))
    worker.use_can(None)
    post.wait_for(CarLinkOpened)
    while not world.presses or world.presses[0].end_s > world.time_s - 1.0:
        post.box.take()
    assert world.height_m == 0.8
    assert [press.id for press in world.presses] == [1]
    assert robot_link.answers[-1][1].press is None


def test_closing_ends_a_running_test_and_keeps_its_lines(worker, post, four_lines):
    worker.start()
    worker.run_test(four_lines)
    post.wait_for(LineMeasured)
    assert worker.close(LIMIT_S)
    assert post.wait_for(RunEnded).results
    assert stored(four_lines)


@pytest.mark.parametrize("text", ["", "x", "3334.5", "0"])
def test_port_that_is_none_is_refused(text):
    with pytest.raises(InvalidParameter, match="port"):
        robot_choice("127.0.0.1", text, "3333")


def test_simulated_robot_needs_nobody_who_listens():
    link = LinkOpener().robot(robot_choice(SIMULATED, "1", "2"))
    link.connect()
    try:
        first, second = link.next_status(1.0), link.next_status(1.0)
    finally:
        link.close()
    assert (second.id, second.stamp_s - first.stamp_s) == (first.id + 1, pytest.approx(0.1))
