"""Speed of physics and sensors alone while the robot drives a circle."""
# SPDX-License-Identifier: Apache-2.0
import statistics
import time
from typing import Dict

from mtr_core.schedule import CLOCK_STEP
from mtr_simulation.scenario import named_scenario
from mtr_simulation.sim import Sim

SIMULATED_S = 60.0
TICK_S = CLOCK_STEP.period_ns * 1e-9


def figures() -> Dict[str, float]:
    """Times in ms of CPU for a tick of 20 ms."""
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


def sentence(measured: Dict[str, float]) -> str:
    """The figures for a person."""
    return f"Physics and both LiDARs: {measured['real_time_factor']:.1f} x real time."
