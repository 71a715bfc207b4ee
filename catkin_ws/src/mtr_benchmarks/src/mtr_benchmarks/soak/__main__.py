"""Runs the simulated robot for hours of its time with random faults; figures go to soak.json.

The resources of each process are written to soak/samples.csv while they are sampled.

Usage: python -m mtr_benchmarks.soak --hours 8 --out out/bench
"""
# SPDX-License-Identifier: Apache-2.0
import argparse
import pathlib
import sys
import time
from dataclasses import asdict
from typing import Any, Dict, List, Optional

from ..faults.matrix import LOCKSTEP
from ..faults.robot import FaultyRobot
from ..faults.robots import ROBOTS
from ..harness.own_process import end_in_order
from ..harness.report import BenchmarkReport, finish
from ..harness.rows import Requirement, Row
from .figures import QUANTITIES, Samples, by_halves, mean, trends_of, unseen
from .trend import HOUR_S, difference, growing
from .wandering import Processes, Wanderer

GROWING = "processes whose {} grow (95 % for all together)"
UNSEEN = Requirement("processes that were not seen from the beginning to the end", "(count)", must=0.0)
FAILED = Requirement("times that the robot did not come back from a fault", "(count)", must=0.0)
WORSE = Requirement("position error at the end beyond that at the beginning and its 95 % interval", "m", must=0.0)


def main(arguments: Optional[List[str]] = None) -> int:
    """Run; return 0 if every row meets its requirement."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--out", type=pathlib.Path, default=pathlib.Path("out/bench"), help="folder of the figures")
    parser.add_argument("--hours", type=float, default=1.0, help="of the robot's time, default %(default)s")
    parser.add_argument("--seed", type=int, default=1, help="of the simulation, the ways and the faults")
    options = parser.parse_args(arguments)
    end_in_order()
    begun_s = time.monotonic()
    with FaultyRobot(options.out / "soak", ROBOTS[LOCKSTEP], options.seed) as robot:
        processes = Processes(robot, robot.process, options.out / "soak" / "samples.csv")
        wanderer = Wanderer(robot, options.seed)
        processes.start()
        try:
            is_whole = wanderer.go(options.hours * HOUR_S)
        finally:
            processes.end()
        hours = robot.now_s / HOUR_S
    print(f"{hours:.2f} h of robot time in {(time.monotonic() - begun_s) / 60.0:.0f} min, "
          f"{sum(wanderer.faults.values())} faults, {len(wanderer.places)} places")
    return finish(report(processes.samples, wanderer, hours, is_whole), options.out / "soak.json")


def report(samples: Samples, wanderer: Wanderer, hours: float, is_whole: bool) -> BenchmarkReport:
    """Return figures and table."""
    trends = {quantity: trends_of(samples, quantity) for quantity in QUANTITIES}
    before, after = by_halves(wanderer.places)
    worse_m, half_width_m = difference(before, after)
    missing = unseen(samples, hours * HOUR_S)
    rows = [Row(FAILED, len(wanderer.failures), is_whole,
                remark=f"{hours:.2f} h, {sum(wanderer.faults.values())} faults"),
            Row(UNSEEN, len(missing), is_whole, remark=", ".join(missing))]
    # A process without samples is not evidence of constant resources.
    is_seen = is_whole and not missing
    rows += [Row(Requirement(GROWING.format(quantity), "(count)", must=0.0), growing(list(found.values())), is_seen,
                 remark=f"sum {sum(each.per_hour for each in found.values()):+.3g} an hour")
             for quantity, found in trends.items()]
    rows.append(Row(WORSE, max(worse_m - half_width_m, 0.0), is_whole and len(before) > 1,
                    remark=f"{1e3 * worse_m:+.1f} mm, 95 % +-{1e3 * half_width_m:.1f}, "
                           f"{len(before)} and {len(after)} maps"))
    figures: Dict[str, Any] = {
        "hours": hours, "faults": wanderer.faults, "failures": wanderer.failures,
        "position_error_m": {"begin": mean(before), "end": mean(after)},
        "slopes_per_hour": {quantity: {name: asdict(each) for name, each in found.items()}
                            for quantity, found in trends.items()},
        "means": {quantity: {name: mean([value(usage) for _, usage in each]) for name, each in samples.items()}
                  for quantity, value in QUANTITIES.items()}}
    return BenchmarkReport(rows, figures, wanderer.failures)


if __name__ == "__main__":
    sys.exit(main())
