"""Detection of surges in the benchmarks of stopped nodes and clock steps, and the settable clock."""
# SPDX-License-Identifier: Apache-2.0
import subprocess
import sys
import time
from types import SimpleNamespace

import pytest

from mtr_benchmarks.liveness import clock_steps
from mtr_benchmarks.liveness.judge import (
    Growth,
    Motion,
    between,
    excess_of_commands,
    excess_of_wheels,
    longest_pause_s,
)
from mtr_benchmarks.liveness.short_drive import Drive, reached, rows, way_m
from mtr_fault_injection.set_clock import SettableClock
from mtr_proto import robot_link_pb2 as link

GROWTH = Growth(1.0, 2.0)
TELL = "import time; print(time.time(), time.monotonic(), flush=True); input()\n" * 2


def commands(*speeds, begin_s=0.0):
    return [Motion(begin_s + 0.02 * index, speed, 0.0) for index, speed in enumerate(speeds)]


STANDING = [Motion(0.02 * index, 0.0, 0.0) for index in range(200)]


def test_node_that_goes_on_where_it_was_stopped_is_a_surge():  # A1
    told = [*commands(0.7, 0.7), *commands(0.7, 0.7, begin_s=1.0)]
    assert excess_of_commands(told, STANDING, GROWTH).linear_mps == pytest.approx(0.68)


def test_node_that_begins_from_what_the_wheels_do_is_none():
    told = [*commands(0.7, 0.7), *commands(0.02, 0.04, 0.06, begin_s=1.0)]
    assert excess_of_commands(told, STANDING, GROWTH).linear_mps == pytest.approx(0.0, abs=1e-9)


def test_braking_is_no_surge_and_a_change_of_direction_is():
    assert excess_of_commands(commands(0.7, 0.0), STANDING, GROWTH).linear_mps == 0.0
    assert excess_of_commands(commands(0.3, -0.3), STANDING, GROWTH).linear_mps == pytest.approx(0.28)


def test_two_commands_that_arrive_at_once_are_a_period_apart():
    told = [Motion(0.0, 0.1, 0.0), Motion(0.04, 0.12, 0.0), Motion(0.04, 0.14, 0.0)]
    assert excess_of_commands(told, STANDING, GROWTH).linear_mps == pytest.approx(0.0, abs=1e-9)


def test_surge_of_the_yaw_rate_alone_is_seen():
    told = [Motion(0.0, 0.0, 0.0), Motion(0.02, 0.0, 0.5)]
    assert excess_of_commands(told, STANDING, GROWTH).angular_radps == pytest.approx(0.46)


def test_step_of_the_wheels_counts_either_way():
    rolled = [Motion(0.0, 0.7, 0.0), Motion(0.02, 0.5, 0.0)]
    assert excess_of_wheels(rolled, GROWTH).linear_mps == pytest.approx(0.18)


def test_pause_counts_from_the_beginning_and_to_the_end():
    assert longest_pause_s([1.0, 1.1, 1.4], 0.5, 1.5) == pytest.approx(0.5)
    assert longest_pause_s([], 0.0, 2.0) == 2.0


def test_record_is_cut_by_time():
    assert between(commands(1, 2, 3), 0.02, 0.04) == [Motion(0.02, 2, 0.0)]


@pytest.mark.parametrize("step_s", [3600.0, -3600.0, 0.4])
def test_clock_is_set_for_a_process_that_runs_and_the_steady_one_is_not(tmp_path, step_s):
    clock = SettableClock(tmp_path)
    process = subprocess.Popen([sys.executable, "-c", TELL], env=clock.variables, stdin=subprocess.PIPE,
                               stdout=subprocess.PIPE, text=True)

    def told():
        return [float(word) for word in process.stdout.readline().split()]
    wall_s, steady_s = told()
    clock.set_by(step_s)
    process.stdin.write("\n")
    process.stdin.flush()
    later_wall_s, later_steady_s = told()
    process.communicate("\n")
    assert (later_wall_s - wall_s) - (later_steady_s - steady_s) == pytest.approx(step_s, abs=0.01)


class Driving:
    """Robot that drives on and counts the steps of its clock."""

    def __init__(self, counts_steps):
        self.wheels = [Motion(0.0, 0.5, 0.0)]
        self.status_times_s = []
        self.status = link.Status()
        self._counts_steps = counts_steps

    def wait_for_motion(self, _):
        pass

    def watch(self, _):
        now_s = time.monotonic()
        self.wheels.append(Motion(now_s, 0.5, 0.0))
        self.status_times_s.append(now_s)

    def set_by(self, _):
        self.status.interventions.clock_steps += self._counts_steps


@pytest.mark.parametrize("counts_steps, is_met", [(0, False), (1, True), (2, False)])
def test_clock_that_nobody_sets_is_not_what_it_must_be(monkeypatch, counts_steps, is_met):
    monkeypatch.setattr(clock_steps, "AlarmWatch", lambda: SimpleNamespace(take=tuple))
    robot = Driving(counts_steps)
    found = clock_steps.rows(clock_steps.clock_steps(robot, robot, (0.4, -3600.0)))
    assert {row.requirement: row.is_met for row in found}[clock_steps.NOT_COUNTED] == is_met


def test_a_place_counts_once_and_only_when_it_is_reached():
    places = set()
    for number, result in ((1, link.WAYPOINT_RESULT_REFUSED), (2, link.WAYPOINT_RESULT_REACHED),
                           (2, link.WAYPOINT_RESULT_REACHED), (3, link.WAYPOINT_RESULT_UNSPECIFIED)):
        reached(places, link.Status(waypoint_id=number, waypoint_result=result))
    assert places == {2}


def test_the_way_is_the_same_forwards_and_backwards_and_nothing_over_a_pause():
    assert way_m([Motion(0.0, 0.5, 0.0), Motion(0.2, -0.5, 0.0), Motion(0.4, 0.5, 0.0)]) == pytest.approx(0.2)
    assert way_m([Motion(0.0, 0.5, 0.0), Motion(60.0, 0.5, 0.0)]) == 0.0


def test_a_short_drive_that_reached_too_little_is_not_met():
    assert all(row.is_met for row in rows(Drive(30.0, 4, 30.0, ["localization: lost"])))
    assert [row.requirement.name for row in rows(Drive(30.0, 3, 1.0, [])) if not row.is_met] == [
        "places reached", "way of the wheels"]
