"""How far the robot's clock is from the laptop's: told to the Operator, kept in the record, silent in simulation."""
# SPDX-License-Identifier: Apache-2.0
import math
import re
from dataclasses import replace

import pytest

from mtr_operator.cli import main
from mtr_operator.domain.clocks.clock_offset import ClockOffset, offset_sentence, span_text
from mtr_operator.domain.clocks.simulated_time import is_simulated
from mtr_operator.domain.ports import LockState
from mtr_operator.domain.results.session_record import CLOCK_OFFSET, clock_record
from mtr_operator.domain.robot_status import RobotStatus
from mtr_operator.domain.scenarios import SCENARIOS
from mtr_operator.station.checks.checklist import Facts, checklist, hindrances
from mtr_operator.station.checks.finding import Check, Finding, State
from mtr_operator.station.events import RobotSnapshot
from mtr_operator.station.mailbox import Mailbox

# 26 November 2026.
NOW_S = 1_795_651_200.0
HOUR_S = 3600.0


def status(sent_s, steady_s=math.nan, number=1, robot_session_id=1):
    return RobotStatus(number, robot_session_id, sent_s, sent_s=sent_s, steady_s=steady_s)


def heard(*statuses, delays_s=None):
    """The offset after these; each arrives so long after it was sent by a clock that is an hour ahead."""
    delays = iter(delays_s or [0.0] * len(statuses))
    each = ClockOffset(lambda: NOW_S + next(delays))
    for one in statuses:
        each.learn(one)
    return each.ahead_s


def test_least_late_status_tells_the_offset():
    sent = [status(NOW_S + HOUR_S, 5.0, number) for number in (1, 2, 3)]
    assert heard(*sent, delays_s=[3.0, 0.004, 0.5]) == pytest.approx(HOUR_S - 0.004)


@pytest.mark.parametrize(("told", "simulated"), [
    (status(NOW_S, 5.0), False), (status(12.3, 12.3), True), (status(12.3), True), (status(NOW_S), False),
    # Its battery is empty: it began in 1970 when it was switched on, beside its steady clock by a part of a second.
    (status(12.3, 12.1), False), (status(NOW_S, NOW_S), True)])
def test_simulated_time_is_told_from_the_time_of_day(told, simulated):
    assert is_simulated(told) is simulated
    assert math.isnan(heard(told)) is simulated


def test_clock_that_was_set_and_another_start_of_the_robot_begin_anew():
    assert heard(status(NOW_S + HOUR_S, 5.0), status(NOW_S + 2.0, 5.1, 2)) == pytest.approx(2.0)
    assert heard(status(NOW_S + HOUR_S), status(NOW_S + 2.0, number=1, robot_session_id=2)) == pytest.approx(2.0)


def test_clock_of_the_laptop_that_was_set_is_forgotten():
    now = [NOW_S]
    offset = ClockOffset(lambda: now[0])
    offset.learn(status(NOW_S + HOUR_S))
    now[0] += HOUR_S
    for number in range(2, 60):
        offset.learn(status(NOW_S + HOUR_S, number=number))
    assert offset.ahead_s == pytest.approx(0.0)


@pytest.mark.parametrize(("seconds", "text"), [
    (1.04, "1.0 s"), (89.9, "89.9 s"), (91.0, "2 min"), (3569.0, "59 min"), (3599.0, "1 h 0 min"),
    (HOUR_S, "1 h 0 min"), (23.99 * HOUR_S, "23 h 59 min"), (50.0 * HOUR_S, "2 d 2 h")])
def test_span_is_told_in_two_units(seconds, text):
    assert span_text(seconds) == text


@pytest.mark.parametrize("ahead_s", [0.0, 0.99, -0.99, math.nan])
def test_nothing_is_said_of_clocks_that_agree(ahead_s):
    assert offset_sentence(ahead_s) == ""


def test_sentence_names_side_span_and_what_to_do():
    assert offset_sentence(HOUR_S).startswith("The robot's clock is 1 h 0 min ahead of this laptop's: distances do ")
    assert offset_sentence(-1.5).startswith("The robot's clock is 1.5 s behind this laptop's: ")
    assert "set the one that is wrong" in offset_sentence(-1.5)


@pytest.mark.parametrize(("told", "state", "finding"), [
    (status(NOW_S + HOUR_S, 5.0), State.NOTE, Finding.ROBOT_CLOCK_APART),
    (status(NOW_S - HOUR_S, 5.0), State.NOTE, Finding.ROBOT_CLOCK_APART),
    (status(NOW_S + 0.4, 5.0), State.GOOD, Finding.ROBOT_CLOCK_FINE),
    (status(5.0, 5.0), State.UNKNOWN, Finding.ROBOT_CLOCK_SIMULATED)])
def test_checklist_notes_clocks_that_are_apart_and_hinders_nothing(told, state, finding):
    mailbox = Mailbox(wall_clock=lambda: NOW_S)
    mailbox.put_robot(RobotSnapshot(told, LockState.LOCKED, ""))
    items = checklist(Facts(mailbox.take().robot, 0.1))
    found, = (item for item in items if item.check is Check.ROBOT_CLOCK)
    assert (found.state, found.finding) == (state, finding)
    assert found not in hindrances(items)
    assert found.said == offset_sentence(told.sent_s - NOW_S if state is State.NOTE else 0.0)


def test_record_has_the_offset_of_a_robot_that_tells_the_time_of_day():
    assert clock_record(-0.0124) == {CLOCK_OFFSET: "-0.012 s"} and clock_record(math.nan) == {}


@pytest.fixture
def hour_ahead(world, robot_link, car_link, monkeypatch):
    """The command line's links: to a robot whose clock is an hour ahead of the laptop's, and to the Car."""
    monkeypatch.setattr("mtr_operator.cli.run.robot_link", lambda options, is_real_time: robot_link)
    monkeypatch.setattr("mtr_operator.cli.run.car_link", lambda options: car_link)
    monkeypatch.setattr("mtr_operator.domain.actions.control_loop.ClockOffset",
                        lambda: ClockOffset(lambda: NOW_S + world.time_s))
    world.spoil = lambda told: replace(told, sent_s=NOW_S + HOUR_S + told.stamp_s, steady_s=told.stamp_s)


def test_run_says_it_in_a_line_and_keeps_it_in_the_record(hour_ahead, tmp_path, capsys):
    (tmp_path / "parameters.yaml").write_text("measurements_distance_m: 10.0\n", encoding="utf-8")
    out = tmp_path / "out"
    assert main(["run", "autolock", "--params", str(tmp_path / "parameters.yaml"), "--out", str(out)]) == 0
    said = capsys.readouterr().err.splitlines()
    assert said.count(f"warning: {offset_sentence(HOUR_S)}") == 1
    assert re.search(rf"^# {CLOCK_OFFSET}: 3600\.000 s$", (out / "results.csv").read_text(encoding="utf-8"), re.M)


def test_simulated_robot_is_neither_warned_of_nor_recorded(run_scenario, world):
    world.spoil = lambda told: replace(told, sent_s=told.stamp_s, steady_s=told.stamp_s)
    scenario = SCENARIOS["autolock"]
    run_scenario(scenario, scenario.parameters_type.from_mapping({"measurements_distance_m": 10.0}))
    assert CLOCK_OFFSET not in run_scenario.progress.session
