"""Measures an Autolock on the virtual bus and recomputes its distances from the recording."""
# SPDX-License-Identifier: Apache-2.0
import pathlib
from dataclasses import dataclass

from mtr_operator.car_link.profile import load_profile
from mtr_operator.car_link.spoken_car import SpokenCar
from mtr_operator.domain.actions.control_loop import ControlLoop
from mtr_operator.domain.exchange.run_context import RunContext
from mtr_operator.domain.results.progress import Progress
from mtr_operator.domain.runner import Runner
from mtr_operator.domain.scenarios import SCENARIOS
from mtr_operator.replay.replay import replay
from mtr_operator.robot_link.fake import FakeRobotLink
from mtr_operator.storage.recorded.recording import Recording

_PROFILE, _SCENARIO = "mtr_honest_car", "autolock"
_PARAMETERS = {"passes": 1, "measurements_distance_m": 5.0, "self_check": False, "maximum_distance_m": 3.5}


@dataclass(frozen=True)
class Replayed:
    """Comparison of measured and recomputed distances.

    Attributes:
        worst_m: largest difference of a distance that both have; infinite if the outcome of a line differs.
        distances: number of recomputed distances.
    """

    worst_m: float
    distances: int


def replayed_autolock(folder: pathlib.Path) -> Replayed:
    """Measure with a recording in the folder, replay it, and compare."""
    scenario = SCENARIOS[_SCENARIO]
    kind = scenario.parameters_type
    parameters = kind.from_mapping({**kind.proposed(), **_PARAMETERS})
    progress = Progress(_SCENARIO, parameters.to_mapping())
    spoken = SpokenCar(FakeRobotLink(1), "bench-can replay", profile=_PROFILE)
    recording = Recording(folder / "progress.json")
    try:
        spoken.connect()
        spoken.car.connect()
        loop = ControlLoop(spoken, spoken.car, context=RunContext(course=recording.begin(spoken.car)))
        Runner(scenario, parameters, loop, progress, lambda _: None).run()
    finally:
        recording.end()
        spoken.car.close()
        spoken.close()
    found = replay(scenario, parameters, progress, folder / "recording", load_profile(_PROFILE))
    distances = [each for result in found.now for each in result.distances if each.distance_m is not None]
    return Replayed(float("inf") if found.changed_lines else found.worst_m, len(distances))
