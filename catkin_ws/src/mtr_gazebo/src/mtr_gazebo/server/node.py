"""Program that writes the world of the loaded robot and becomes Gazebo's server, whose plugin is the ROS node."""
# SPDX-License-Identifier: Apache-2.0
import os
import pathlib
import sys
from typing import Dict, List, Tuple

import rospy

from mtr_core.errors import RobotError
from mtr_core.parameters import described, parameters_from
from mtr_description.base_controller import CONTROLLER, base_controller_of
from mtr_description.robot_description import described_robot
from mtr_gazebo.server.environment import server_command, server_environment
from mtr_gazebo.server.parameters import ServerParameters
from mtr_gazebo.world.world_file import WorldOptions, write_world
from mtr_simulation.physics.wheels import parameters_of
from mtr_simulation.site.scenario_file import chosen_scenario

# Node name of the plugin.
NODE = "/gazebo"
CANNOT_START = 2


def main() -> int:
    """Become the server; return the exit status if that fails."""
    try:
        parameters = parameters_from(rospy.get_param(NODE, {}), ServerParameters)
        print(f"Parameters: {described(parameters)}", flush=True)
        words, environment = prepared(parameters)
    except RobotError as error:
        print(f"The node gazebo cannot start. {error}", file=sys.stderr)
        return CANNOT_START
    os.execvpe(words[0], words, environment)


def prepared(parameters: ServerParameters) -> Tuple[List[str], Dict[str, str]]:
    """Write the world; return command and environment of the server."""
    controller = f"/{CONTROLLER}"
    base = parameters_of(base_controller_of(rospy.get_param(controller, {}), controller))
    options = WorldOptions(parameters.seed, parameters.rear_lidar, parameters.real_time_factor, base)
    world = write_world(pathlib.Path(parameters.world_folder), chosen_scenario(parameters.scenario), described_robot(),
                        options)
    return server_command(parameters.command, world), server_environment(os.environ)
