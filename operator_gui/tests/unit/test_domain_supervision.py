"""What a test on a real robot requires: a person who is present and in charge, conditions, a preflight in motion."""
# SPDX-License-Identifier: Apache-2.0
import io
import math
import pathlib
import types
from dataclasses import replace

import pytest
import yaml

from mtr_operator.cli.enter import Enter
from mtr_operator.cli.release import PresenceQuestion
from mtr_operator.cli.run import CommandLineRun
from mtr_operator.domain.actions.control_loop import ControlLoop
from mtr_operator.domain.clocks.simulated_time import is_simulated_robot
from mtr_operator.domain.errors import InvalidIdentity, InvalidParameter, OperatorAbsent, RobotFailed
from mtr_operator.domain.identity.identity import Identity
from mtr_operator.domain.identity.laboratory import laboratory_from
from mtr_operator.domain.results.progress import Progress
from mtr_operator.domain.results.session_record import CONDITIONS_CONFIRMED, SUPERVISION
from mtr_operator.domain.robot_status import PREFLIGHT_VALID_S, PreflightItem, PreflightReport, RobotStatus
from mtr_operator.domain.runner import Runner
from mtr_operator.domain.scenarios import SCENARIOS
from mtr_operator.domain.supervision.conditions import CONDITIONS
from mtr_operator.domain.supervision.preflight_rule import preflight_hindrance
from mtr_operator.domain.supervision.presence import Presence, PresenceParameters
from mtr_operator.domain.supervision.supervision import Supervision

AUTOLOCK = SCENARIOS["autolock"]
PARAMETERS = AUTOLOCK.parameters_type.from_mapping({"measurements_distance_m": 10.0, "self_check": False})
IN_CHARGE = Identity(person_in_charge="M. Svoboda")
ALL = tuple(CONDITIONS)
NOW_S = 1000.0
STEADY_S = 50_000.0
FINE = PreflightReport(STEADY_S - 60.0, (), 40, 0, STEADY_S - 60.0)


class Clock:
    """Wall time that a test sets."""

    def __init__(self):
        self.now_s = NOW_S

    def __call__(self):
        return self.now_s


@pytest.fixture(name="clock")
def clock_fixture():
    """Clock of the presence."""
    return Clock()


@pytest.fixture(name="shown")
def shown_fixture():
    """What the view was told."""
    return []


@pytest.fixture(name="presence")
def presence_fixture(clock, shown):
    """Presence with the usual times."""
    return Presence(shown.append, clock=clock)


def test_person_is_asked_after_a_quarter_of_an_hour_and_has_a_minute(presence, clock, shown):
    clock.now_s += 899.9
    assert presence.look() == "" and shown == []
    clock.now_s += 0.1
    assert presence.look() == "" and shown == [True] and presence.is_asked
    clock.now_s += 59.9
    assert presence.look() == ""
    clock.now_s += 0.1
    assert presence.look() == ("Nobody confirmed within 60 s to be present: the robot was stopped. The test is kept; "
                               "resume it in sight of the robot.")
    assert presence.look() and shown == [True]
    presence.end()
    assert shown == [True, False]


def test_answer_postpones_the_next_question(presence, clock, shown):
    clock.now_s += 900.0
    presence.look()
    clock.now_s += 30.0
    presence.confirm()
    assert presence.look() == "" and shown == [True, False]
    clock.now_s += 899.0
    assert presence.look() == "" and not presence.is_asked
    clock.now_s += 1.0
    assert presence.look() == "" and presence.is_asked


def test_what_the_person_does_meanwhile_postpones_the_question(presence, clock, shown):
    for _ in range(10):
        clock.now_s += 800.0
        presence.confirm()
        assert presence.look() == ""
    assert shown == []


def test_confirmation_before_the_question_does_not_answer_it(presence, clock):
    presence.confirm()
    presence.ask()
    clock.now_s += 60.0
    assert presence.look().startswith("Nobody confirmed")


@pytest.mark.parametrize("wrong_s", [math.nan, math.inf])
def test_clock_that_tells_no_time_asks_and_then_stops(presence, clock, wrong_s):
    clock.now_s = wrong_s
    assert presence.look() == "" and presence.is_asked
    clock.now_s = math.nan
    assert presence.look().startswith("Nobody confirmed")


@pytest.mark.parametrize("times", [
    {"period_s": 59.9}, {"period_s": 1800.1}, {"answer_s": 9.9}, {"answer_s": 120.1}, {"period_s": math.nan},
    {"answer_s": math.inf}])
def test_times_beyond_their_range_are_refused(times):
    with pytest.raises(InvalidParameter, match="question for presence|questions for presence"):
        PresenceParameters(**times)


