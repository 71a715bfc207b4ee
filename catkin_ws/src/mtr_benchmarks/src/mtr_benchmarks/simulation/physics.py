"""Speed of physics and sensors alone while the robot drives a circle."""
# SPDX-License-Identifier: Apache-2.0
import statistics
import time
from dataclasses import dataclass

from mtr_core.schedule import CLOCK_STEP
from mtr_simulation.sim import Sim
from mtr_simulation.site.scenario import named_scenario

SIMULATED_S = 60.0
TICK_S = CLOCK_STEP.period_ns * 1e-9


@dataclass(frozen=True)
class PhysicsFigures:
    """Speed, and processor time per tick."""

    real_time_factor: float
    tick_median_ms: float
    tick_p99_ms: float


def measure_physics() -> PhysicsFigures:
    """Measure one minute of simulated time."""
    sim = Sim(1, named_scenario("lot"))
    ticks_ms = []
    for _ in range(round(SIMULATED_S / TICK_S)):
        sim.command(0.5, 0.2)
        begun = time.process_time()
        sim.step()
        ticks_ms.append(1e3 * (time.process_time() - begun))
    return PhysicsFigures(SIMULATED_S / (1e-3 * sum(ticks_ms)), statistics.median(ticks_ms),
                          statistics.quantiles(ticks_ms, n=100)[98])
