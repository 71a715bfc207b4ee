"""Runs the benchmark of the link to the Car's bus; figures go to can.json.

Usage: python -m mtr_benchmarks.can_bus --out out/bench [--seconds 60] [--placements 100] [--short] [--traffic LOG ...]
"""
# SPDX-License-Identifier: Apache-2.0
import argparse
import pathlib
import tempfile
from typing import Iterator, List, Optional, Sequence

from ..harness.report import BenchmarkReport, finish
from ..harness.rows import Requirement, Row
from .learning import is_found
from .listening import Listened, on_terminal, on_virtual_bus
from .replaying import Replayed, replayed_autolock

# Names and limits of the rows of each bus.
LOST = "frames lost: {}"
LATENCY = "change sent to judged, 99 %: {}"
CORES = "processor of the link, of one core: {}"
MAX_LATENCY_MS = 5.0
FOUND = Requirement("learn: the hidden signal is proposed first", "(share)", must=0.95, at_least=True)
FOUND_RECORDED = Requirement("learn in recorded traffic: the hidden signal is proposed first", "(share)", must=0.95,
                             at_least=True)
REPLAY = Requirement("replay: largest difference of a distance", "mm", must=0.1)
DISTANCES = Requirement("replay: distances that are compared", "(count)", must=10, at_least=True)
# Least bus load: a result on a bus that this computer could not fill proves nothing.
_FULL_LOAD = 0.99
_SHORT_S, _SHORT_PLACEMENTS = 5.0, 5
_MM_PER_M = 1000.0


def main(arguments: Optional[List[str]] = None) -> int:
    """Measure; return 0 if every row meets its requirement."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--out", type=pathlib.Path, default=pathlib.Path("out/bench"), help="folder of the figures")
    parser.add_argument("--seconds", type=float, default=60.0, help="of full load on each bus, default %(default)s")
    parser.add_argument("--placements", type=int, default=100, help="of the signal to learn, default %(default)s")
    parser.add_argument("--short", action="store_true", help=f"{_SHORT_S:g} s and {_SHORT_PLACEMENTS} placements")
    parser.add_argument("--traffic", type=pathlib.Path, nargs="*", default=[], metavar="LOG",
                        help="logs of cars, in which the signal is hidden, too")
    options = parser.parse_args(arguments)
    seconds = _SHORT_S if options.short else options.seconds
    placements = _SHORT_PLACEMENTS if options.short else options.placements
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        listened = [on_virtual_bus(folder, seconds, False), on_virtual_bus(folder, seconds, True),
                    on_terminal(folder, seconds)]
        found = [is_found(seed) for seed in range(placements)]
        recorded = [is_found(seed, log=options.traffic[seed % len(options.traffic)])
                    for seed in range(placements if options.traffic else 0)]
        replayed = replayed_autolock(folder)
    return finish(report(listened, found, replayed, recorded), options.out / "can.json")


def report(listened: Sequence[Listened], found: Sequence[bool], replayed: Replayed,
           recorded: Sequence[bool] = ()) -> BenchmarkReport:
    """Return the table. recorded: results with recorded traffic of cars; their row is omitted if there are none."""
    rows = [row for each in listened for row in _rows(each)]
    rows.append(_found(FOUND, found))
    rows += [_found(FOUND_RECORDED, recorded)] if recorded else []
    rows += [Row(REPLAY, _MM_PER_M * replayed.worst_m), Row(DISTANCES, float(replayed.distances))]
    return BenchmarkReport(
        rows, {"missed_seeds": [seed for seed, each in enumerate(found) if not each],
               "missed_seeds_recorded": [seed for seed, each in enumerate(recorded) if not each],
               "latency_median_ms": {each.name: each.latency_ms(50.0) for each in listened}},
        ["The sender runs on the same computer; other work on it lengthens the latencies."])


def _found(requirement: Requirement, found: Sequence[bool]) -> Row:
    return Row(requirement, sum(found) / len(found) if found else None, details={"placements": float(len(found))})


def _rows(found: Listened) -> Iterator[Row]:
    is_full = found.load >= _FULL_LOAD
    yield Row(Requirement(LOST.format(found.name), "(count)", must=0.0), float(found.lost), is_full,
              {"sent": float(found.sent_frames), "heard": float(found.heard), "logged": float(found.logged),
               "load": found.load}, "" if is_full else "this computer did not fill the bus")
    yield Row(Requirement(LATENCY.format(found.name), "ms", must=MAX_LATENCY_MS), found.latency_ms(99.0), is_full,
              {"changes": float(len(found.latencies_s))})
    yield Row(Requirement(CORES.format(found.name), "(share)"), found.cores)


if __name__ == "__main__":
    raise SystemExit(main())
