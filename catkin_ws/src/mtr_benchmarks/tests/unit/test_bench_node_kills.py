"""Findings about a test with lost, duplicate or changed lines, and about a robot that drove on for too long."""
# SPDX-License-Identifier: Apache-2.0
import json
import random
import shutil
import subprocess
import sys
from dataclasses import replace
from types import SimpleNamespace

import pytest
from nav_msgs.msg import Odometry

from mtr_benchmarks.kills import __main__ as kills_main
from mtr_benchmarks.kills import kept as kept_module
from mtr_benchmarks.kills.deaths import LIMITS_S, first_zero_s, kill_of, silence
from mtr_benchmarks.kills.kept import CHANGED, DOUBLED, LOST, UNKEPT, UNREADABLE, Kept, wrong_distances
from mtr_benchmarks.kills.killed import Found
from mtr_benchmarks.kills.robot import KilledRobot
from mtr_msgs.msg import DriveStatus
from mtr_operator.storage.journal.journal_file import journal_path
from mtr_operator.storage.progress_file import load_progress

PARAMETERS = {"measurements_distance_m": 10.0, "minimum_distance_m": 0.5, "passes": 1}


@pytest.fixture(scope="module")
def measured(tmp_path_factory):
    """Return the folder of a completed test with the simulated robot and Car of the application."""
    folder = tmp_path_factory.mktemp("measured")
    parameters = folder / "parameters.json"
    parameters.write_text(json.dumps(PARAMETERS), encoding="utf-8")
    done = subprocess.run([sys.executable, "-m", "mtr_operator", "run", "autolock", "--params", parameters, "--out",
                           folder / "out", "--simulated-robot", "--simulated-car"], capture_output=True, check=False)
    assert done.returncode == 0, done.stderr
    return folder / "out"


@pytest.fixture
def kept(measured, tmp_path):
    """Return a copy of the test after its first inspection."""
    shutil.copytree(measured, tmp_path / "out")
    found = Kept(tmp_path / "out", "autolock", PARAMETERS)
    found.look()
    return found


def read_otherwise(monkeypatch, edit):
    """Edit the results when the files are read from now on."""
    def load(*arguments):
        progress = load_progress(*arguments)
        return SimpleNamespace(results=edit(list(progress.results)), measured_car=progress.measured_car,
                               measured=lambda: [result.number for result in edit(list(progress.results))])
    monkeypatch.setattr(kept_module, "load_progress", load)


def test_nothing_is_found_of_a_test_that_was_left_alone(kept):
    kept.look_at_end()
    assert not sum(kept.found.values())


def test_line_that_is_gone_is_lost(kept, monkeypatch):
    read_otherwise(monkeypatch, lambda results: results[1:])
    kept.look()
    assert kept.found[LOST] == 1 and sum(kept.found.values()) == 1


def test_line_that_was_never_measured_is_lost_at_the_end(kept, monkeypatch):
    kept._good = {}
    read_otherwise(monkeypatch, lambda results: results[1:])
    kept.look_at_end()
    assert kept.found[LOST] == 1


def test_line_that_is_there_twice_is_doubled(kept, monkeypatch):
    read_otherwise(monkeypatch, lambda results: [results[0], *results])
    kept.look()
    assert kept.found[DOUBLED] == 1


def test_distance_that_was_not_measured_is_found(kept, monkeypatch):
    def edit(results):
        return [replace(results[0], unlock_distance_m=1.2345), *results[1:]]
    read_otherwise(monkeypatch, edit)
    kept.look_at_end()
    assert kept.found[CHANGED] == 1 and kept.found[UNKEPT] == 1


def test_journal_that_is_no_longer_what_it_was_is_changed(kept):
    path = journal_path(kept.path)
    path.write_bytes(path.read_bytes()[:-200])
    kept.look()
    assert kept.found[CHANGED] == 1 and not kept.found[DOUBLED]


def test_file_that_cannot_be_read_is_found(kept):
    journal_path(kept.path).unlink()
    kept.path.write_text("{", encoding="utf-8")
    kept.look()
    assert kept.found[UNREADABLE] == 1


def comparison(error_m, sigma_m=0.01, status="ok"):
    return SimpleNamespace(error_m=error_m, measured=SimpleNamespace(status=status, uncertainty_m=sigma_m))


@pytest.mark.parametrize("line, is_wrong", [
    (comparison(0.04), False), (comparison(-0.06), True), (comparison(0.06, 0.03), False),
    (comparison(float("nan")), True), (comparison(float("nan"), status="not_reached"), False)])
def test_distance_is_wrong_beyond_its_uncertainty_and_without_a_true_event(line, is_wrong):
    assert wrong_distances([line]) == is_wrong


def test_zero_counts_from_when_nothing_else_is_sent_any_more():
    sent = [(0.0, 0.5), (0.1, 0.0), (0.2, 0.1), (0.3, 0.0), (0.4, 0.0), (0.5, 0.3)]
    assert first_zero_s(sent, 0.0, 0.4) == 0.3 and first_zero_s(sent, 0.0, 0.5) is None


def speeds(stop_s, until_s=10.0):
    """Return the speeds of a robot that drives at 0.5 m/s until a time and then stops."""
    return [(0.04 * index, 0.5 if 0.04 * index < stop_s else 0.0) for index in range(int(until_s / 0.04))]


