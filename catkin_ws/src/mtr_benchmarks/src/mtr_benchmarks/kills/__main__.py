"""Kills nodes of the robot at random instants of complete tests; figures go to node_kills.json.

Usage: python -m mtr_benchmarks.kills --kills 20 --out out/bench
"""
# SPDX-License-Identifier: Apache-2.0
import argparse
import collections
import pathlib
import shutil
import sys
from typing import Counter, List, Optional

from ..harness.own_process import end_in_order, in_own_process
from ..harness.report import BenchmarkReport, finish
from ..harness.rows import Requirement, Row
from .deaths import AFTER_ZERO_S, LIMITS_S, STANDS_S, Kill
from .kept import MUST
from .killed import PARAMETERS, Found, killed_test

# Kills in one test, which continues after each.
KILLS_OF_TEST = 10
STOPPED = Requirement("longest time from a node's last word, or the limit of its silence, to zero sent to the wheels",
                      "s", must=STANDS_S)
STOOD = Requirement("the same to standstill of the simulated wheels (0.02 m/s)", "s", goal=STANDS_S,
                    must=STANDS_S + AFTER_ZERO_S)
# Least share of the kills that must hit a driving robot; measured: more than half.
MIN_JUDGED_SHARE = 0.25


def main(arguments: Optional[List[str]] = None) -> int:
    """Run tests of both scenarios until enough nodes were killed; return 0 if every row meets its requirement."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--out", type=pathlib.Path, default=pathlib.Path("out/bench"), help="folder of the figures")
    parser.add_argument("--kills", type=int, default=100, help="of each scenario, default %(default)s")
    parser.add_argument("--seed", type=int, default=1, help="of the instants and of the first robot")
    parser.add_argument("--scenarios", nargs="*", default=list(PARAMETERS), choices=list(PARAMETERS))
    options = parser.parse_args(arguments)
    end_in_order()
    folder = options.out / "node_kills"
    shutil.rmtree(folder, ignore_errors=True)
    tests: List[Found] = []
    for scenario in options.scenarios:
        done = 0
        while done < options.kills:
            # A process can be only one node of one ROS graph.
            tests.append(in_own_process(killed_test, scenario, folder / f"{scenario}_{done}",
                                        options.seed + len(tests), min(KILLS_OF_TEST, options.kills - done)))
            print(f"{scenario}: {line_of(tests[-1])}", flush=True)
            if not tests[-1].kills:
                # A test that ends before the first kill proves nothing; neither would the next one.
                break
            done += len(tests[-1].kills)
    return finish(report(tests, options.kills * len(options.scenarios)), options.out / "node_kills.json")


def line_of(test: Found) -> str:
    """Return a line about one test for a person."""
    found = {name: count for name, count in test.found.items() if count}
    return f"{len(test.kills)} kills; {test.starts} starts; {found or 'nothing lost, doubled or wrong'}"


def report(tests: List[Found], wanted: int) -> BenchmarkReport:
    """Return figures and table. wanted: number of kills."""
    kills: List[Kill] = [kill for test in tests for kill in test.kills]
    found: Counter[str] = sum((test.found for test in tests), collections.Counter())
    is_whole, judged = len(kills) >= wanted, [kill for kill in kills if kill.is_judged]
    rows = [Row(Requirement(name, "(count)", must=0.0), float(found[name]), is_whole,
                remark=f"{len(kills)} kills, {len(tests)} tests") for name in MUST]
    is_judged = is_whole and len(judged) >= MIN_JUDGED_SHARE * wanted
    shown = [kill for kill in judged if kill.shows_standstill]
    rows += [Row(requirement, _longest(found_s, name), is_judged, remark=f"{len(found_s)} kills of a robot that drove")
             for requirement, name, found_s in ((STOPPED, "stopped_s", judged), (STOOD, "stood_s", shown))]
    of_node = collections.Counter(kill.node for kill in kills)
    figures = {"kills": {node: of_node[node] for node in LIMITS_S},
               "tests": [{"scenario": test.scenario, "kills": [kill._asdict() for kill in test.kills],
                          "starts": test.starts, "found": dict(test.found)} for test in tests]}
    return BenchmarkReport(rows, figures, [])


def _longest(kills: List[Kill], name: str) -> Optional[float]:
    """Return the longest time beyond the limit; None if a time is missing, or without kills."""
    times_s = [(getattr(kill, name), LIMITS_S[kill.node]) for kill in kills]
    if any(time_s is None for time_s, _ in times_s):
        return None
    return max((time_s - limit_s for time_s, limit_s in times_s), default=None)


if __name__ == "__main__":
    sys.exit(main())
