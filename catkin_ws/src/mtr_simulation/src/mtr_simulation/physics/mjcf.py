"""The MuJoCo model of one scenario."""
# SPDX-License-Identifier: Apache-2.0
import math
from typing import Tuple

from mtr_core.se2 import Pose2

from ..site.scenario import Scenario
from ..site.surroundings import Cone, Pole, Wall
from .mjcf_car import SOLID, car_body, car_meshes, parked_car_body
from .mjcf_robot import robot_actuators, robot_body
from .robot import RobotModel

POLE_HEIGHT_M, WALL_HEIGHT_M, CONE_HEIGHT_M = 1.2, 2.0, 0.75
CONE_CORNERS = 16
LEG_LENGTH_M, HIP_HEIGHT_M = 0.82, 0.92


def model_xml(scenario: Scenario, robot: RobotModel, world_from_base: Pose2, timestep_s: float,
              max_wheel_torque_nm: float) -> str:
    """MJCF text with bodies car, base_link and what surrounds them."""
    parked = "".join(parked_car_body(f"parked_{index}", each.shape, each.pose)
                     for index, each in enumerate(scenario.parked_cars))
    return f"""
<mujoco model="mobile_testing_robot">
  <compiler angle="radian" autolimits="true"/>
  <option timestep="{timestep_s}" integrator="Euler" cone="elliptic" impratio="1" solver="Newton" iterations="20"
    tolerance="1e-8"/>
  <size memory="4M"/>
  <asset>{car_meshes("car", scenario.car)}{"".join(map(_cone_mesh, enumerate(scenario.cones)))}</asset>
  <worldbody>
    <light pos="0 0 10" dir="0 0 -1"/>
    <geom name="ground" type="plane" size="60 60 0.1" contype="8" conaffinity="0" rgba=".5 .5 .5 1"/>
    {car_body("car", scenario.car, scenario.world_from_car)}
    {parked}
    {"".join(map(_pole, scenario.poles))}
    {"".join(map(_cone, enumerate(scenario.cones)))}
    {"".join(map(_wall, scenario.walls))}
    {_person() if scenario.person else ""}
    {robot_body(robot, world_from_base)}
  </worldbody>
  <actuator>{robot_actuators(max_wheel_torque_nm)}</actuator>
</mujoco>"""


def _pole(pole: Pole) -> str:
    half = POLE_HEIGHT_M / 2.0
    return f'<geom type="cylinder" pos="{pole.x_m:.4f} {pole.y_m:.4f} {half}" size="{pole.radius_m} {half}" {SOLID}/>'


def _cone_mesh(numbered: Tuple[int, Cone]) -> str:
    index, cone = numbered
    angles = [2.0 * math.pi * corner / CONE_CORNERS for corner in range(CONE_CORNERS)]
    vertices = " ".join(f"{radius * math.cos(angle):.4f} {radius * math.sin(angle):.4f} {z:.4f}"
                        for z, radius in ((0.0, cone.foot_radius_m), (CONE_HEIGHT_M, cone.top_radius_m))
                        for angle in angles)
    return f'<mesh name="cone_{index}" vertex="{vertices}"/>'


def _cone(numbered: Tuple[int, Cone]) -> str:
    index, cone = numbered
    return f'<geom type="mesh" mesh="cone_{index}" pos="{cone.x_m:.4f} {cone.y_m:.4f} 0" {SOLID}/>'


def _wall(wall: Wall) -> str:
    half, pose = WALL_HEIGHT_M / 2.0, wall.pose
    return (f'<geom type="box" pos="{pose.x:.4f} {pose.y:.4f} {half}" euler="0 0 {pose.heading:.6f}" '
            f'size="{wall.length_m / 2.0} {wall.thickness_m / 2.0} {half}" {SOLID}/>')


def _person() -> str:
    """Torso and two legs, moved from outside; a planar LiDAR sees the legs."""
    leg = f'<geom type="capsule" fromto="0 0 0 0 0 -{LEG_LENGTH_M}" size="0.07" {SOLID}/>'
    return (f'<body name="person" mocap="true"><geom type="capsule" fromto="0 0 0.95 0 0 1.45" size="0.18" {SOLID}/>'
            f'<geom type="sphere" pos="0 0 1.68" size="0.12" {SOLID}/></body>'
            f'<body name="left_leg" mocap="true" pos="0 0.1 {HIP_HEIGHT_M}">{leg}</body>'
            f'<body name="right_leg" mocap="true" pos="0 -0.1 {HIP_HEIGHT_M}">{leg}</body>')