@pytest.mark.parametrize("node, stop_s, back_s, is_judged, stopped_in_time", [
    ("dispatcher", 5.45, 8.0, True, True),
    ("dispatcher", 5.6, 8.0, True, False),
    ("peripherals", 5.9, 8.0, True, True),
    ("peripherals", 6.1, 8.0, True, False),
    ("state_machine", 99.0, 8.0, True, False),
    # The node is back before the robot had to stop; the node does not return.
    ("motion_planner", 99.0, 5.3, False, True),
    ("motion_planner", 99.0, None, True, False),
    # The robot was stopped before.
    ("state_machine", 3.0, 8.0, False, True)])
def test_zero_is_sent_in_time_after_a_death_unless_the_node_is_back(node, stop_s, back_s, is_judged, stopped_in_time):
    kill = kill_of(node, speeds(stop_s), speeds(stop_s + 0.1), 5.0, back_s)
    assert (kill.is_judged, kill.stopped_in_time) == (is_judged, stopped_in_time)


def test_death_is_the_longest_silence_of_a_node_whenever_its_words_arrive():
    assert silence([1.0, 1.1, 1.2, 4.0, 4.1]) == (1.2, 4.0)


def test_too_few_kills_are_not_what_it_must_be():
    found = Found("autolock", [kill_of("dispatcher", speeds(5.4), speeds(5.5), 5.0, 8.0)])
    assert all(row.is_met for row in kills_main.report([found], 1).rows)
    assert not any(row.is_met for row in kills_main.report([found], 2).rows if row.requirement.must is not None)


def test_kills_of_robots_that_stood_prove_no_stop():
    stood = Found("autolock", [kill_of("dispatcher", speeds(3.0), speeds(3.1), 5.0, 8.0)] * 20)
    unmet = [row.requirement for row in kills_main.report([stood], 20).rows if not row.is_met]
    assert unmet == [kills_main.STOPPED, kills_main.STOOD]


def test_few_kills_of_a_robot_that_drove_are_too_few():
    kills = [kill_of("dispatcher", speeds(stop_s), speeds(stop_s + 0.1), 5.0, 8.0) for stop_s in (5.4, *[3.0] * 19)]
    unmet = [row.requirement for row in kills_main.report([Found("autolock", kills)], 20).rows if not row.is_met]
    assert unmet == [kills_main.STOPPED, kills_main.STOOD]


@pytest.mark.parametrize("wheels_stop_s, is_met", [(5.6, True), (5.8, False), (99.0, False)])
def test_wheels_stand_soon_after_the_zero(wheels_stop_s, is_met):
    found = Found("autolock", [kill_of("dispatcher", speeds(5.4), speeds(wheels_stop_s), 5.0, 8.0)])
    assert {row.requirement: row.is_met for row in kills_main.report([found], 1).rows}[kills_main.STOOD] == is_met


@pytest.mark.parametrize("until_s, is_judged, shows_standstill", [
    (5.5, False, False), (5.6, True, False), (5.72, True, False), (5.8, True, True)])
def test_record_that_ends_with_the_test_proves_what_it_shows(until_s, is_judged, shows_standstill):
    kill = kill_of("dispatcher", speeds(99.0, until_s), speeds(99.0, until_s), 5.0, None)
    assert (kill.is_judged, kill.stopped_in_time, kill.shows_standstill) == (is_judged, not is_judged, shows_standstill)


def test_standstill_is_not_judged_by_a_record_that_ends_before_it():
    ended = kill_of("dispatcher", speeds(5.44, 5.64), speeds(99.0, 5.64), 5.0, None)
    whole = kill_of("dispatcher", speeds(5.4), speeds(5.5), 5.0, 8.0)
    rows = {row.requirement: row for row in kills_main.report([Found("autolock", [ended, whole])], 2).rows}
    assert rows[kills_main.STOOD].is_met and rows[kills_main.STOPPED].value == pytest.approx(0.44)


def test_robot_that_turns_has_not_stopped():
    robot = SimpleNamespace(_sent=[], _wheels=[])
    KilledRobot._take_sent(robot, DriveStatus(angular_radps=0.8))
    turning = Odometry()
    turning.twist.twist.angular.z = 0.8
    KilledRobot._take_wheels(robot, turning)
    assert robot._sent[0].mps > 0.2 and robot._wheels[0].mps > 0.2


@pytest.mark.parametrize("comes_again, goes_on, is_back", [
    # Without an application simulated time stops, and a restarted node publishes nothing.
    (True, False, True), (True, True, False), (False, True, False), (False, False, False)])
def test_silent_node_is_back_when_it_was_started_and_the_test_came_to_its_end(
        monkeypatch, comes_again, goes_on, is_back):
    monkeypatch.setattr("mtr_benchmarks.kills.robot.BACK_LIMIT_S", 0.05)
    monkeypatch.setattr("mtr_benchmarks.kills.robot.os.kill", lambda *_: None)
    words = {node: [4.9, 5.0] for node in LIMITS_S}
    processes = iter([7] + [8 if comes_again else None] * 1000)
    robot = SimpleNamespace(_process_of=lambda _: next(processes), _waited=KilledRobot._waited, _sent=speeds(5.4),
                            _wheels=speeds(5.5), _words_s=words)
    kill = KilledRobot.kill_one(robot, random.Random(1), lambda: goes_on)
    assert (kill.back_s, kill.is_back) == (None, is_back)


def test_lost_line_is_not_what_it_must_be():
    found = Found("autolock", [kill_of("dispatcher", speeds(5.4), speeds(5.5), 5.0, 8.0)])
    found.found[LOST] += 1
    assert [row.requirement.name for row in kills_main.report([found], 1).rows if not row.is_met] == [LOST]
