"""Rows of the benchmarks of the simulation's speed and of the serial line."""
# SPDX-License-Identifier: Apache-2.0
import pytest

from mtr_benchmarks.harness.rows import all_met
from mtr_benchmarks.serial import __main__ as serial
from mtr_benchmarks.serial.echo import COMMANDS, figures_of
from mtr_benchmarks.simulation import __main__ as simulation
from mtr_benchmarks.simulation import whole_stack
from mtr_benchmarks.simulation.physics import PhysicsFigures
from mtr_benchmarks.simulation.whole_stack import WholeStackFigures
from mtr_simulation.demo import DemoError
from mtr_simulation.stack import StackError

PHYSICS = PhysicsFigures(real_time_factor=25.0, tick_median_ms=0.7, tick_p99_ms=2.0)


@pytest.mark.parametrize(("stack", "met"), [
    (WholeStackFigures(7.0, 700.0, 100.0), True), (WholeStackFigures(6.9, 690.0, 100.0), False),
    (WholeStackFigures(9.0, 900.0, 100.0, ("autolock: 3 lines instead of at least 16",)), False),
    (WholeStackFigures(None, problems=("The simulated robot ended while starting.",)), False)])
def test_whole_stack_is_met_when_it_is_fast_enough_and_right(stack, met):
    found = simulation.report(PHYSICS, stack)
    assert all_met(found.rows) is met
    assert found.remarks == list(stack.problems)


def test_figures_of_the_simulation_keep_their_names():
    written = simulation.report(PHYSICS, WholeStackFigures(8.0, 800.0, 100.0)).document()
    assert written["real_time_factor"] == 25.0 and written["tick_p99_ms"] == 2.0
    assert written["whole_stack"]["real_time_factor"] == 8.0


@pytest.mark.parametrize(("trips_ms", "met"), [
    ([5.5] * COMMANDS, True), ([6.1] * COMMANDS, False), ([5.5] * (COMMANDS - 1), False), ([], False)])
def test_line_is_met_when_every_command_is_echoed_in_time(trips_ms, met):
    assert all_met(serial.report(figures_of(trips_ms, 57600)).rows) is met


def test_figures_of_the_line_keep_their_names():
    written = serial.report(figures_of([5.0] * COMMANDS, 57600)).document()
    assert list(written) == ["commands", "echoes", "baud", "echo_p50_ms", "echo_p95_ms", "echo_max_ms", "table"]


@pytest.mark.parametrize("error", [StackError("It ended while starting."), DemoError("A scenario failed.")])
def test_demo_that_fails_is_a_problem_and_no_traceback(tmp_path, monkeypatch, error):
    def fails(options):
        raise error

    monkeypatch.setattr(whole_stack, "run_demo", fails)
    found = whole_stack.measure_whole_stack(tmp_path)
    assert found.real_time_factor is None and found.problems == (str(error),)
