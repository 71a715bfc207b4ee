"""Sites and grounds: positions of objects, tilt of the robot on uneven ground, and a displaced robot."""
# SPDX-License-Identifier: Apache-2.0
import dataclasses
import math

import numpy as np
import pytest

from mtr_core.se2 import Pose2
from mtr_simulation.sensors.imu import ImuParameters
from mtr_simulation.sensors.lidar import LidarParameters
from mtr_simulation.sim import Sim, SimParameters
from mtr_simulation.site.scenario import SCENARIOS, Scenario, named_scenario
from mtr_simulation.site.surroundings import uneven_ground

NO_NOISE = SimParameters(lidar=LidarParameters(noise_m=0.0), imu=ImuParameters(0.0, 0.0, 0.0, 0.0, 0.0, 0.0))


def returns_from_the_car_s_centre(name):
    """Finite ranges above 8 m at the site's start pose, i.e. of objects other than the Car."""
    sim = Sim(1, named_scenario(name), NO_NOISE)
    sim.step()
    sensors = sim.step()
    ranges = np.concatenate([sensors.front_scan.ranges_m, sensors.rear_scan.ranges_m])
    return ranges[np.isfinite(ranges) & (ranges > 8.0)]


def test_open_site_has_nothing_but_the_car():
    assert len(returns_from_the_car_s_centre("open")) == 0


def test_far_site_has_something_but_only_beyond_the_radials():
    seen = returns_from_the_car_s_centre("far")
    assert len(seen) > 50
    assert seen.min() > 14.0


def test_cones_are_seen_as_a_few_beams_each():
    seen = returns_from_the_car_s_centre("cones")
    assert 4 <= len(seen) <= 60
    assert len(named_scenario("cones").cones) == 4


@pytest.mark.parametrize("name", sorted(SCENARIOS))
def test_nothing_is_in_the_way_round_the_car(name):
    site = named_scenario(name)
    centre = site.world_from_car
    things = [(each.x_m, each.y_m) for each in (*site.poles, *site.cones)] + [
        (each.pose.x, each.pose.y) for each in site.parked_cars]
    assert all(math.hypot(x - centre.x, y - centre.y) > 7.0 for x, y in things)


@pytest.mark.parametrize("tilt_deg", [0.5, 1.0])
def test_uneven_ground_has_the_slope_that_is_asked_for(tilt_deg):
    ground = uneven_ground(3, math.radians(tilt_deg))
    places = np.random.default_rng(1).uniform(-40.0, 40.0, (4000, 2))
    step = 0.01
    slopes = [math.hypot(ground.height_m(x + step, y) - ground.height_m(x, y),
                         ground.height_m(x, y + step) - ground.height_m(x, y)) / step for x, y in places]
    assert math.degrees(math.sqrt(np.mean(np.square(slopes)))) == pytest.approx(tilt_deg, rel=0.1)


def test_robot_on_uneven_ground_tilts_as_the_ground_does():
    site = Scenario(ground_tilt_rad=math.radians(1.0), start_in_car=Pose2(12.0, 0.0, 0.0), start_offset_m=0.0)
    sim = Sim(3, site, NO_NOISE)
    pose = sim.truth().world_from_base
    ground, step = uneven_ground(3, site.ground_tilt_rad), 0.05
    slope = math.hypot(*((ground.height_m(pose.x + dx, pose.y + dy) - ground.height_m(pose.x - dx, pose.y - dy))
                         / (2.0 * step) for dx, dy in ((step, 0.0), (0.0, step))))
    assert sim.truth().tilt_rad == pytest.approx(slope, rel=0.2)


def test_gyro_with_a_scale_error_says_too_much():
    imu = dataclasses.replace(NO_NOISE.imu, gyro_scale_error=0.02)
    sim = Sim(1, Scenario(start_in_car=Pose2(12.0, 0.0, 0.0)), dataclasses.replace(NO_NOISE, imu=imu))
    for _ in range(100):
        sim.command(0.0, 0.8)
        reading = sim.step().imu
    assert reading.angular_velocity[2] / sim.truth().angular_radps == pytest.approx(1.02, abs=1e-3)


def test_kidnapped_robot_stands_elsewhere_and_its_wheels_have_not_turned():
    sim = Sim(1, Scenario(start_in_car=Pose2(10.0, 0.0, 0.0)), NO_NOISE)
    before = sim.step().odometry
    there = sim.truth().world_from_base @ Pose2(0.0, 2.0, 0.5)
    sim.kidnap(there)
    for _ in range(50):
        after = sim.step().odometry
    now = sim.truth().world_from_base
    assert now.distance_to(there) < 0.01
    assert now.heading == pytest.approx(there.heading, abs=0.01)
    assert (after.x_m, after.y_m) == pytest.approx((before.x_m, before.y_m), abs=0.002)
