"""MuJoCo model of one scenario."""
# SPDX-License-Identifier: Apache-2.0
from mtr_core.se2 import Pose2

from ..site.bodies import bodies_of
from ..site.scenario import Scenario
from .mjcf_person import person_bodies
from .mjcf_robot import robot_actuators, robot_body
from .mjcf_site import site_bodies, site_meshes
from .robot import RobotModel


def model_xml(scenario: Scenario, robot: RobotModel, world_from_base: Pose2, timestep_s: float,
              max_wheel_torque_nm: float) -> str:
    """Return MJCF text with bodies car, base_link and their surroundings."""
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
    {person_bodies(scenario.person.figure) if scenario.person else ""}
    {robot_body(robot, world_from_base)}
  </worldbody>
  <actuator>{robot_actuators(max_wheel_torque_nm)}</actuator>
</mujoco>"""
