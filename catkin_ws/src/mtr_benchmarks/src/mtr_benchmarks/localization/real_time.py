"""Localization's node on the machine's clock, fed with a recorded drive at its own pace: latency and load.

The node runs as a process of its own, without lock-step, as on the robot. Latency is wall time from publishing a sweep
to receiving `map` → `odom` with the time of that sweep, so that both ways through the loopback interface are in it.
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

# Both LiDARs with 720 beams at 25 Hz.
DRIVE = DriveOptions(scene="lot", car="hatchback", rear=True)
MEASURED_S = 40.0
LIMIT_S = 300.0
# Of the figures in the file.
DECIMALS = 2
MAX_LATENCY_MS, MAX_CPU_PERCENT = 15.0, 10.0
LATENCY = Requirement("sweep to tf, 99 %", "ms", must=MAX_LATENCY_MS)
UNANSWERED = Requirement("sweeps without tf", "(count)", must=0.0)
CPU = Requirement("localization's share of one core", "%", must=MAX_CPU_PERCENT)
ABOUT = ("two LiDARs of 720 beams at 25 Hz, frozen map; wall time of this machine, both ways of the loopback interface "
         "included; the processor's share is of one core")


@dataclass(frozen=True)
class RealTimeFigures:
    """What the probe measured; names are those of the file."""

    scan_to_tf_median_ms: float
    scan_to_tf_p99_ms: float
    scan_to_tf_largest_ms: float
    sweeps: int
    sweeps_without_tf: int
    cpu_percent: float

    def rows(self) -> List[Row]:
        """A sweep without an answer fails a row of its own."""
        return [Row(LATENCY, self.scan_to_tf_p99_ms, remark=f"median {self.scan_to_tf_median_ms:.2f} ms"),
                Row(UNANSWERED, self.sweeps_without_tf, remark=f"of {self.sweeps}"), Row(CPU, self.cpu_percent)]

    def as_json(self) -> Dict[str, Any]:
        """The figures, their limits and whether all are met."""
        values = {name: round(value, DECIMALS) for name, value in asdict(self).items()}
        return {**values, "goal": {"scan_to_tf_p99_ms": MAX_LATENCY_MS, "cpu_percent": MAX_CPU_PERCENT},
                "met": all_met(self.rows()), "about": ABOUT}


def measure_real_time() -> RealTimeFigures:
    """Latency and share of one core while the robot drives on the frozen map."""
    with tempfile.TemporaryDirectory(prefix="mtr_bench_") as folder:
        record(DRIVE, pathlib.Path(folder))
        found = run_probe(f"{__package__}.real_time_probe", [str(pathlib.Path(folder) / BAG), str(MEASURED_S)], LIMIT_S)
    return figures(found["latency_ms"], int(found["unanswered"][0]), found["cpu_percent"][0])


def figures(latencies_ms: List[float], unanswered: int, cpu_percent: float) -> RealTimeFigures:
    """Figures of what the probe printed."""
    return RealTimeFigures(statistics.median(latencies_ms), statistics.quantiles(latencies_ms, n=100)[98],
                           max(latencies_ms), len(latencies_ms), unanswered, cpu_percent)
