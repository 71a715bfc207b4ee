"""World file of a scenario and a robot, with its triangle files."""
# SPDX-License-Identifier: Apache-2.0
import pathlib
from dataclasses import dataclass, field
from typing import Dict
from xml.etree import ElementTree
from xml.etree.ElementTree import Element

from mtr_core.errors import ConfigurationError
from mtr_description.robot_geometry import RobotGeometry
from mtr_simulation.physics.wheels import BaseParameters
from mtr_simulation.sensors.imu import ImuParameters
from mtr_simulation.sensors.lidar import LidarParameters
from mtr_simulation.sim import GRAVITY_MPS2
from mtr_simulation.site.bodies import bodies_of
from mtr_simulation.site.scenario import Scenario

from .elements import add
from .hulls import stl_of
from .plugin_element import add_base, add_imu, add_lidars, add_lift, add_plugin
from .robot_element import add_robot
from .site_model import add_body, add_ground, hulls_of, mesh_file
from .timing import SensorTiming

SDF_VERSION = "1.6"
STEP_S = 0.001
# Iterations of ODE's solver, as by default in Gazebo.
ITERATIONS = 50
FILE_NAME = "site.world"


@dataclass(frozen=True)
class WorldOptions:
    """Options of a world file.

    Attributes:
        seed: of every random number, including the start pose.
        has_rear_lidar: the rear LiDAR exists.
        real_time_factor: simulated seconds per second; 0: no limit.
        base: limits of the platform.
    """

    seed: int = 1
    has_rear_lidar: bool = True
    real_time_factor: float = 1.0
    base: BaseParameters = field(default_factory=BaseParameters)
    lidar: LidarParameters = field(default_factory=LidarParameters)
    imu: ImuParameters = field(default_factory=ImuParameters)
    timing: SensorTiming = field(default_factory=SensorTiming)


def write_world(folder: pathlib.Path, scenario: Scenario, geometry: RobotGeometry,
                options: WorldOptions) -> pathlib.Path:
    """Write world file and triangle files into a folder, which is created; return the world file's path."""
    folder = folder.resolve()
    for name, text in world_files(folder, scenario, geometry, options).items():
        path = folder / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text, encoding="utf-8")
    return folder / FILE_NAME


def world_files(folder: pathlib.Path, scenario: Scenario, geometry: RobotGeometry,
                options: WorldOptions) -> Dict[str, str]:
    """Return the text of each file by its name in the folder.

    Raises:
        ConfigurationError: Gazebo's world does not support the scenario, or the robot is incomplete.
    """
    _check(scenario)
    meshes = folder / "meshes"
    bodies = bodies_of(scenario)
    root = Element("sdf", version=SDF_VERSION)
    world = add(root, "world", name="site")
    _add_physics(world, options.real_time_factor)
    _add_light(world)
    add_ground(world)
    for body in bodies:
        add_body(world, body, meshes)
    model = add_robot(world, geometry, scenario.start_in_world(options.seed), scenario.friction)
    plugin = add_plugin(model, options.seed, scenario.world_from_car, options.timing)
    add_lidars(plugin, geometry, options.has_rear_lidar, options.lidar, options.timing)
    add_imu(plugin, geometry, options.imu, options.timing)
    add_base(plugin, geometry, options.base, options.timing)
    add_lift(plugin, geometry)
    triangles = {str(mesh_file(meshes, hull).relative_to(folder)): stl_of(hull) for hull in hulls_of(bodies)}
    return {FILE_NAME: ElementTree.tostring(root, encoding="unicode"), **triangles}


def _check(scenario: Scenario) -> None:
    if scenario.person is not None:
        raise ConfigurationError("The scenario has a person; allowed in Gazebo are scenarios without one.")
    for name in ("ground_tilt_rad", "ground_slope_rad"):
        if getattr(scenario, name):
            raise ConfigurationError(f"The scenario's {name} is {getattr(scenario, name):g} rad; allowed in "
                                     "Gazebo is 0 rad, level ground.")
    if scenario.cables:
        raise ConfigurationError("The scenario has cables; allowed in Gazebo are scenarios without any.")


def _add_physics(world: Element, real_time_factor: float) -> None:
    add(world, "gravity", (0.0, 0.0, -GRAVITY_MPS2))
    physics = add(world, "physics", type="ode")
    add(physics, "max_step_size", STEP_S)
    add(physics, "real_time_factor", real_time_factor)
    add(physics, "real_time_update_rate", real_time_factor / STEP_S)
    solver = add(add(physics, "ode"), "solver")
    add(solver, "type", "quick")
    add(solver, "iters", ITERATIONS)
    # Circular friction cone; with ODE's pyramid, a skid-steered robot turns by a third too fast.
    add(solver, "friction_model", "cone_model")


def _add_light(world: Element) -> None:
    light = add(world, "light", type="directional", name="sun")
    add(light, "pose", (0.0, 0.0, 10.0, 0.0, 0.0, 0.0))
    add(light, "diffuse", (0.8, 0.8, 0.8, 1.0))
    add(light, "direction", (-0.4, 0.2, -0.9))
