"""Compares the results of a test with the simulator's truth: writes truth.csv and prints the errors.

Usage: python -m mtr_simulation.truth.compare --events FILE --results DIR --car-length M --car-width M
       [--car NAME --seed N] [--max-error M] [--max-sigmas N]

The exit status is 0 if each line that is `ok` has its true event and is within the given limits. It is 1 if a line has
none or exceeds a limit, or if a limit is given and no distance is `ok`. It is 2 if a file is unusable.
"""
# SPDX-License-Identifier: Apache-2.0
import argparse
import csv
import io
import math
import os
import pathlib
import statistics
import sys
from typing import List, Optional

from mtr_core.errors import ConfigurationError, RobotError, check_range

from ..car.choice import chosen_car
from ..car.reaction.model import ReactionModel
from .borders import border_table
from .distance import CarSize, Comparison, Expected, compare
from .expected import expected
from .intervals import coverage, interval_table, read_intervals
from .results import (
    FIRST_COLUMN,
    MeasuredEvent,
    ResultsError,
    column_names,
    key_height_m,
    read_autolock,
    read_events,
    read_handle_request,
    read_key_press,
    read_zone_map,
)
from .zones import ZoneGrid, true_coverage

RESULTS_NAME = "results.csv"
TRUTH_NAME = "truth.csv"
TRUTH_HEADER = ("scenario", "line", "event", "true_distance_m", "p50_distance_m", "p95_distance_m", "truth_static_m",
                "true_border_share", "true_coverage")
AUTOLOCK, KEY_PRESS, ZONE_MAP, HANDLE_REQUEST = "autolock", "key_press", "zone_map", "handle_request"
_READERS = {AUTOLOCK: read_autolock, KEY_PRESS: read_key_press, ZONE_MAP: read_zone_map,
            HANDLE_REQUEST: read_handle_request}
# Column that identifies the scenario; two scenarios have axes, and the second one has a unique column.
_TOLD_BY = {HANDLE_REQUEST: "requests", **{name: FIRST_COLUMN[name] for name in (AUTOLOCK, KEY_PRESS, ZONE_MAP)}}
# Scenarios whose distance results from many presses, so that none of them is its event.
_WITHOUT_EVENT = (ZONE_MAP,)


def main(arguments: Optional[List[str]] = None) -> int:
    """Run the command line; return the exit status."""
    options = _parse(arguments)
    try:
        size = CarSize(
            check_range("car-length", options.car_length, 0.5, 20.0, "m"),
            check_range("car-width", options.car_width, 0.5, 20.0, "m"),
        )
        results = options.results / RESULTS_NAME
        scenario = options.scenario or guess_scenario(results)
        measured = _READERS[scenario](results)
        comparisons = list(compare(measured, read_events(options.events), size))
        if options.car:
            comparisons = with_expected(comparisons, size, chosen_car(options.car).reactions(options.seed), results)
        write_truth(options.results / TRUTH_NAME, scenario, comparisons)
    except RobotError as error:
        print(error, file=sys.stderr)
        return 2
    told = read_intervals(results, scenario, comparisons)
    at_border = border_table(results, comparisons) if scenario == HANDLE_REQUEST else []
    print("\n".join([*table(comparisons), *interval_table(told), *at_border, *summary(scenario, comparisons),
                     *coverage(scenario, told)]))
    wrong = [] if scenario in _WITHOUT_EVENT else problems(comparisons, options.max_error, options.max_sigmas)
    for sentence in wrong:
        print(sentence, file=sys.stderr)
    return 1 if wrong else 0


def problems(comparisons: List[Comparison], max_error_m: Optional[float], max_sigmas: Optional[float]) -> List[str]:
    """Return a sentence for each ok distance without a true event, or with a too large error; None: no limit."""
    good = [c for c in comparisons if c.measured.status == "ok"]
    found = [f"Line {c.measured.line}: no true event for its {c.measured.event} at {c.measured.time_s:.3f} s."
             for c in good if c.true_distance_m is None]
    if max_error_m is None and max_sigmas is None:
        return found
    found += [f"Line {c.measured.line}: its {c.measured.event} is {c.error_m:+.3f} m off with a sigma of "
              f"{c.measured.uncertainty_m:.3f} m." for c in good if c.true_distance_m is not None
              and not is_near(c, max_error_m, max_sigmas)]
    return found if good else ["No distance is ok, so that none agrees with the truth."]


def is_near(comparison: Comparison, max_error_m: Optional[float], max_sigmas: Optional[float]) -> bool:
    """Return True if the error is within both limits; NaN is within none."""
    error_m = abs(comparison.error_m)
    return ((max_error_m is None or error_m <= max_error_m)
            and (max_sigmas is None or error_m <= max_sigmas * comparison.measured.uncertainty_m))


def guess_scenario(results: pathlib.Path) -> str:
    """Return the scenario whose column the header has."""
    names = column_names(results)
    for scenario, column in _TOLD_BY.items():
        if column in names:
            return scenario
    raise ResultsError(f"{results} is of no known scenario; name one with --scenario.")


