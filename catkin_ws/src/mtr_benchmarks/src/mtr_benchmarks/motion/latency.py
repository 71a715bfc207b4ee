"""Measures the time from a stop to a zero wheel command of the real node, at 50 Hz with two LiDARs of 720 beams.

The node runs in its own process on the machine's clock without lock-step, as on the robot. The latency is the wall time
from publishing the engaged lock to receiving the wheel command in this process. It includes both directions of the
loopback interface. The robot crawls, so that its first command after the stop is zero. The processor share is the
node's own processor time (user and system) divided by the elapsed time.
"""
# SPDX-License-Identifier: Apache-2.0
import statistics
from dataclasses import dataclass
from typing import List

from ..harness.probe import run_probe
from ..harness.rows import Requirement, Row
from .options import MotionOptions

SAMPLES = 400
LIMIT_S = 180.0
CLOCK = "wall time of this machine, both ways of the loopback interface included; the machine was not idle"
LATENCY = Requirement("from a stop to zero, 99 %", "ms", must=20.0)
CPU = Requirement("drive control's share of one core", "%", must=5.0)


@dataclass(frozen=True)
class LatencyFigures:
    """Figures of the latency; the names are those in the file."""

    stop_latency_p99_ms: float
    stop_latency_median_ms: float
    stop_latency_largest_ms: float
    stops: int
    drive_control_cpu_percent: float
    clock: str = CLOCK

    def rows(self) -> List[Row]:
        """Return the rows of latency and load."""
        return [Row(LATENCY, self.stop_latency_p99_ms, remark=f"median {self.stop_latency_median_ms:.2f} ms"),
                Row(CPU, self.drive_control_cpu_percent)]


def measure(_options: MotionOptions) -> LatencyFigures:
    """Measure with a probe process, which has its own ROS name."""
    found = run_probe(f"{__package__}.latency_probe", [str(SAMPLES)], LIMIT_S)
    latencies_ms, cpu_percent = found["latency_ms"], found["cpu_percent"][0]
    return LatencyFigures(
        round(statistics.quantiles(latencies_ms, n=100)[98], 2), round(statistics.median(latencies_ms), 2),
        round(max(latencies_ms), 2), len(latencies_ms), round(cpu_percent, 2))
