"""Slopes, slippery ground and cables: their effects on accelerometer, wheels and body."""
# SPDX-License-Identifier: Apache-2.0
import dataclasses
import math
import statistics

import pytest

from mtr_core.se2 import Pose2
from mtr_simulation.physics.robot import shipped_robot
from mtr_simulation.sensors.imu import ImuParameters
from mtr_simulation.sim import GRAVITY_MPS2, TICK_S, Sim, SimParameters
from mtr_simulation.site.cables import Cable, Cables
from mtr_simulation.site.scenario import Scenario
from mtr_simulation.site.scenario_file import scenario_from

ROBOT = shipped_robot()
NO_NOISE = SimParameters(imu=ImuParameters(0.0, 0.0, 0.0, 0.0, 0.0, 0.0))
FIELD = Scenario(world_from_car=Pose2(60.0, 0.0, 0.0), start_in_car=Pose2(-60.0, 0.0, 0.0), start_offset_m=0.0,
                 start_offset_rad=0.0)
AHEAD, LEFT, BEHIND = 0.0, math.pi / 2.0, math.pi


def on_slope(degrees, downhill_rad, **changed):
    """Simulation of the robot on a slope, with its x axis along the x axis of world."""
    site = dataclasses.replace(FIELD, ground_slope_rad=math.radians(degrees), ground_slope_direction_rad=downhill_rad,
                               **changed)
    sim = Sim(1, site, NO_NOISE)
    sim.scans_wanted = False
    return sim


def drive(sim, linear_mps, duration_s):
    """Sensors at each tick under a constant command."""
    seen = []
    for _ in range(round(duration_s / TICK_S)):
        sim.command(linear_mps, 0.0)
        seen.append(sim.step())
    return seen


def mean_force(sensors):
    return [statistics.mean(each.imu.acceleration[axis] for each in sensors) for axis in range(3)]


@pytest.mark.parametrize("downhill_rad, axis, sign", [(AHEAD, 0, -1.0), (BEHIND, 0, 1.0), (LEFT, 1, -1.0)])
def test_accelerometer_at_rest_shows_the_slope(downhill_rad, axis, sign):
    sim = on_slope(4.0, downhill_rad)
    force = mean_force(drive(sim, 0.0, 1.0))
    assert force[axis] == pytest.approx(sign * GRAVITY_MPS2 * math.sin(math.radians(4.0)), abs=0.06)
    assert math.sqrt(sum(each * each for each in force)) == pytest.approx(GRAVITY_MPS2, abs=0.01)
    assert math.degrees(sim.truth().tilt_rad) == pytest.approx(4.0, abs=0.35)
    assert mean_force([sim.stand()])[axis] == pytest.approx(force[axis], abs=0.01)


def test_level_ground_is_a_gravity_straight_down():
    assert FIELD.gravity(GRAVITY_MPS2) == (0.0, 0.0, -GRAVITY_MPS2)
    force = mean_force(drive(on_slope(0.0, AHEAD), 0.0, 0.5))
    assert force[2] == pytest.approx(GRAVITY_MPS2, abs=1e-3) and abs(force[0]) < 0.06


@pytest.mark.parametrize("lift_m", [0.0, ROBOT.key.lift_travel_m])
def test_wheels_downhill_carry_more_by_the_height_of_the_centre_of_mass(lift_m):
    def front_share(degrees):
        sim = on_slope(degrees, AHEAD)
        sim.set_lift(lift_m)
        drive(sim, 0.0, 3.0)
        loads = sim.wheel_loads_n()
        return (loads[0] + loads[1]) / sum(loads)
    height_m = 0.2665 + 0.0345 * (ROBOT.key.min_height_m + lift_m)
    expected = height_m * math.tan(math.radians(4.0)) / (2.0 * ROBOT.half_wheelbase_m)
    assert front_share(4.0) - front_share(0.0) == pytest.approx(expected, rel=0.15)


def test_robot_at_rest_keeps_its_place_on_a_slope_and_slides_where_friction_is_too_small():
    for friction, slides in ((0.5, False), (0.1, True)):
        sim = on_slope(8.0, AHEAD, friction=friction)
        before = sim.truth().world_from_base
        drive(sim, 0.0, 2.0)
        assert (sim.truth().world_from_base.x - before.x > 0.05) is slides


def test_stop_on_ice_is_longer_and_longer_still_downhill():
    def stop_m(degrees, friction):
        sim = on_slope(degrees, AHEAD, friction=friction)
        drive(sim, 0.6, 2.5)
        before = sim.truth().world_from_base.x
        drive(sim, 0.0, 3.0)
        return sim.truth().world_from_base.x - before
    level, ice, icy_slope = stop_m(0.0, 0.5), stop_m(0.0, 0.1), stop_m(3.0, 0.1)
    assert level < 0.15 < ice < icy_slope


def test_wheel_rises_over_a_cable_by_its_diameter_as_a_circle_over_a_circle():
    cables = Cables([Cable(Pose2(2.0, 0.0, math.pi / 2.0))], 0.098)
    assert cables.at(2.0, 0.5)[0] == pytest.approx(0.015)
    assert cables.at(2.0 + 0.054, 0.0)[0] == pytest.approx(0.0, abs=2e-4)
    assert cables.at(2.06, 0.0) == cables.at(2.0, 2.1) == (0.0, 0.0, 0.0)
    ahead = cables.at(1.98, 0.0)
    assert ahead[1] == pytest.approx((cables.at(1.981, 0.0)[0] - cables.at(1.979, 0.0)[0]) / 0.002, rel=1e-3)
    assert ahead[1] > 0.1 and abs(ahead[2]) < 1e-9


def test_oblique_cable_rises_across_itself():
    cables = Cables([Cable(Pose2(1.0, 2.0, 0.4))], 0.098)
    x, y, step = 1.01, 2.02, 1e-5
    height, along_x, along_y = cables.at(x, y)
    assert 0.0 < height < 0.015
    assert along_x == pytest.approx((cables.at(x + step, y)[0] - height) / step, abs=1e-3)
    assert along_y == pytest.approx((cables.at(x, y + step)[0] - height) / step, abs=1e-3)


@pytest.mark.parametrize("speed_mps", [0.2, 0.7])
def test_robot_drives_over_a_cable_and_is_level_again(speed_mps):
    sim = on_slope(0.0, AHEAD, cables=(Cable(Pose2(0.6, 0.0, math.pi / 2.0)),))
    largest = 0.0
    for _ in range(round(1.5 / speed_mps / TICK_S)):
        sim.command(speed_mps, 0.0)
        sim.step()
        largest = max(largest, sim.truth().tilt_rad)
    assert 1.0 < math.degrees(largest) < 6.0
    drive(sim, 0.0, 1.0)
    assert sim.truth().world_from_base.x > 1.2 and math.degrees(sim.truth().tilt_rad) < 0.5


def test_slope_and_cables_come_from_a_file():
    site = scenario_from({"ground_slope_rad": 0.05, "ground_slope_direction_rad": 1.0,
                          "cables": [[1.0, 2.0, 90.0], [0.0, 0.0, 0.0, 0.02, 1.0]]})
    assert (site.ground_slope_rad, site.ground_slope_direction_rad) == (0.05, 1.0)
    assert site.cables == (Cable(Pose2(1.0, 2.0, math.pi / 2.0)), Cable(Pose2(0.0, 0.0, 0.0), 0.02, 1.0))
