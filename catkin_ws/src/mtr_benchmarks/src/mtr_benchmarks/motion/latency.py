"""From a stop on the topic to zero on the wheels' topic: the real node at 50 Hz with two LiDARs of 720 beams.

The node runs as a process of its own on the machine's clock, as on the robot: no lock-step. Times are wall time from
publishing the engaged lock to receiving the wheels' command in this process, so that both ways through the loopback
interface are in them; the robot is told to crawl, so that its first command after the stop is zero. The share of the
processor is the node's own processor time (user and system) by the time that passed.
"""
# SPDX-License-Identifier: Apache-2.0
import statistics
from typing import Any, Dict

from mtr_benchmarks.components.probe import run_probe

SAMPLES = 400
LIMIT_S = 180.0


def run(_options: Any) -> Dict[str, object]:
    """stop_latency_p99_ms and drive_control_cpu_percent, measured by a process that may take a ROS name."""
    found = run_probe(f"{__package__}.latency_probe", [str(SAMPLES)], LIMIT_S)
    latencies_ms, cpu_percent = found["latency_ms"], found["cpu_percent"][0]
    return {
        "stop_latency_p99_ms": round(statistics.quantiles(latencies_ms, n=100)[98], 2),
        "stop_latency_median_ms": round(statistics.median(latencies_ms), 2),
        "stop_latency_largest_ms": round(max(latencies_ms), 2),
        "stops": len(latencies_ms),
        "drive_control_cpu_percent": round(cpu_percent, 2),
        "clock": "wall time of this machine, both ways of the loopback interface included; the machine was not idle",
    }
