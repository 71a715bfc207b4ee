"""Measures latency and load of the localization node on the machine's clock, with a recorded drive at its own pace.

The node runs in its own process without lock-step, as on the robot. Latency is the wall time from publishing a sweep to
receiving `map` → `odom` with the time of that sweep. It includes both directions of the loopback interface.
"""
# SPDX-License-Identifier: Apache-2.0
import pathlib
import statistics
import tempfile
from dataclasses import asdict, dataclass
from typing import Any, Dict, List

from ..harness.probe import run_probe
from ..harness.rows import Requirement, Row, all_met
from .drives.options import DriveOptions
from .drives.record import record
from .drives.recording import BAG

# Two LiDARs with 720 beams at 25 Hz.
DRIVE = DriveOptions(scene="lot", car="hatchback", rear=True)
MEASURED_S = 40.0
LIMIT_S = 300.0
# Decimals of the figures in the file.
DECIMALS = 2
MAX_LATENCY_MS, MAX_CPU_PERCENT = 15.0, 10.0
LATENCY = Requirement("sweep to tf, 99 %", "ms", must=MAX_LATENCY_MS)
UNANSWERED = Requirement("sweeps without tf", "(count)", must=0.0)
CPU = Requirement("localization's share of one core", "%", must=MAX_CPU_PERCENT)
ABOUT = ("two LiDARs of 720 beams at 25 Hz, frozen map; wall time of this machine, both ways of the loopback interface "
         "included; the processor's share is of one core")


@dataclass(frozen=True)
class RealTimeFigures:
    """Figures of the probe; the names are those in the file."""

    scan_to_tf_median_ms: float
    scan_to_tf_p99_ms: float
    scan_to_tf_largest_ms: float
    sweeps: int
    sweeps_without_tf: int
    cpu_percent: float

    def rows(self) -> List[Row]:
        """Return the rows; a sweep without an answer fails its own row."""
        return [Row(LATENCY, self.scan_to_tf_p99_ms, remark=f"median {self.scan_to_tf_median_ms:.2f} ms"),
                Row(UNANSWERED, self.sweeps_without_tf, remark=f"of {self.sweeps}"), Row(CPU, self.cpu_percent)]

    def as_json(self) -> Dict[str, Any]:
        """Return the figures, their limits, and whether all are met."""
        values = {name: round(value, DECIMALS) for name, value in asdict(self).items()}
        return {**values, "goal": {"scan_to_tf_p99_ms": MAX_LATENCY_MS, "cpu_percent": MAX_CPU_PERCENT},
                "met": all_met(self.rows()), "about": ABOUT}


def measure_real_time() -> RealTimeFigures:
    """Measure latency and share of one core while the robot drives on the frozen map."""
    with tempfile.TemporaryDirectory(prefix="mtr_bench_") as folder:
        record(DRIVE, pathlib.Path(folder))
        found = run_probe(f"{__package__}.real_time_probe", [str(pathlib.Path(folder) / BAG), str(MEASURED_S)], LIMIT_S)
    return figures(found["latency_ms"], int(found["unanswered"][0]), found["cpu_percent"][0])


def figures(latencies_ms: List[float], unanswered: int, cpu_percent: float) -> RealTimeFigures:
    """Return the figures from the numbers that the probe printed."""
    return RealTimeFigures(statistics.median(latencies_ms), statistics.quantiles(latencies_ms, n=100)[98],
                           max(latencies_ms), len(latencies_ms), unanswered, cpu_percent)