@pytest.mark.parametrize("status, is_simulated", [
    (RobotStatus(1, 1, 5.0, sent_s=5.0, steady_s=5.0), True),
    (RobotStatus(1, 1, 5.0, sent_s=1.7e9, steady_s=5.0, waits_for_answer=True), True),
    (RobotStatus(1, 1, 5.0, sent_s=1.7e9, steady_s=5.0), False),
    # A robot that was started without the date, and one of before.
    (RobotStatus(1, 1, 5.0, sent_s=5.0, steady_s=4.9), False), (RobotStatus(1, 1, 5.0, sent_s=5.0), False),
    (RobotStatus(1, 1, 5.0), False)])
def test_only_a_robot_that_shows_it_is_taken_for_a_simulated_one(status, is_simulated):
    assert is_simulated_robot(status) is is_simulated


@pytest.mark.parametrize("supervision, identity, words", [
    (Supervision(), IN_CHARGE, "^No test begins on a real robot without a person: .* unattended_stop"),
    (Supervision(unattended_stop="  "), IN_CHARGE, "^No test begins on a real robot without a person: "),
    (Supervision(Presence(print), confirmed=ALL), None, "without a person in charge"),
    (Supervision(Presence(print), confirmed=ALL), Identity(operator="J. Novak"), "without a person in charge"),
    (Supervision(unattended_stop="fence, PL d"), None, "without a person in charge"),
    (Supervision(Presence(print)), IN_CHARGE, "are confirmed: area, people, ground, weather, light, car, attendance.$"),
    (Supervision(Presence(print), confirmed=ALL[:-1]), IN_CHARGE, "are confirmed: attendance.$")])
def test_no_test_begins_on_a_real_robot_without(real_robot, robot_link, supervision, identity, words):
    with pytest.raises(RobotFailed, match=words):
        real_robot(supervision, identity)
    assert not any(desired.waypoint or desired.key_height_m for _, desired in robot_link.answers)


@pytest.fixture(name="real_robot")
def real_robot_fixture(robot_link, car_link, world):
    """run(supervision, identity, report) measures on a robot whose clock is that of a real one."""
    def run(supervision, identity=IN_CHARGE, report=FINE, observer=None):
        world.spoil = lambda status: replace(status, simulated=False, sent_s=1.7e9 + status.stamp_s,
                                             steady_s=STEADY_S + status.stamp_s,
                                             preflight=report)
        progress = run.progress = Progress(AUTOLOCK.name, PARAMETERS.to_mapping(), identity=identity)
        loop = ControlLoop(robot_link, car_link, observer)
        loop.supervision = supervision
        Runner(AUTOLOCK, PARAMETERS, loop, progress, lambda _: None).run()
        return progress
    return run


def test_record_says_who_was_present_and_what_was_confirmed(real_robot, presence):
    progress = real_robot(Supervision(presence, confirmed=ALL))
    assert progress.session[SUPERVISION] == "person present, asked every 15 min"
    assert progress.session[CONDITIONS_CONFIRMED] == "area, people, ground, weather, light, car, attendance"
    assert len(progress.results) == 8


def test_rated_stop_takes_the_place_of_a_person_and_is_in_the_record(real_robot):
    progress = real_robot(Supervision(unattended_stop="fence monitor, PL d"))
    assert progress.session[SUPERVISION] == "unattended, stop: fence monitor, PL d"
    assert CONDITIONS_CONFIRMED not in progress.session


def test_nothing_moves_before_the_person_has_answered(real_robot, robot_link, presence, clock, world):
    presence.ask()
    step = world.step

    def slow():
        step()
        clock.now_s += 5.0
    world.step = slow
    with pytest.raises(OperatorAbsent, match="^Nobody confirmed within 60 s"):
        real_robot(Supervision(presence, confirmed=ALL))
    assert all(desired.stop or not (desired.waypoint or desired.key_height_m) for _, desired in robot_link.answers)


def test_person_who_has_gone_during_a_test_stops_it_and_the_lines_are_kept(real_robot, robot_link, presence, clock,
                                                                          world):
    step = world.step

    def aging():
        step()
        clock.now_s += 8.0
    world.step = aging
    with pytest.raises(OperatorAbsent):
        real_robot(Supervision(presence, confirmed=ALL))
    # Halting takes some Statuses.
    assert clock.now_s - NOW_S == pytest.approx(960.0, abs=100.0)
    assert real_robot.progress.results
    assert robot_link.answers[-1][1].stop and world.speed_mps == 0.0
    assert real_robot.progress.session["ended before its end"].startswith("Nobody confirmed")


def test_simulated_robot_needs_none_of_this(run_scenario, world):
    assert len(run_scenario(AUTOLOCK, PARAMETERS)) == 8
    assert SUPERVISION not in run_scenario.progress.session


REAL = RobotStatus(1, 1, 5.0, sent_s=1.7e9, steady_s=STEADY_S)
SIMULATED = replace(REAL, sent_s=STEADY_S)
BAD = (PreflightItem("disk", True, "Full."),)


