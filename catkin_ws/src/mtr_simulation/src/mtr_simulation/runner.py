"""Runs the simulated robot with a controller in this process, without ROS, for tests and campaigns."""
# SPDX-License-Identifier: Apache-2.0
import hashlib
from typing import List, NamedTuple, Protocol, Tuple

from .sensors.readings import Sensors
from .sim import TICK_S, Sim
from .true_state import TrueState


class Controller(Protocol):
    """Controller that drives the robot."""

    def update(self, sensors: Sensors) -> Tuple[float, float]:
        """Return the velocity command (m/s, rad/s) for the sensor readings."""


class Run(NamedTuple):
    """Result of a run: SHA-256 of all sensor readings, and the true state at each tick."""

    digest: str
    truth: List[TrueState]


def run(sim: Sim, controller: Controller, duration_s: float) -> Run:
    """Let the controller drive for a time; each command takes effect in the next tick."""
    digest, truth = hashlib.sha256(), []
    for _ in range(round(duration_s / TICK_S)):
        sensors = sim.step()
        digest.update(sensors.to_bytes())
        truth.append(sim.truth())
        sim.command(*controller.update(sensors))
    return Run(digest.hexdigest(), truth)
