"""Drives the robot toward a wall and a pole while a LiDAR fails; figures go to lidar_course.json.

Usage: python -m mtr_benchmarks.lidar_course --out out/bench
"""
# SPDX-License-Identifier: Apache-2.0
import argparse
import pathlib
import sys
from typing import List, Optional

from ..faults.robot import FaultyRobot
from ..faults.robots import RobotKind
from ..harness.own_process import end_in_order
from ..harness.report import BenchmarkReport, finish
from ..harness.rows import Requirement, Row
from .site import LEGS, write_site
from .trial import BEGINS_M, Driver, Outcome, Trial

# Kinds of fault and their amounts; degrees to both sides for a sector.
FAULTS = (("empty", 0.0), ("sector", 45.0), ("sector", 20.0), ("sector", 8.0), ("dark", 0.0), ("near", 0.0),
          ("stuck", 0.0), ("off", 0.0))
SHORT = tuple(Trial("front_lidar", kind, amount, obstacle, 0.8)
              for kind, amount, obstacle in (("sector", 45.0, "pole"), ("empty", 0.0, "wall")))

CONTACTS = Requirement("contacts with wall or pole while a LiDAR fails", "(count)", must=0.0)
CLEARANCE = Requirement("least distance from wall or pole", "m", goal=0.05, at_least=True)
MOVING = Requirement("robots still moving at the end, without narrow sectors", "(count)", must=0.0)
SILENT = Requirement("failures whose LiDAR or sector is not reported, without narrow sectors", "(count)",
                     must=0.0)


def trials() -> List[Trial]:
    """All trials, grouped by obstacle."""
    return [Trial("front_lidar", kind, amount, obstacle, begins_m)
            for obstacle in LEGS for kind, amount in FAULTS for begins_m in BEGINS_M]


def main(arguments: Optional[List[str]] = None) -> int:
    """Run all trials; return 0 if every requirement is met."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--out", type=pathlib.Path, default=pathlib.Path("out/bench"), help="folder of the figures")
    parser.add_argument("--short", action="store_true", help="only the trials that are part of `make test`")
    parser.add_argument("--only", default="", help="trials whose name contains this text")
    parser.add_argument("--seed", type=int, default=1, help="of the simulation")
    options = parser.parse_args(arguments)
    end_in_order()
    wanted = [each for each in (SHORT if options.short else trials()) if options.only in each.name]
    folder = options.out / "lidar_course"
    folder.mkdir(parents=True, exist_ok=True)
    site = folder.resolve() / "site.yaml"
    write_site(site)
    found: List[Outcome] = []
    with FaultyRobot(folder, RobotKind({"scenario": str(site)}), options.seed) as robot:
        driver = Driver(robot)
        driver.prepare()
        for trial in wanted:
            found.append(driver.run(trial))
            print(f"{trial.name}: {found[-1].clearance_m:.2f} m; {' '.join(found[-1].messages)}", flush=True)
    return finish(report(found, len(wanted)), options.out / "lidar_course.json")


def report(found: List[Outcome], wanted: int) -> BenchmarkReport:
    """Return figures and table."""
    is_complete = bool(wanted) and len(found) == wanted
    wide = [each for each in found if not each.trial.is_narrow]
    least_m = min((each.clearance_m for each in found), default=None)
    rows = [Row(CONTACTS, sum(each.clearance_m <= 0.0 for each in found), is_complete, remark=f"{len(found)} trials"),
            Row(CLEARANCE, least_m, is_complete),
            Row(MOVING, sum(not each.stood for each in wide), is_complete),
            Row(SILENT, sum(not each.names_lidar for each in wide), is_complete)]
    figures = [{"trial": each.trial.name, "clearance_m": each.clearance_m, "stood": each.stood,
                "messages": each.messages} for each in found]
    remarks = [f"{each.trial.name}: the Operator reads {each.messages}" for each in found if not each.names_lidar]
    return BenchmarkReport(rows, {"trials": figures}, remarks)


if __name__ == "__main__":
    sys.exit(main())
