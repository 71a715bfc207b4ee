"""The outline of each car shape matches its parameters and the LiDAR's measurements in its plane."""
# SPDX-License-Identifier: Apache-2.0
import math

import numpy as np
import pytest

from mtr_core.se2 import Pose2
from mtr_simulation.physics.robot import shipped_robot
from mtr_simulation.sensors.lidar import LidarParameters
from mtr_simulation.sim import Sim, SimParameters
from mtr_simulation.site.car_shape import CAR_SHAPES, CarShape, size_at
from mtr_simulation.site.scenario import Scenario

ROBOT = shipped_robot()
# Poses diagonally outside the four corners and facing the Car's centre: each sees one end and one side.
CORNERS = [Pose2(x, y, math.atan2(-y, -x)) for x, y in ((4.2, 2.8), (-4.2, 2.8), (-4.2, -2.8), (4.2, -2.8))]


def seen_from(shape, height_m, start):
    """Returns in frame car from one robot pose, without noise."""
    scenario = Scenario(car=shape, start_in_car=start, start_offset_m=0.0, start_offset_rad=0.0)
    lidar = LidarParameters(noise_m=0.0, height_m=height_m)
    sim = Sim(1, scenario, SimParameters(rear_lidar=False, lidar=lidar))
    sim.step()
    scan = sim.step().front_scan
    base = sim.truth().car_from_base
    angles = base.heading + scan.angle_min_rad + scan.angle_increment_rad * np.arange(len(scan.ranges_m))
    near = scan.ranges_m < 8.0
    x, y = base.apply(ROBOT.front_lidar.x_m, 0.0)
    return np.stack([x + scan.ranges_m[near] * np.cos(angles[near]),
                     y + scan.ranges_m[near] * np.sin(angles[near])], axis=1)


# The undercut bumpers lie at the LiDARs' height behind the sills or, with higher sills, behind the tyres.
SHAPES = {**CAR_SHAPES, "undercut": CarShape(clearance_m=0.15, undercut_m=0.08),
          "undercut, high sills": CarShape(clearance_m=0.15, undercut_m=0.08, sill_rise_m=0.12)}


@pytest.mark.parametrize("height_m", [0.2, 0.3])
@pytest.mark.parametrize("name", sorted(SHAPES))
def test_size_in_the_lidar_s_plane_is_what_a_lidar_sees_from_all_corners(name, height_m):
    shape = SHAPES[name]
    points = np.concatenate([seen_from(shape, height_m, corner) for corner in CORNERS])
    length, width = np.ptp(points, axis=0)
    expected = size_at(shape, height_m)
    # Beams are a few millimetres to a few centimetres apart and so miss the outermost point of a tip or tread.
    assert length == pytest.approx(expected.length_m, abs=0.03)
    assert width == pytest.approx(expected.width_m, abs=0.01)


@pytest.mark.parametrize(("name", "height_m", "only_wheels"), [
    ("hatchback", 0.2, False), ("hatchback", 0.3, False), ("sedan", 0.2, True), ("sedan", 0.3, False),
    ("van", 0.2, True), ("van", 0.3, False), ("suv", 0.3, True)])
def test_lidar_below_the_body_meets_only_wheels(name, height_m, only_wheels):
    assert size_at(CAR_SHAPES[name], height_m).only_wheels is only_wheels


def test_lidar_between_bumper_and_sill_sees_the_bumpers_but_no_sill():
    van = CAR_SHAPES["van"]
    points = seen_from(van, 0.3, CORNERS[0])
    beside = points[(np.abs(points[:, 0]) < 0.8) & (points[:, 1] > 0.5)]
    assert len(beside) == 0
    assert points[:, 0].max() == pytest.approx(0.5 * van.length_m, abs=0.02)


def test_undercut_bumper_stands_back_below_and_reaches_its_tip_above():
    shape = CarShape(clearance_m=0.18, undercut_m=0.04)
    tips = [max(x for x, _ in shape.bumper_plan(1.0, height)) for height in (0.18, 0.23, 0.28, 0.6)]
    assert tips == pytest.approx([2.21, 2.23, 2.25, 2.25])


def test_bumper_is_mirrored_and_bows_to_its_tip():
    plan = CarShape().bumper_plan(1.0, 0.5)
    assert [(x, -y) for x, y in reversed(plan)] == plan
    assert max(x for x, _ in plan) == pytest.approx(2.25)
    assert plan[0][1] == pytest.approx(0.9)


def test_higher_exponent_makes_a_boxier_bumper():
    round_one, boxy = (CarShape(front_exponent=exponent).bumper_plan(1.0, 0.5) for exponent in (2.2, 7.0))
    assert all(sharp[0] >= bowed[0] - 1e-9 for sharp, bowed in zip(boxy, round_one))
    assert boxy[1][0] > round_one[1][0] + 0.05


def test_tow_bar_and_low_mirrors_are_met_at_their_height_only():
    plain = CarShape(clearance_m=0.2)
    fitted = CarShape(clearance_m=0.2, tow_bar_m=0.15, low_mirrors_m=0.12, tailgate_m=0.5)
    low, high = (np.concatenate([seen_from(fitted, height_m, corner) for corner in CORNERS])
                 for height_m in (0.22, 0.35))
    assert low[:, 0].min() == pytest.approx(-0.5 * plain.length_m, abs=0.03)
    assert high[:, 0].min() == pytest.approx(-0.5 * plain.length_m - fitted.tow_bar_m, abs=0.03)
    assert np.abs(low[:, 1]).max() == pytest.approx(0.5 * plain.width_m + fitted.low_mirrors_m, abs=0.02)


def test_car_on_large_wheels_can_be_built():
    points = seen_from(CarShape(wheel_radius_m=0.45, clearance_m=0.4), 0.3, CORNERS[0])
    assert len(points) > 10
