"""Stops nodes and sets the clock of the simulated robot while it drives; figures go to liveness.json.

Usage: python -m mtr_benchmarks.liveness --out out/bench
"""
# SPDX-License-Identifier: Apache-2.0
import argparse
import pathlib
import sys
from dataclasses import asdict
from typing import List, Optional

from mtr_fault_injection.set_clock import SettableClock

from ..harness.report import BenchmarkReport, finish
from . import clock_steps, stalls
from .live_robot import MACHINE_CLOCK, SIMULATED_CLOCK, LiveRobot

SHORT_STALLS_S = (1.0,)
SHORT_STEPS_S = (0.4, -0.4, 3600.0, -3600.0)


def main(arguments: Optional[List[str]] = None) -> int:
    """Measure; return 0 if every row meets its requirement."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--out", type=pathlib.Path, default=pathlib.Path("out/bench"), help="folder of the figures")
    parser.add_argument("--short", action="store_true", help="one stop of each node and four steps of the clock")
    parser.add_argument("--nodes", nargs="*", default=stalls.NODES, help="nodes to stop")
    parser.add_argument("--steps", nargs="*", type=float, help="steps of the clock, s")
    parser.add_argument("--simulated-clock", action="store_true",
                        help="time is the simulator's, which waits for nobody; it cannot be set")
    options = parser.parse_args(arguments)
    if options.simulated_clock and options.steps != []:
        parser.error("The simulated clock cannot be set; add --steps without steps.")
    durations_s = SHORT_STALLS_S if options.short else stalls.DURATIONS_S
    steps_s = options.steps if options.steps is not None else SHORT_STEPS_S if options.short else clock_steps.STEPS_S
    if not options.nodes and not steps_s:
        parser.error("There is nothing to measure; give a node to stop or a step of the clock.")
    folder = options.out / "liveness"
    clock = SettableClock(folder)
    with LiveRobot(folder, clock.variables, SIMULATED_CLOCK if options.simulated_clock else MACHINE_CLOCK) as robot:
        robot.start()
        stopped = stalls.stalls(robot, durations_s, options.nodes)
        stepped = clock_steps.clock_steps(robot, clock, steps_s)
    rows = [*(stalls.rows(stopped) if stopped else []), *(clock_steps.rows(stepped) if stepped else [])]
    remarks = [*map(_stall_line, stopped), *map(_step_line, stepped)]
    figures = {"stalls": [asdict(each) for each in stopped], "clock_steps": [asdict(each) for each in stepped]}
    return finish(BenchmarkReport(rows, figures, remarks), options.out / "liveness.json")


def _stall_line(found: stalls.Stall) -> str:
    return (f"{found.node} stopped for {found.duration_s:g} s at {found.speed_mps:.2f} m/s: surge "
            f"{found.commands.linear_mps:.3f} m/s and {found.commands.angular_radps:.3f} rad/s, wheels "
            f"{found.wheels.linear_mps:.3f} m/s; drives again after {found.recovered_s:.1f} s")


def _step_line(found: clock_steps.ClockStep) -> str:
    said = "; ".join(found.alarms) or "no alarm"
    return (f"clock set by {found.step_s:+g} s at {found.speed_mps:.2f} m/s: {said}; {found.status_pause_s:.2f} s "
            f"without a Status; counted {found.counted} times")


if __name__ == "__main__":
    sys.exit(main())
