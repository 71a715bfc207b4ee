"""Each attack on the running simulated robot by itself, and all at once; figures go to red_team.json.

Usage: report.py [--out FOLDER] [--commands N] [--turns N] [--idle S] [ATTACK ...]

The Operator's Commands are timed in turns, some without an attack and as many beside it, so that what else the machine
does falls on both.
"""
# SPDX-License-Identifier: Apache-2.0
import argparse
import pathlib
import sys
from typing import Any, Counter, Dict, List

from attacks import ALL, INSIDERS, STRANGERS
from robot_under_attack import Outcome, RobotUnderAttack

from mtr_benchmarks.harness.report import BenchmarkReport, finish
from mtr_benchmarks.harness.rows import Requirement, Row
from mtr_benchmarks.harness.tails import Turn, percentile, ratio_of

MOTIONS = Requirement("words to wheels and buttons that are not zero", "(count)", must=0.0)
TWICE = Requirement("attacks of which a Status tells twice", "(count)", must=0.0)
# Without it the zero above proves nothing.
MOVED = Requirement("words to wheels or to buttons, the fewer, when a controller gives the same orders", "(count)",
                    must=1.0, at_least=True)
IDLE_ATTACKS = Requirement("attacks that have tried nothing", "(count)", must=0.0)
MAX_RATIO = 2.0
GROUPS = {"all strangers": STRANGERS, "all insiders": INSIDERS}
NOT_HURRIED = "Robot and Operator had no priority over what else the machine did: that takes root."


def main() -> int:
    """Command line."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("--out", type=pathlib.Path, default=pathlib.Path("out/bench"), help="default %(default)s")
    parser.add_argument("--commands", type=int, default=60, help="of the Operator in a turn; default %(default)s")
    parser.add_argument("--turns", type=int, default=8, help="without and beside each attack; default %(default)s")
    parser.add_argument("--idle", type=float, default=10.0, help="s without an Operator in each; default %(default)s")
    parser.add_argument("attacks", nargs="*", metavar="ATTACK", help="default: each, and all at once")
    options = parser.parse_args()
    wanted = {**{each.__name__: (each,) for each in (*STRANGERS, *INSIDERS)}, **GROUPS}
    wanted.update({name: (ALL[name],) for name in options.attacks if name not in wanted})
    folder = options.out / "red_team"
    folder.mkdir(parents=True, exist_ok=True)
    found: Dict[str, Attack] = {}
    with RobotUnderAttack(folder) as robot:
        remarks = [] if robot.hurry() else [NOT_HURRIED]
        moved = robot.words_to_controller()
        for name in options.attacks or wanted:
            found[name] = Attack([each.__name__ for each in wanted[name]])
            for turn in range(options.turns):
                found[name].take_turn(robot, 0.0 if turn else options.idle, options.commands)
            print(f"{name}: {found[name].tries}", flush=True)
    return finish(report(found, moved, remarks), options.out / "red_team.json")


class Attack:
    """Attacks at once, in turns. turns: the Operator's delays. outcomes: of each turn beside the attack."""

    def __init__(self, attacks: List[str]):
        self.turns: List[Turn] = []
        self.outcomes: List[Outcome] = []
        self._attacks = attacks

    def take_turn(self, robot: RobotUnderAttack, idle_s: float, commands: int) -> None:
        """One without and one beside it; idle_s: for so long nobody controls the robot."""
        quiet_s = robot.quiet_delays_s(commands)
        self.outcomes.append(robot.attacked(self._attacks, idle_s, commands))
        self.turns.append(Turn(quiet_s, self.outcomes[-1].delays_s))

    @property
    def tries(self) -> Dict[str, int]:
        """Of each attack in all turns, whatever it tried."""
        return {name: sum(sum(each.tries[name].values()) for each in self.outcomes) for name in self._attacks}


def report(found: Dict[str, Attack], moved: Counter[str], remarks: List[str]) -> BenchmarkReport:
    """Figures and table. moved: words to wheels and buttons of a controller's orders."""
    outcomes = [outcome for attack in found.values() for outcome in attack.outcomes]
    rows = [Row(MOTIONS, sum(each.words["moves"] + each.words["press"] for each in outcomes)),
            Row(MOVED, min(moved["moves"], moved["press"])),
            Row(TWICE, sum(each.notices > 1 for each in outcomes)),
            Row(IDLE_ATTACKS, sum(not tries for attack in found.values() for tries in attack.tries.values()))]
    figures: Dict[str, Any] = {}
    for name, attack in found.items():
        ratio = ratio_of(attack.turns)
        rows.append(Row(Requirement(f"p99 of a Command, {name}, against none", "(x)", must=MAX_RATIO), ratio.value,
                        details={"low_95": ratio.low, "high_95": ratio.high},
                        remark=f"95 % {ratio.low:.2f} to {ratio.high:.2f}; {1e3 * ratio.with_s:.1f} and "
                               f"{1e3 * ratio.without_s:.1f} ms"))
        figures[name] = {"tries": attack.tries,
                         "codes": sorted({code for each in attack.outcomes for code in each.codes}),
                         "log_lines": sum(each.log_lines for each in attack.outcomes),
                         "quiet": _times([delay for turn in attack.turns for delay in turn.without_s]),
                         "beside": _times([delay for turn in attack.turns for delay in turn.with_s])}
    return BenchmarkReport(rows, {"attacks": figures}, remarks)


def _times(values_s: List[float]) -> Dict[str, float]:
    return {"p50_s": percentile(values_s, 0.5), "p99_s": percentile(values_s, 0.99), "longest_s": max(values_s)}


if __name__ == "__main__":
    sys.exit(main())
