"""Runs the benchmark of the preflight in motion; figures go to preflight.json.

Usage: python -m mtr_benchmarks.preflight --drives 60 --seed 1 --out out/bench
"""
# SPDX-License-Identifier: Apache-2.0
import argparse
import pathlib
import sys
from typing import Dict, List, Optional

from ..harness.report import BenchmarkReport, finish
from ..harness.rows import Requirement, Row
from .assemblies import ASSEMBLIES, RIGHT
from .drive import BARE_SITES, SITES, Drive, drives, record
from .verdicts import Verdict, counts, verdict_on

# A wrong verdict leads a person to the wrong part, or lets a wrong robot start.
WRONG = Requirement("wrong verdicts, all sites", "(share)", must=0.01)
PASSED = Requirement("wrong robots that pass, all sites", "(share)", must=0.01)
ALARMS = Requirement("right robots that are called wrong, all sites", "(share)", must=0.0)
KNOWN = Requirement("right verdicts after 5 s of motion, sites with surroundings", "(share)", must=0.95, at_least=True)
KNOWN_BARE = Requirement("the same, nothing but the Car and cones within 20 m", "(share)")
Judged = Dict[Drive, Dict[str, Verdict]]


def main(arguments: Optional[List[str]] = None) -> int:
    """Measure; return 0 if every row meets its requirement."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--out", type=pathlib.Path, default=pathlib.Path("out/bench"), help="folder of the figures")
    parser.add_argument("--seed", type=int, default=1, help="of places, persons and sensors")
    parser.add_argument("--drives", type=int, default=60, help="how many, each with every assembly")
    options = parser.parse_args(arguments)
    judged = {drive: judge(drive) for drive in drives(options.seed, options.drives)}
    return finish(report(judged), options.out / "preflight.json")


def judge(drive: Drive) -> Dict[str, Verdict]:
    """Return the preflight's verdict on one drive, for each assembly."""
    recording = record(drive)
    return {name: verdict_on(recording, assembly) for name, assembly in ASSEMBLIES.items()}


def report(judged: Judged) -> BenchmarkReport:
    """Return figures and rows."""
    rich = [verdict for drive in judged if drive.site not in BARE_SITES for verdict in judged[drive].values()]
    bare = [verdict for drive in judged if drive.site in BARE_SITES for verdict in judged[drive].values()]
    right = [verdicts[RIGHT] for verdicts in judged.values()]
    wrong = [verdict for verdicts in judged.values() for name, verdict in verdicts.items() if name != RIGHT]
    rows = [Row(WRONG, share([not each.is_right and not each.is_undecided for each in rich + bare])),
            Row(PASSED, share([not each.is_right and not each.said for each in wrong])),
            Row(ALARMS, share([not each.is_right and not each.is_undecided for each in right])),
            Row(KNOWN, share([each.is_right for each in rich])),
            Row(KNOWN_BARE, share([each.is_right for each in bare]))]
    return BenchmarkReport(rows, {"drives": len(judged), "assemblies": by_assembly(judged, False),
                                  "assemblies_bare": by_assembly(judged, True),
                                  "sites": by_site(judged), "wrong": wrong_ones(judged)})


def share(values: List[bool]) -> Optional[float]:
    """Return the share of true values; None without values."""
    return sum(values) / len(values) if values else None


def by_assembly(judged: Judged, is_bare: bool) -> Dict[str, Dict[str, int]]:
    """Return the counts for each assembly, on bare sites or on the others."""
    chosen = [drive for drive in judged if (drive.site in BARE_SITES) == is_bare]
    return {name: counts([judged[drive][name] for drive in chosen]) for name in ASSEMBLIES}


def by_site(judged: Judged) -> Dict[str, Dict[str, int]]:
    """Return the counts for each site, over all assemblies."""
    return {site: counts([verdict for drive in judged if drive.site == site for verdict in judged[drive].values()])
            for site in SITES}


def wrong_ones(judged: Judged) -> List[Dict[str, object]]:
    """Return every wrong verdict, for an analysis of its cause."""
    return [{"site": drive.site, "seed": drive.seed, "assembly": name, "said": list(verdict.said)}
            for drive, verdicts in judged.items() for name, verdict in verdicts.items()
            if not verdict.is_right and not verdict.is_undecided]


if __name__ == "__main__":
    sys.exit(main())
