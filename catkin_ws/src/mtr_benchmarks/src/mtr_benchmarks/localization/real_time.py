"""Localization's node on the machine's clock, fed with a recorded drive at its own pace: latency and load.

The node runs as a process of its own, without lock-step, as on the robot. Latency is wall time from publishing a sweep
to receiving `map` → `odom` with the time of that sweep, so that both ways through the loopback interface are in it.
"""
# SPDX-License-Identifier: Apache-2.0
import pathlib
import statistics
import tempfile
from typing import Any, Dict, List

from mtr_benchmarks.components.probe import run_probe

from .drive_options import DriveOptions
from .record import record
from .recording import BAG

# Both LiDARs with 720 beams at 25 Hz.
DRIVE = DriveOptions(scene="lot", car="hatchback", rear=True)
MEASURED_S = 40.0
LIMIT_S = 300.0
LATENCY_GOAL_MS, CPU_GOAL_PERCENT = 15.0, 10.0


def real_time() -> Dict[str, Any]:
    """scan_to_tf_p99_ms and cpu_percent of one core while the robot drives on the frozen map."""
    with tempfile.TemporaryDirectory(prefix="mtr_bench_") as folder:
        record(DRIVE, pathlib.Path(folder))
        found = run_probe(f"{__package__}.real_time_probe", [str(pathlib.Path(folder) / BAG), str(MEASURED_S)], LIMIT_S)
    return figures(found["latency_ms"], int(found["unanswered"][0]), found["cpu_percent"][0])


def figures(latencies_ms: List[float], unanswered: int, cpu_percent: float) -> Dict[str, Any]:
    """What the probe measured; a sweep without an answer fails the latency."""
    p99_ms = statistics.quantiles(latencies_ms, n=100)[98]
    return {
        "scan_to_tf_median_ms": round(statistics.median(latencies_ms), 2),
        "scan_to_tf_p99_ms": round(p99_ms, 2),
        "scan_to_tf_largest_ms": round(max(latencies_ms), 2),
        "sweeps": len(latencies_ms), "sweeps_without_tf": unanswered,
        "cpu_percent": round(cpu_percent, 2),
        "goal": {"scan_to_tf_p99_ms": LATENCY_GOAL_MS, "cpu_percent": CPU_GOAL_PERCENT},
        "met": not unanswered and p99_ms <= LATENCY_GOAL_MS and cpu_percent <= CPU_GOAL_PERCENT,
        "about": "two LiDARs of 720 beams at 25 Hz, frozen map; wall time of this machine, both ways of the loopback "
                 "interface included; the processor's share is of one core",
    }


def sentence(found: Dict[str, Any]) -> str:
    """The figures for a person."""
    median_ms, p99_ms = found["scan_to_tf_median_ms"], found["scan_to_tf_p99_ms"]
    return (f"Sweep to tf: {median_ms:.1f} ms (median), {p99_ms:.1f} ms (99 %), {found['sweeps_without_tf']} of "
            f"{found['sweeps']} without; {found['cpu_percent']:.1f} % of one core: "
            f"{'met' if found['met'] else 'NOT MET'}")
