"""Mutation test: changes one construct of a pure module at a time and looks whether a test notices.

Usage: run.py [--group NAME ...] [--sample N] [--jobs N]; `make mutants` installs what it needs. Exit status 1 when a
group finds less of its mutants than its minimum, 85 % where groups.yaml states none; those of equivalent.yaml, which
change nothing that a caller can see, do not count.
"""
# SPDX-License-Identifier: Apache-2.0
import argparse
import multiprocessing
import pathlib
import random
import shutil
import sys
import time
from typing import Any, Dict, List, NamedTuple, Set, Tuple

import trial
import yaml

HERE = pathlib.Path(__file__).resolve().parent
TOOLS = trial.TOP / "out" / "mutants" / "tools"
MIN_SHARE = 0.85
SEED = 1
# A mutant whose tests take so many times as long as those without one, and this at least, loops for ever.
PATIENCE, MIN_PATIENCE_S = 4.0, 60.0
ANY = "*"


class Group(NamedTuple):
    """Modules that are mutated (below source), the tests that have to notice it, and the least share of them."""

    name: str
    source: str
    modules: List[str]
    tests: List[str]
    minimum: float = MIN_SHARE


def main() -> int:
    """Run the wanted groups."""
    # Cosmic Ray and what it needs come last: the libraries of the tests stay those of the project.
    sys.path.append(str(TOOLS))
    options = parsed()
    table = yaml.safe_load((HERE / "groups.yaml").read_text(encoding="utf-8"))
    wanted = [Group(name, **fields) for name, fields in table["groups"].items()
              if not options.group or name in options.group]
    good = [judged(group, table["operators"], options) for group in wanted]
    shutil.rmtree(trial.TREES, ignore_errors=True)
    return 0 if good and all(good) else 1


def parsed() -> argparse.Namespace:
    """Options of the command line."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--group", action="append", help="only this group; may be given again")
    parser.add_argument("--sample", type=int, help="so many mutants of each group, always the same ones")
    parser.add_argument("--jobs", type=int, default=2, help="mutants at the same time")
    return parser.parse_args()


def judged(group: Group, operators: List[str], options: argparse.Namespace) -> bool:
    """Test one group's mutants and print what became of them; True when enough were found."""
    from mutants import mutants_of  # not above: main says where its library is

    source, begun = trial.TOP / group.source, time.monotonic()
    mutants = [mutant for module in group.modules for mutant in mutants_of(source, module, operators)]
    if options.sample and options.sample < len(mutants):
        mutants = sorted(random.Random(SEED).sample(mutants, options.sample), key=lambda each: each[:4])
    known = equivalents()
    counted = [each for each in mutants if not {(each.module, each.before, each.after),
                                                (ANY, each.before, each.after)} & known]
    with multiprocessing.get_context("fork").Pool(options.jobs, trial.prepare, [source]) as pool:
        untouched, tried = (source / group.modules[0]).read_text(encoding="utf-8"), time.monotonic()
        if pool.apply(trial.is_noticed, [group.modules[0], untouched, group.tests, trial.LIMIT_S]):
            print(f"{group.name}: its tests fail without a mutant.")
            return False
        limit_s = max(PATIENCE * (time.monotonic() - tried), MIN_PATIENCE_S)
        noticed = pool.starmap(trial.is_noticed, [(each.module, each.code, group.tests, limit_s) for each in counted],
                               4)
    for module in group.modules:
        report(module, [(each, found) for each, found in zip(counted, noticed) if each.module == module])
    share = sum(noticed) / max(len(counted), 1)
    print(f"{group.name}: {sum(noticed)} of {len(counted)} found, {100.0 * share:.0f} %, "
          f"{len(mutants) - len(counted)} equivalent, {time.monotonic() - begun:.0f} s", flush=True)
    return share >= group.minimum


def equivalents() -> Set[Tuple[str, str, str]]:
    """(module, line before, line after) of each mutant that changes nothing."""
    rows: List[Dict[str, Any]] = yaml.safe_load((HERE / "equivalent.yaml").read_text(encoding="utf-8")) or []
    return {(row["module"], row["before"], after) for row in rows for after in row["after"]}


def report(module: str, found: List[Tuple[Any, bool]]) -> None:
    """One line for the module, and its survivors."""
    survivors = [mutant for mutant, noticed in found if not noticed]
    print(f"{module}: {len(found)} mutants, {len(found) - len(survivors)} killed, {len(survivors)} survived")
    for mutant in survivors:
        print(f"  line {mutant.line}\n    - {mutant.before}\n    + {mutant.after}")


if __name__ == "__main__":
    sys.exit(main())