@pytest.mark.parametrize("report, words", [
    (None, "does not report its preflight"), (PreflightReport(), "before a preflight in motion, since its start"),
    (replace(FINE, motion_made_s=math.nan), "the last one was made at rest"),
    # Of another run of the clock.
    (replace(FINE, made_s=STEADY_S + 10.0), "before a preflight in motion, since its start"),
    (replace(FINE, motion_made_s=STEADY_S + 10.0), "the last one was made at rest"),
    (replace(FINE, made_s=STEADY_S - PREFLIGHT_VALID_S - 1.0), "was made 12 h 0 min ago; allowed are 12 h 0 min"),
    (replace(FINE, motion_made_s=STEADY_S - PREFLIGHT_VALID_S - 60.0), "was made 12 h 1 min ago"),
    (replace(FINE, bad=1, items=BAD), "preflight found: disk: Full. Mend it")])
def test_preflight_that_is_missing_old_or_bad_hinders_a_test_on_a_real_robot(report, words):
    assert words in preflight_hindrance(report, REAL) and "preflight" in preflight_hindrance(report, REAL)
    is_bad = report is not None and report.bad > 0
    assert bool(preflight_hindrance(report, SIMULATED)) is is_bad


@pytest.mark.parametrize("report", [
    FINE, replace(FINE, made_s=STEADY_S - PREFLIGHT_VALID_S), replace(FINE, motion_made_s=STEADY_S - 40_000.0),
    # A Status is stamped before what it says is known.
    replace(FINE, made_s=STEADY_S + 0.5)])
def test_preflight_in_motion_of_the_day_admits_a_test(report):
    assert preflight_hindrance(report, REAL) == ""


def test_clock_without_a_number_admits_no_test():
    assert preflight_hindrance(FINE, replace(REAL, steady_s=math.nan))


def test_no_test_begins_on_a_real_robot_without_a_preflight_in_motion(real_robot, robot_link, presence):
    with pytest.raises(RobotFailed, match="the last one was made at rest"):
        real_robot(Supervision(presence, confirmed=ALL), report=replace(FINE, motion_made_s=math.nan))
    assert not any(desired.waypoint or desired.key_height_m for _, desired in robot_link.answers)


@pytest.mark.parametrize("name, words", [
    ("key_press", "horn"), ("zone_map", "alarm"), ("handle_request", "alarm"), ("sleep_time", "alarm"),
    ("relay_resistance", "alarm"), ("autolock", "horn")])
def test_scenarios_that_press_or_pull_are_announced(name, words):
    assert words in SCENARIOS[name].announcement and "ear protection" in SCENARIOS[name].announcement
    said = []
    PresenceQuestion(said.append, Enter(io.StringIO()), SCENARIOS[name].announcement).presence.ask()
    assert SCENARIOS[name].announcement in said[0] and all(name in said[0] for name in CONDITIONS)


def test_operating_conditions_are_those_of_the_hazard_file():
    hazards = pathlib.Path(__file__).parents[3] / "docs" / "safety" / "hazards.yaml"
    assert list(yaml.safe_load(hazards.read_text(encoding="utf-8"))["odd"]) == list(CONDITIONS)


class Keyboard:
    """Enter of the command line, pressed by the test."""

    def __init__(self):
        self.asked = []

    def ask(self, answered):
        self.asked.append(answered)

    def withdraw(self, answered):
        self.asked = [each for each in self.asked if each != answered]


def test_command_line_asks_for_the_conditions_first_and_for_presence_later(clock):
    said, keyboard = [], Keyboard()
    question = PresenceQuestion(said.append, keyboard)
    question.presence._clock = clock
    question.presence.ask()
    assert said[0].startswith("Confirm by Enter within 60 s") and "attendance: one trained person" in said[0]
    keyboard.asked[0]()
    assert question.presence.look() == "" and not question.presence.is_asked and keyboard.asked == []
    clock.now_s += 900.0
    assert question.presence.look() == "" and question.presence.is_asked
    assert said[1] == "Press Enter within 60 s to confirm that you are in sight of the robot; else it stops."


@pytest.mark.parametrize("stop", ["", "fence monitor, PL d"])
def test_command_line_asks_unless_a_rated_stop_is_declared(stop):
    run, said = object.__new__(CommandLineRun), []
    run._scenario = AUTOLOCK
    run._identity = types.SimpleNamespace(unattended_stop=laboratory_from({"unattended_stop": stop}).unattended_stop)
    supervision = run._supervision(types.SimpleNamespace(say=said.append), Keyboard(), REAL)
    assert supervision.is_unattended is bool(stop) and bool(said) is not bool(stop)
    assert supervision.missing(IN_CHARGE) == ""
    assert run._supervision(types.SimpleNamespace(say=said.append), Keyboard(), SIMULATED).presence is None


@pytest.mark.parametrize("wrong", [7, "two\nlines", ["fence"]])
def test_rated_stop_that_is_no_text_is_refused(wrong):
    with pytest.raises(InvalidIdentity, match="^unattended_stop"):
        laboratory_from({"unattended_stop": wrong})
