"""The simulated robot agrees with its URDF."""
# SPDX-License-Identifier: Apache-2.0
import mujoco
import pytest

from mtr_core.errors import ConfigurationError
from mtr_description.robot_geometry import RobotGeometry
from mtr_description.shipped import shipped_urdf
from mtr_simulation.physics.robot import WHEELS, robot_model, shipped_robot
from mtr_simulation.sim import Sim, SimParameters
from mtr_simulation.site.scenario import named_scenario


def robot_with(old, new):
    assert old in shipped_urdf()
    return robot_model(RobotGeometry(shipped_urdf().replace(old, new)))


def test_urdf_itself_loads_in_the_physics_engine():
    model = mujoco.MjModel.from_xml_string(shipped_urdf())
    assert {model.joint(index).name for index in range(model.njnt)} == {"lift", *(f"{name}_wheel" for name in WHEELS)}


def test_shipped_robot_stands_on_its_wheels():
    robot = shipped_robot()
    assert robot.wheel_positions == ((0.131, 0.187795, 0.0345), (0.131, -0.187795, 0.0345),
                                     (-0.131, 0.187795, 0.0345), (-0.131, -0.187795, 0.0345))
    assert robot.base_height_m == 0.0635
    assert robot.base.mass_kg + 4 * robot.wheel.mass_kg == pytest.approx(18.431)


def test_moved_key_is_elsewhere_in_the_simulation():
    sim = Sim(1, named_scenario("open"), robot=robot_with('xyz="0.31 0 0"', 'xyz="0.41 0.05 0"'))
    there = sim.truth().car_from_base.apply(0.35, 0.05)
    assert sim.truth().key_in_car[:2] == pytest.approx(there, abs=0.005)


def test_moved_lidar_sees_from_its_new_place():
    robot = robot_with('xyz="0.12 0 0.2365"', 'xyz="0.22 0 0.2365"')
    ranges = []
    for each in (shipped_robot(), robot):
        sim = Sim(1, named_scenario("lot"), robot=each)
        scan = next(scan for scan in (sim.step().front_scan for _ in range(5)) if scan)
        ranges.append(scan.ranges_m[len(scan.ranges_m) // 2])
    assert ranges[0] - ranges[1] == pytest.approx(0.1, abs=0.05)


def test_rear_lidar_may_be_missing_when_it_is_not_needed():
    geometry = RobotGeometry(shipped_urdf().replace('"rear_lidar"', '"box"'))
    robot = robot_model(geometry, needs_rear_lidar=False)
    assert Sim(1, named_scenario("open"), SimParameters(rear_lidar=False), robot).step().rear_scan is None
    with pytest.raises(ConfigurationError, match="no link rear_lidar"):
        robot_model(geometry)


def test_robot_without_the_mast_s_link_is_refused():
    with pytest.raises(ConfigurationError, match="no link mast"):
        robot_with('"mast"', '"pole"')
