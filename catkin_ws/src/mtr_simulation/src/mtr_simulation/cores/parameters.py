"""With what sim.launch starts the nodes, read from the same files; test_sim_cores.py compares the two."""
# SPDX-License-Identifier: Apache-2.0
import functools
import pathlib
from dataclasses import dataclass
from typing import Type, TypeVar

import rospkg
import yaml

from mtr_car_locator.parameters import LocatorParameters
from mtr_core.parameters import ParameterSet, parameters_from
from mtr_dispatcher.parameters import Parameters as DispatcherParameters
from mtr_motion_planner.parameters import MotionParameters
from mtr_peripherals.parameters import Parameters as PeripheralsParameters
from mtr_state_machine.parameters import Parameters as StateMachineParameters

P = TypeVar("P", bound=ParameterSet)


@dataclass(frozen=True)
class RobotParameters:
    """Of the nodes; drive control and localization run on their defaults."""

    dispatcher: DispatcherParameters
    state_machine: StateMachineParameters
    car_locator: LocatorParameters
    motion_planner: MotionParameters
    peripherals: PeripheralsParameters


@functools.lru_cache(maxsize=None)
def simulated_robot() -> RobotParameters:
    """As sim.launch has them unless it is told otherwise."""
    return RobotParameters(
        DispatcherParameters(lockstep_operator=True, warn_without_emergency_stop=False, simulated=True),
        StateMachineParameters(resume_by_operator=False, signal_s=0.0),
        _in_file("mtr_car_locator", "unknown_car.yaml", LocatorParameters),
        MotionParameters(accept_nav_goal=True),
        _in_file("mtr_peripherals", "calibration.yaml", PeripheralsParameters))


def _in_file(package: str, name: str, kind: Type[P]) -> P:
    path = pathlib.Path(rospkg.RosPack().get_path(package)) / "config" / name
    return parameters_from(yaml.safe_load(path.read_text(encoding="utf-8")), kind)
