"""Runs the parts of the motion benchmark and merges their figures into one JSON file.

Usage: python -m mtr_bringup.bench_motion --out out/bench [--only tracking]
"""
# SPDX-License-Identifier: Apache-2.0
import argparse
import importlib
import json
import pathlib
import sys
from typing import Dict, List, Optional

PARTS = ("tracking", "encounters", "tip_over", "latency")
KEYS = ("time_ratio_median", "time_ratio_p95", "cross_track_p95_m", "heading_p95_deg", "stop_error_p95_m",
        "stop_heading_p95_deg", "encounters", "contacts_while_moving", "false_stops", "stop_latency_p99_ms",
        "drive_control_cpu_percent", "tip_margin_n")


def main(arguments: Optional[List[str]] = None) -> int:
    """Run the parts; 0 when each has given its figures."""
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
    for key, value in merged(details).items():
        if key not in PARTS:
            print(f"{key:28} {value}")
    return 0


def merged(details: Dict[str, Dict[str, object]]) -> Dict[str, object]:
    """The promised figures on top, everything else below the part it comes from."""
    found = {key: value for part in details.values() for key, value in part.items() if key in KEYS}
    return {**{key: found[key] for key in KEYS if key in found}, **details}


if __name__ == "__main__":
    sys.exit(main())
