"""From a stop on the topic to zero on the wheels' topic: the real node at 50 Hz with two LiDARs of 720 beams.

The node runs as a process of its own on the machine's clock, as on the robot: no lock-step. Times are wall time from
publishing the engaged lock to receiving the wheels' command in this process, so that both ways through the loopback
interface are in them; the robot is told to crawl, so that its first command after the stop is zero. The share of the
processor is the node's own processor time (user and system) by the time that passed.
"""
# SPDX-License-Identifier: Apache-2.0
import os
import statistics
import subprocess
import sys
from typing import Any, Dict

from mtr_bringup.stack import free_port

SAMPLES = 400
LIMIT_S = 180


def run(_options: Any) -> Dict[str, object]:
    """stop_latency_p99_ms and drive_control_cpu_percent, measured by a process that may take a ROS name."""
    port = free_port()
    environment = dict(os.environ, ROS_MASTER_URI=f"http://127.0.0.1:{port}", ROS_IP="127.0.0.1")
    master = subprocess.Popen(["rosmaster", "--core", "-p", str(port)], env=environment, stdout=subprocess.DEVNULL,
                              stderr=subprocess.DEVNULL)
    try:
        done = subprocess.run([sys.executable, "-m", f"{__package__}.latency_probe", str(SAMPLES)], env=environment,
                              stdout=subprocess.PIPE, text=True, check=True, timeout=LIMIT_S)
    finally:
        master.terminate()
        master.wait()
    lines = [line.split() for line in done.stdout.splitlines()]
    latencies_ms = [float(words[1]) for words in lines if words[:1] == ["latency_ms"]]
    cpu = [float(words[1]) for words in lines if words[:1] == ["cpu_percent"]]
    return {
        "stop_latency_p99_ms": round(statistics.quantiles(latencies_ms, n=100)[98], 2),
        "stop_latency_median_ms": round(statistics.median(latencies_ms), 2),
        "stop_latency_largest_ms": round(max(latencies_ms), 2),
        "stops": len(latencies_ms),
        "drive_control_cpu_percent": round(cpu[0], 2),
        "clock": "wall time of this machine, both ways of the loopback interface included; the machine was not idle",
    }
