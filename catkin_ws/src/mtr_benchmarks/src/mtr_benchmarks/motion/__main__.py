"""Runs the parts of the motion benchmark and merges their figures into one JSON file.

Usage: python -m mtr_benchmarks.motion --out out/bench [--only tracking]
"""
# SPDX-License-Identifier: Apache-2.0
import argparse
import importlib
import json
import pathlib
import sys
from typing import Dict, List, Optional

PARTS = ("tracking", "encounters", "tip_over", "latency")
# What each figure must be, at most or at least; None: it is only told. A wheel that carries nothing is in the air.
FIGURES = {
    "time_ratio_median": None, "time_ratio_p95": ("<=", 1.15), "cross_track_p95_m": ("<=", 0.02),
    "heading_p95_deg": ("<=", 1.0), "stop_error_p95_m": ("<=", 0.02), "stop_heading_p95_deg": ("<=", 1.0),
    "encounters": (">=", 1000), "contacts_while_moving": ("<=", 0), "false_stops": ("<=", 0),
    "stop_latency_p99_ms": ("<=", 20.0), "drive_control_cpu_percent": ("<=", 5.0), "tip_margin_n": (">=", 1.0)}


def main(arguments: Optional[List[str]] = None) -> int:
    """Run the parts; the exit status says whether every figure is what it must be."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--out", type=pathlib.Path, default=pathlib.Path("out/bench"), help="folder of motion.json")
    parser.add_argument("--only", choices=PARTS, action="append", help="run this part only")
    parser.add_argument("--seed", type=int, default=1, help="seed of everything random")
    parser.add_argument("--pairs", type=int, default=200, help="waypoint pairs")
    parser.add_argument("--jobs", type=int, default=2, help="processes")
    options = parser.parse_args(arguments)
    options.out.mkdir(parents=True, exist_ok=True)
    path = options.out / "motion.json"
    details: Dict[str, Dict[str, object]] = {}
    for name in options.only or PARTS:
        details[name] = importlib.import_module(f"{__package__}.{name}").run(options)
        path.write_text(json.dumps(merged(details), indent=2) + "\n", encoding="utf-8")
    figures = merged(details)
    print("\n".join(lines(figures)))
    return 0 if all(is_met(key, figures[key]) for key in FIGURES if key in figures) else 1


def merged(details: Dict[str, Dict[str, object]]) -> Dict[str, object]:
    """The promised figures on top, everything below the part it comes from in `details`."""
    found = {key: value for part in details.values() for key, value in part.items()}
    return {**{key: found[key] for key in FIGURES if key in found}, "details": details}


def lines(figures: Dict[str, object]) -> List[str]:
    """The figures for a person."""
    shown = []
    for key in (key for key in FIGURES if key in figures):
        limit = FIGURES[key]
        must = f"must be {limit[0]} {limit[1]:g}: {'met' if is_met(key, figures[key]) else 'NOT MET'}" if limit else ""
        shown.append(f"{key:28} {figures[key]:<10.4g} {must}".rstrip())
    return shown


def is_met(key: str, value: float) -> bool:
    """True when a figure is what it must be; a figure that is no number is not."""
    limit = FIGURES[key]
    return limit is None or (value <= limit[1] if limit[0] == "<=" else value >= limit[1])


if __name__ == "__main__":
    sys.exit(main())
