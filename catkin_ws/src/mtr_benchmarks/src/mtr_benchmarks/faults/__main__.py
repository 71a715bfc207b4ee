"""Runs the matrix of states and faults on the simulated robot; figures go to faults.json.

Usage: python -m mtr_benchmarks.faults --out out/bench
       python -m mtr_benchmarks.faults --table     the rows for docs/fault-matrix.md
"""
# SPDX-License-Identifier: Apache-2.0
import argparse
import pathlib
import sys
from dataclasses import asdict
from typing import Callable, Dict, List, Optional

from ..harness.own_process import end_in_order, in_own_process
from ..harness.report import BenchmarkReport, finish
from ..harness.rows import Requirement, Row
from .campaign import Found, one_robot
from .judge import Outcome, first_told_s
from .matrix import DRIVING, MAPPING, Cell, Expected, read_matrix, table
from .record import Run, present_commit, right_of
from .robots import ROBOTS

FAILED = Requirement("cells of the matrix that do something else than it says", "(count)", must=0.0)
# Times count from the fault, or from the duration below which it is tolerated (limit_s).
STANDSTILL = Requirement("longest time from a fault to standstill, where the robot drove and must stand", "s", must=0.5)
NOTICE = Requirement("longest time from a fault to the Operator's sentence, where there must be one", "s", must=1.0)


def main(arguments: Optional[List[str]] = None) -> int:
    """Run all cells; return 0 if every cell behaved as the matrix specifies."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--out", type=pathlib.Path, default=pathlib.Path("out/bench"), help="folder of the figures")
    parser.add_argument("--short", action="store_true", help="only the cells that are part of `make test`")
    parser.add_argument("--only", default="", metavar="PATTERN", help="cells whose name has it, e.g. 'imu .* driving'")
    parser.add_argument("--robots", nargs="*", default=list(ROBOTS), choices=list(ROBOTS), help="only cells of these")
    parser.add_argument("--left", action="store_true", help="only cells that are not kept as right of this commit")
    parser.add_argument("--table", action="store_true", help="only print the table of docs/fault-matrix.md")
    parser.add_argument("--seed", type=int, default=1, help="of the simulation")
    options = parser.parse_args(arguments)
    end_in_order()
    matrix = read_matrix()
    if options.table:
        print("\n".join(table(matrix)))
        return 0
    of_run = Run(options.out, options.seed, present_commit())
    right = right_of(options.out, of_run.commit) if options.left else frozenset()
    courses = [[cell for cell in course if cell.name not in right] for course in
               matrix.courses(options.short, options.only) if course[0].robot in options.robots]
    return finish(report(run(courses, of_run)), options.out / "faults.json")


def run(courses: List[List[Cell]], of_run: Run) -> List[Found]:
    """Run all cells and return their results; each course is run on robots of one kind."""
    found: List[Found] = []
    for course in courses:
        wanted = len(found) + len(course)
        while len(found) < wanted:
            left = course[len(found) - wanted:]
            # One folder per first cell, so that the log of a failed robot is not overwritten.
            folder = of_run.folder / "faults" / left[0].name.replace(" ", "_")
            # A process can be only one node of one ROS graph.
            found += in_own_process(one_robot, left, folder, of_run)
    return found


def report(found: List[Found]) -> BenchmarkReport:
    """Return figures and table."""
    failed = [each for each in found if each.wrong]
    stop = [each for each in found if each.cell.state in (MAPPING, DRIVING) and each.cell.expected.stands_s is not None]
    tell = [each for each in found if each.cell.expected.told]
    # A run without cells proves nothing. Rows of times exist only if a cell requires a standstill or a message.
    rows = [Row(FAILED, len(failed), bool(found), remark=f"{len(found)} cells"),
            *([_longest(STANDSTILL, stop, lambda must, seen: seen.stood_s)] if stop else []),
            *([_longest(NOTICE, tell, first_told_s)] if tell else [])]
    return BenchmarkReport(rows, {"cells": [_figures(each) for each in found]},
                           [f"{each.cell.name}: {'; '.join(each.wrong)}" for each in failed])


def _longest(requirement: Requirement, cells: List[Found],
             time_s: Callable[[Expected, Outcome], Optional[float]]) -> Row:
    """Return the longest time beyond the limit; the row is incomplete if a cell failed and has no time."""
    times = [(time_s(each.cell.expected, each.outcome) if each.outcome else None, each.cell.expected.limit_s)
             for each in cells]
    known = [found_s - limit_s for found_s, limit_s in times if found_s is not None]
    return Row(requirement, max(known, default=None), len(known) == len(cells), remark=f"{len(cells)} cells")


def _figures(found: Found) -> Dict[str, object]:
    return {"cell": found.cell.name, "wrong": found.wrong,
            "seen": None if found.outcome is None else asdict(found.outcome)}


if __name__ == "__main__":
    sys.exit(main())
