"""Benchmarks that need no ROS master; each leaves its figures in a JSON file.

Usage: python -m mtr_bringup.bench --out out/bench
"""
# SPDX-License-Identifier: Apache-2.0
import argparse
import json
import pathlib
import statistics
import sys
import time
from typing import Dict, List, Optional

from mtr_core.schedule import CLOCK_STEP
from mtr_simulation.scenario import named_scenario
from mtr_simulation.sim import Sim

SIMULATED_S = 60.0
TICK_S = CLOCK_STEP.period_ns * 1e-9


def main(arguments: Optional[List[str]] = None) -> int:
    """Run all benchmarks; always 0, the figures are for a person to judge."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--out", type=pathlib.Path, default=pathlib.Path("out/bench"), help="folder of the figures")
    options = parser.parse_args(arguments)
    options.out.mkdir(parents=True, exist_ok=True)
    figures = simulation()
    (options.out / "simulation.json").write_text(json.dumps(figures, indent=2) + "\n", encoding="utf-8")
    print(f"Physics and both LiDARs: {figures['real_time_factor']:.1f} x real time.")
    return 0


def simulation() -> Dict[str, float]:
    """Speed of physics and sensors alone while the robot drives a circle; times in ms of CPU for a tick of 20 ms."""
    sim = Sim(1, named_scenario("lot"))
    ticks = []
    for _ in range(round(SIMULATED_S / TICK_S)):
        sim.command(0.5, 0.2)
        begun = time.process_time()
        sim.step()
        ticks.append(1e3 * (time.process_time() - begun))
    return {
        "real_time_factor": SIMULATED_S / (1e-3 * sum(ticks)),
        "tick_median_ms": statistics.median(ticks),
        "tick_p99_ms": statistics.quantiles(ticks, n=100)[98],
    }


if __name__ == "__main__":
    sys.exit(main())
