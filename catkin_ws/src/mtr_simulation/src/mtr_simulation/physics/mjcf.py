"""The MuJoCo model of one scenario."""
# SPDX-License-Identifier: Apache-2.0
from mtr_core.se2 import Pose2

from ..site.bodies import bodies_of
from ..site.scenario import Scenario
from .mjcf_robot import robot_actuators, robot_body
from .mjcf_site import SOLID, site_bodies, site_meshes
from .robot import RobotModel

LEG_LENGTH_M, HIP_HEIGHT_M = 0.82, 0.92


def model_xml(scenario: Scenario, robot: RobotModel, world_from_base: Pose2, timestep_s: float,
              max_wheel_torque_nm: float) -> str:
    """MJCF text with bodies car, base_link and what surrounds them."""
    bodies = bodies_of(scenario)
    return f"""
<mujoco model="mobile_testing_robot">
  <compiler angle="radian" autolimits="true"/>
  <option timestep="{timestep_s}" integrator="Euler" cone="elliptic" impratio="1" solver="Newton" iterations="20"
    tolerance="1e-8"/>
  <size memory="4M"/>
  <asset>{site_meshes(bodies)}</asset>
  <worldbody>
    <light pos="0 0 10" dir="0 0 -1"/>
    <geom name="ground" type="plane" size="60 60 0.1" contype="8" conaffinity="0" rgba=".5 .5 .5 1"/>
    {site_bodies(bodies)}
    {_person() if scenario.person else ""}
    {robot_body(robot, world_from_base)}
  </worldbody>
  <actuator>{robot_actuators(max_wheel_torque_nm)}</actuator>
</mujoco>"""


def _person() -> str:
    """Torso and two legs, moved from outside; a planar LiDAR sees the legs."""
    leg = f'<geom type="capsule" fromto="0 0 0 0 0 -{LEG_LENGTH_M}" size="0.07" {SOLID}/>'
    return (f'<body name="person" mocap="true"><geom type="capsule" fromto="0 0 0.95 0 0 1.45" size="0.18" {SOLID}/>'
            f'<geom type="sphere" pos="0 0 1.68" size="0.12" {SOLID}/></body>'
            f'<body name="left_leg" mocap="true" pos="0 0.1 {HIP_HEIGHT_M}">{leg}</body>'
            f'<body name="right_leg" mocap="true" pos="0 -0.1 {HIP_HEIGHT_M}">{leg}</body>')
