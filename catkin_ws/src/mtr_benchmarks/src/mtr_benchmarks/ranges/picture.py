"""Draws the errors of the usual scan and of the search from the figures of the range benchmark.

Usage: python -m mtr_benchmarks.ranges.picture out/bench/range.json docs/images/scan_and_search.png
"""
# SPDX-License-Identifier: Apache-2.0
import argparse
import json
import math
import pathlib
import statistics
import sys
from typing import Any, Dict, List, NamedTuple, Optional

from matplotlib.figure import Figure

from mtr_operator.report.drawing.plain_figure import plain_figure

from .campaigns import WIDTHS_M

# Name, colour, and offset from the width's place on the axis.
METHODS = {"scan": ("usual scan: first press that works", "#c24e00", -0.12),
           "adaptive": ("this search", "#0072b2", 0.12)}
SIZE_INCH, DPI = (9.4, 3.9), 120
_NOTE = ("Error of the distance at which half of the presses work: mean and standard deviation. Simulated car without "
         "fading, {lines:.0f} radials\nof each width. The 95 % intervals of the search contain the truth in "
         "{least:.0f} to {most:.0f} %. Robot time of a radial: scan {scan_s:.0f} s, search {search_s:.0f} s (median).")


class Point(NamedTuple):
    """Figures of one method at one width."""

    bias_m: float
    sigma_m: float
    coverage: float
    time_s: float
    lines: float


def points(details: Dict[str, Any], method: str) -> List[Point]:
    """Return the points of a method, one for each width.

    Raises:
        KeyError: the benchmark lacks a width.
    """
    kinds = details[method]
    return [Point(each["bias_m"], math.sqrt(max(each["rms_m"] ** 2 - each["bias_m"] ** 2, 0.0)), each["coverage_95"],
                  each["robot_time_s_median"], each["lines"])
            for each in (kinds[f"steady/{width_m:g}"] for width_m in WIDTHS_M)]


def draw(details: Dict[str, Any]) -> Figure:
    """Return the figure."""
    figure = plain_figure(SIZE_INCH, dpi=DPI, layout="constrained")
    axes = figure.add_subplot()
    for method, (name, colour, aside) in METHODS.items():
        found = points(details, method)
        places = [place + aside for place in range(len(found))]
        axes.errorbar(places, [each.bias_m for each in found], yerr=[each.sigma_m for each in found], fmt="o",
                      color=colour, capsize=4, markersize=7, linewidth=2, label=name)
    axes.axhline(0.0, color="#5b6b7f", linewidth=1)
    axes.set_xticks(range(len(WIDTHS_M)), [f"{width_m:g} m" for width_m in WIDTHS_M])
    axes.set_xlabel("width of the transition from 90 % to 10 % of the presses")
    axes.set_ylabel("error of the range [m]")
    axes.grid(axis="y", color="#d5dbe3")
    axes.legend(loc="upper left", frameon=False)
    figure.supxlabel(note(details), fontsize=8.5, x=0.02, ha="left")
    return figure


def note(details: Dict[str, Any]) -> str:
    """Return the caption with the coverage and the times."""
    scan, search = (points(details, method) for method in METHODS)
    coverage = [100.0 * each.coverage for each in search]
    scan_s, search_s = (statistics.median(each.time_s for each in found) for found in (scan, search))
    return _NOTE.format(lines=search[0].lines, least=min(coverage), most=max(coverage), scan_s=scan_s,
                        search_s=search_s)


def main(arguments: Optional[List[str]] = None) -> int:
    """Draw the picture; return the exit status."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("figures", type=pathlib.Path, help="range.json of the benchmark")
    parser.add_argument("picture", type=pathlib.Path, help="PNG or SVG file to write")
    options = parser.parse_args(arguments)
    details = json.loads(options.figures.read_text(encoding="utf-8"))["details"]
    draw(details).savefig(options.picture)
    return 0


if __name__ == "__main__":
    sys.exit(main())
