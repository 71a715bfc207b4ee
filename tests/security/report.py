"""Each attack on the running simulated robot by itself, and all at once; figures go to red_team.json.

Usage: report.py [--out FOLDER] [--commands N] [--idle S]
"""
# SPDX-License-Identifier: Apache-2.0
import argparse
import pathlib
import sys
from typing import Any, Dict, List

from attacks import INSIDERS, STRANGERS
from figures import percentile
from robot_under_attack import Outcome, RobotUnderAttack

from mtr_benchmarks.harness.report import BenchmarkReport, finish
from mtr_benchmarks.harness.rows import Requirement, Row

MOTIONS = Requirement("words to wheels and buttons that are not zero", "(count)", must=0.0)
TWICE = Requirement("attacks of which a Status tells twice", "(count)", must=0.0)
IDLE_ATTACKS = Requirement("attacks that have tried nothing", "(count)", must=0.0)
MAX_RATIO = 2.0
GROUPS = {"all strangers": STRANGERS, "all insiders": INSIDERS}


def main() -> int:
    """Command line."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("--out", type=pathlib.Path, default=pathlib.Path("out/bench"), help="default %(default)s")
    parser.add_argument("--commands", type=int, default=500, help="of the Operator in each attack; default %(default)s")
    parser.add_argument("--idle", type=float, default=10.0, help="s without an Operator in each; default %(default)s")
    options = parser.parse_args()
    single = {each.__name__: (each,) for each in (*STRANGERS, *INSIDERS)}
    folder = options.out / "red_team"
    folder.mkdir(parents=True, exist_ok=True)
    found: Dict[str, Outcome] = {}
    quiet: List[float] = []
    with RobotUnderAttack(folder) as robot:
        for name, attacks in {**single, **GROUPS}.items():
            # Between the attacks, so that what else the machine does falls on both.
            quiet += robot.quiet_delays_s(options.commands)
            found[name] = robot.attacked([each.__name__ for each in attacks], options.idle, options.commands)
            print(f"{name}: {found[name].tries}", flush=True)
    return finish(report(found, quiet), options.out / "red_team.json")


def report(found: Dict[str, Outcome], quiet_s: List[float]) -> BenchmarkReport:
    """Figures and table."""
    usual_s = percentile(quiet_s, 0.99)
    idle = sum(not tries for outcome in found.values() for tries in outcome.tries.values())
    rows = [Row(MOTIONS, sum(each.words["moves"] + each.words["press"] for each in found.values())),
            Row(TWICE, sum(each.notices > 1 for each in found.values())), Row(IDLE_ATTACKS, idle)]
    rows += [Row(Requirement(f"p99 of a Command, {name}, against none", "(x)", must=MAX_RATIO),
                 percentile(each.delays_s, 0.99) / usual_s, remark=f"{1e3 * percentile(each.delays_s, 0.99):.1f} ms")
             for name, each in found.items()]
    figures: Dict[str, Any] = {"quiet": _times(quiet_s), "attacks": {name: {
        "tries": each.tries, "words": dict(each.words), "notices": each.notices, "codes": each.codes,
        "log_lines": each.log_lines, **_times(each.delays_s)} for name, each in found.items()}}
    return BenchmarkReport(rows, figures, [f"Without an attack: p50 {1e3 * percentile(quiet_s, 0.5):.1f} ms, "
                                           f"p99 {1e3 * usual_s:.1f} ms."])


def _times(values_s: List[float]) -> Dict[str, float]:
    return {"p50_s": percentile(values_s, 0.5), "p99_s": percentile(values_s, 0.99), "longest_s": max(values_s)}


if __name__ == "__main__":
    sys.exit(main())
