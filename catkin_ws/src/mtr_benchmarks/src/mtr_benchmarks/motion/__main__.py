"""Runs the parts of the motion benchmark; figures go to motion.json.

Usage: python -m mtr_benchmarks.motion --out out/bench [--only tracking]
"""
# SPDX-License-Identifier: Apache-2.0
import argparse
import importlib
import pathlib
import sys
from dataclasses import asdict
from typing import Any, Dict, List, Optional

from ..harness.report import BenchmarkReport, finish, write
from .options import MotionOptions

# Modules with a function `measure` that returns figures with rows.
PARTS = ("tracking", "posts", "encounters", "wide_encounters", "tip_over", "grounds", "latency")
# Figures at the top level of the file, in this order.
PROMISED = ("time_ratio_median", "time_ratio_p95", "cross_track_p95_m", "heading_p95_deg", "stop_error_p95_m",
            "stop_heading_p95_deg", "over_speed_limit_mps", "post_ways_driven", "encounters", "contacts_while_moving",
            "false_stops", "wide_movers", "wide_contacts_while_moving", "walker_contacts_while_moving",
            "child_contacts_while_moving", "lying_contacts_while_moving", "stop_latency_p99_ms",
            "drive_control_cpu_percent", "tip_margin_n",
            "slope_load_n", "climb_load_n", "slippery_contacts", "cable_stops", "cable_tilt_deg")


def main(arguments: Optional[List[str]] = None) -> int:
    """Run the parts; return 0 if every row meets its requirement."""
    defaults = MotionOptions()
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--out", type=pathlib.Path, default=pathlib.Path("out/bench"), help="folder of motion.json")
    parser.add_argument("--only", choices=PARTS, action="append", help="run this part only")
    parser.add_argument("--seed", type=int, default=defaults.seed, help="seed of everything random")
    parser.add_argument("--pairs", type=int, default=defaults.pairs, help="waypoint pairs")
    parser.add_argument("--jobs", type=int, default=defaults.jobs, help="processes")
    given = parser.parse_args(arguments)
    options = MotionOptions(given.pairs, given.seed, given.jobs)
    path = given.out / "motion.json"
    parts: Dict[str, Any] = {}
    for name in given.only or PARTS:
        parts[name] = importlib.import_module(f"{__package__}.{name}").measure(options)
        # Results so far are kept if a later part fails.
        write(report(parts), path)
    return finish(report(parts), path)


def report(parts: Dict[str, Any]) -> BenchmarkReport:
    """Return the promised figures at the top level, and all figures by part in `details`."""
    details = {name: asdict(part) for name, part in parts.items()}
    found = {key: value for part in details.values() for key, value in part.items()}
    promised = {key: found[key] for key in PROMISED if key in found}
    return BenchmarkReport([row for part in parts.values() for row in part.rows()], {**promised, "details": details})


if __name__ == "__main__":
    sys.exit(main())
