"""Parameters of the program that starts Gazebo's server."""
# SPDX-License-Identifier: Apache-2.0
from dataclasses import dataclass

from mtr_core.parameters import ParameterSet, number
from mtr_simulation.site.scenario_file import chosen_scenario


@dataclass(frozen=True)
class ServerParameters(ParameterSet):
    """Attributes:
        seed: of every random number.
        scenario: name of a test site, or path of a site's YAML file.
        rear_lidar: the rear LiDAR exists.
        real_time_factor: largest number of simulated seconds per second; 0: no limit.
        world_folder: of the world file; existing files are overwritten.
        command: command of Gazebo's server, to which the world file is appended.
    """

    seed: int = number(1, 0, 2**31 - 1)
    scenario: str = "lot"
    rear_lidar: bool = True
    real_time_factor: float = number(1.0, 0.0, 100.0)
    world_folder: str = "gazebo_world"
    command: str = "gzserver --verbose"

    def __post_init__(self) -> None:
        super().__post_init__()
        chosen_scenario(self.scenario)
