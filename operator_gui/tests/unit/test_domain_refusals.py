"""What is refused during a test is counted and ends in its record: Statuses, frames, Commands, and why it ended."""
# SPDX-License-Identifier: Apache-2.0
from dataclasses import replace

import pytest

from mtr_operator.car_link.can_frame import CanFrame
from mtr_operator.car_link.lock_watch import LockWatch
from mtr_operator.car_link.profile import load_profile
from mtr_operator.domain.actions.control_loop import ControlLoop
from mtr_operator.domain.errors import RobotFailed
from mtr_operator.domain.results.journal import SESSION, Journal
from mtr_operator.domain.results.progress import Progress
from mtr_operator.domain.results.refusals import Refusals
from mtr_operator.domain.results.refused import Refused
from mtr_operator.domain.results.session_record import (
    ENDED_BY,
    RECOVERED,
    REFUSED_COMMANDS,
    REFUSED_FRAMES,
    REFUSED_STATUSES,
)
from mtr_operator.domain.robot_status import CarCheck, CheckState
from mtr_operator.domain.runner import Runner
from mtr_operator.domain.scenarios import SCENARIOS

SPEED = "The speed is 1e30 m/s; allowed is at most 5 m/s."


class Diary(Journal):
    def __init__(self):
        self.entries = []

    def add(self, kind, values):
        self.entries.append((kind, dict(values)))


@pytest.fixture
def run(robot_link, car_link):
    def measure(progress=None):
        scenario = SCENARIOS["autolock"]
        parameters = scenario.parameters_type.from_mapping({"measurements_distance_m": 10.0})
        measure.diary = Diary()
        measure.progress = progress or Progress("autolock", parameters.to_mapping())
        loop = ControlLoop(robot_link, car_link)
        Runner(scenario, parameters, loop, measure.progress, lambda _: None,
               journal=measure.diary).run()
        return measure.progress.session
    return measure


def spoil(world, when_s, change):
    """At each Status of a time on, something is changed."""
    before = world.spoil

    def both(status):
        status = before(status)
        return change(status) if status.stamp_s >= when_s else status
    world.spoil = both


def test_test_without_refusals_has_none_in_its_record(run):
    assert not set(run()) & {REFUSED_STATUSES, REFUSED_FRAMES, REFUSED_COMMANDS, ENDED_BY, RECOVERED}


def test_implausible_statuses_are_counted_into_the_record_with_the_last_sentence(run, world, robot_link):
    def refuse(status):
        robot_link.statistics.implausible = min(robot_link.statistics.implausible + 1, 3)
        robot_link.statistics.last_error = SPEED
        return status
    spoil(world, 5.0, refuse)
    assert run()[REFUSED_STATUSES] == f"3; the last one: {SPEED}"
    assert any(kind == SESSION and REFUSED_STATUSES in values for kind, values in run.diary.entries)


def test_commands_that_the_robot_refused_are_counted_from_the_beginning_of_the_test(run, world):
    spoil(world, 0.0, lambda status: replace(status, rejected_messages=40 if status.stamp_s < 5.0 else 42))
    assert run()[REFUSED_COMMANDS] == "2"


def test_robot_that_counts_anew_adds_what_it_refuses_from_then_on(world, robot_link):
    refusals, status = Refusals(), robot_link.next_status(0.1)
    for count in (7, 9, 0, 1):
        refusals.look(replace(status, rejected_messages=count), robot_link.statistics, Refused())
    assert refusals._counts == {REFUSED_COMMANDS: 3}


def test_continued_test_goes_on_counting(run, world, robot_link):
    progress = Progress("autolock", SCENARIOS["autolock"].parameters_type.from_mapping(
        {"measurements_distance_m": 10.0}).to_mapping(), {REFUSED_STATUSES: "12; the last one: Before.",
                                                          REFUSED_FRAMES: "many", "started": "2026"})
    robot_link.statistics.undecodable, robot_link.statistics.last_error = 1, "A message was ignored."
    assert run(progress)[REFUSED_STATUSES] == "13; the last one: A message was ignored."


def test_flood_of_bad_messages_is_written_once_a_second_and_counted_whole(run, world, robot_link):
    def refuse(status):
        robot_link.statistics.oversized += 100
        return status
    spoil(world, 0.0, refuse)
    session = run()
    entries = [values for kind, values in run.diary.entries if kind == SESSION]
    assert len(entries) <= world.time_s + 2
    # But for what comes while the robot is stopped at the end.
    assert int(session[REFUSED_STATUSES]) >= 0.9 * robot_link.statistics.oversized


def test_test_that_ends_before_its_end_says_why_in_its_record(run, world):
    world.check = CarCheck(1, CheckState.FAILED, message="The Car stands elsewhere.")
    with pytest.raises(RobotFailed) as ended:
        run()
    assert run.progress.session[ENDED_BY] == str(ended.value)


def test_what_a_recovered_test_has_lost_stands_in_its_record(run):
    progress = Progress("autolock", SCENARIOS["autolock"].parameters_type.from_mapping(
        {"measurements_distance_m": 10.0}).to_mapping(), notice="The journal is damaged from entry 7 on.")
    assert run(progress)[RECOVERED] == "The journal is damaged from entry 7 on."


def test_frames_that_are_not_believed_are_counted_across_a_restart_of_the_adapter():
    watch = LockWatch(load_profile("mtr_demo_car"))
    frame_id = watch._profile.message.frame_id
    for index in range(3):
        # The counter stands still: a gateway sends an old frame again.
        watch.frame(CanFrame(frame_id, False, bytes(8), 0.02 * index))
    watch.restart()
    assert watch.refused.count == 2 and "stands still" in watch.refused.last