def with_expected(comparisons: List[Comparison], size: CarSize, model: ReactionModel,
                  results: pathlib.Path) -> List[Comparison]:
    """Add the results that a perfect measurement of each line would have."""
    height_m = key_height_m(results)
    # Only zones have a grid: radials of other scenarios may be farther apart than the width of a zone.
    grid = ZoneGrid.of_results(results) if any(each.measured.event == "reach" for each in comparisons) else None

    def of_line(measured: MeasuredEvent) -> Expected:
        likely = expected(measured, size, model, height_m)
        if measured.event != "reach" or grid is None:
            return likely
        return likely._replace(coverage=true_coverage(measured, size, model, grid))

    return [each._replace(expected=of_line(each.measured)) for each in comparisons]


def write_truth(path: pathlib.Path, scenario: str, comparisons: List[Comparison]) -> None:
    """Write truth.csv atomically.

    An event that did not happen has a line only if the Car's model expects it; its true distance is empty.
    """
    text = io.StringIO()
    writer = csv.writer(text, lineterminator="\n")
    writer.writerow(TRUTH_HEADER)
    for measured, true_distance_m, likely in comparisons:
        true_m = math.nan if true_distance_m is None else true_distance_m
        told = (true_m, likely.p50_distance_m, likely.border_share, likely.coverage)
        if any(math.isfinite(value) for value in told):
            writer.writerow((scenario, measured.line, measured.event, *map(_written, (true_m, *likely))))
    temporary = path.with_name(f".{path.name}.{os.getpid()}")
    try:
        temporary.write_text(text.getvalue(), encoding="utf-8")
        os.replace(temporary, path)
    except OSError as error:
        raise ConfigurationError(f"{path} cannot be written: {error.strerror}.") from error


def table(comparisons: List[Comparison]) -> List[str]:
    """Return lines with measured and true distance of each event."""
    lines = ["line event  side        status        measured m   true m  error m  sigma m    p50 m    p95 m"]
    for comparison in comparisons:
        m = comparison.measured
        true_m = math.nan if comparison.true_distance_m is None else comparison.true_distance_m
        lines.append(
            f"{m.line:>4} {m.event:6} {m.side:11} {m.status:12} {_cell(m.distance_m, 11)} {_cell(true_m, 8)} "
            f"{_cell(comparison.error_m, 8, '+')} {_cell(m.uncertainty_m, 8)} "
            f"{_cell(comparison.expected.p50_distance_m, 8)} {_cell(comparison.expected.p95_distance_m, 8)}"
        )
    return lines


def summary(scenario: str, comparisons: List[Comparison]) -> List[str]:
    """Return median, 95th percentile and maximum of the absolute errors of ok lines, and their size in sigma.

    The result is empty if a line has no event of its own.
    """
    if scenario in _WITHOUT_EVENT:
        return []
    good = [c for c in comparisons if c.measured.status == "ok" and math.isfinite(c.error_m)]
    count = f"{scenario}: {len(good)} of {len(comparisons)} distances are ok and have their true event"
    if not good:
        return [f"{count}."]
    errors = sorted(abs(c.error_m) for c in good)
    lines = [
        f"{count}; |error| median {statistics.median(errors):.3f} m, "
        f"95th percentile {percentile(errors, 0.95):.3f} m, largest {errors[-1]:.3f} m."
    ]
    in_sigma = [abs(c.error_m) / c.measured.uncertainty_m for c in good if c.measured.uncertainty_m > 0.0]
    if in_sigma:
        rms = math.sqrt(statistics.fmean(s * s for s in in_sigma))
        lines.append(f"{scenario}: |error| in sigma: rms {rms:.2f}, largest {max(in_sigma):.2f}.")
    return lines


def percentile(ordered: List[float], share: float) -> float:
    """Return the linear interpolation between the two nearest of the ordered values."""
    position = share * (len(ordered) - 1)
    low = math.floor(position)
    high = min(low + 1, len(ordered) - 1)
    return ordered[low] + (position - low) * (ordered[high] - ordered[low])


def _written(value: float) -> str:
    return f"{value:.4f}" if math.isfinite(value) else ""


def _cell(value: float, width: int, sign: str = "") -> str:
    return f"{value:{sign}{width}.3f}" if math.isfinite(value) else " " * (width - 1) + "-"


def _parse(arguments: Optional[List[str]]) -> argparse.Namespace:
    parser = argparse.ArgumentParser(description="Compare the results of a test with the simulator's truth.")
    parser.add_argument("--events", type=pathlib.Path, required=True, help="truth_events.csv of the simulator")
    parser.add_argument("--results", type=pathlib.Path, required=True, help="folder with results.csv")
    parser.add_argument("--car-length", type=float, required=True, help="true length of the Car in m")
    parser.add_argument("--car-width", type=float, required=True, help="true width of the Car in m")
    parser.add_argument("--car", default="", help="the simulated Car; without it the p columns of truth.csv are empty")
    parser.add_argument("--seed", type=int, default=1, help="of the simulation; default 1")
    parser.add_argument("--scenario", choices=sorted(_READERS), help="default: told by the header of results.csv")
    parser.add_argument("--max-error", type=float, help="m that a distance may be off; default: any")
    parser.add_argument("--max-sigmas", type=float, help="of its own that a distance may be off; default: any")
    return parser.parse_args(arguments)


if __name__ == "__main__":
    sys.exit(main())
