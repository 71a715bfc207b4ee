"""Parts of the locator: prior, way round, poses at beam times, profile of a side, parameters."""
# SPDX-License-Identifier: Apache-2.0
import math

import numpy as np
import pytest

from mtr_car_locator.locator import CarLocator, Order
from mtr_car_locator.parameters import LocatorParameters
from mtr_car_locator.point_grid import PointGrid
from mtr_car_locator.poses import PoseHistory
from mtr_car_locator.profile import Profile, profile_of
from mtr_car_locator.rectangle import Rectangle
from mtr_car_locator.ring import Ring
from mtr_car_locator.scan import Scan, points_in_map
from mtr_core.errors import ConfigurationError
from mtr_core.se2 import Pose2
from mtr_core.states import CarState

PARAMETERS = LocatorParameters()
ORIGIN = Pose2(0.0, 0.0, 0.0)


def test_prior_before_mapping_follows_the_robot_and_is_grown_by_the_margin():
    locator = CarLocator(PARAMETERS)
    assert locator.step(1.0, None, None, []).outline == ()
    robot = Pose2(1.0, 2.0, 0.5)
    locator.add_pose(1.0, robot)
    estimate = locator.step(1.1, Order(False, 0, 0, 0.0, 0.0), None, [])
    assert estimate.state == CarState.UNKNOWN
    assert estimate.outline[0] == pytest.approx((2.75, 1.4))
    seen = estimate.rectangle.pose.inverse() @ robot
    assert (seen.x, seen.y) == pytest.approx((4.0, 2.6))
    ahead = estimate.rectangle.pose.inverse().apply(*robot.apply(math.hypot(4.0, 2.6), 0.0))
    assert ahead == pytest.approx((0.0, 0.0), abs=1e-9)


@pytest.mark.parametrize("heading_deg, first_y", [(-147.0, 2.5), (-90.0, 0.9)])
def test_ring_goes_once_round_beginning_with_the_smaller_turn(heading_deg, first_y):
    car = Rectangle(ORIGIN, 4.5, 1.8)
    ring = Ring(Pose2(4.0, 2.6, math.radians(heading_deg)), car, 1.6)
    places = [ring.place(index, car) for index in range(len(ring))]
    assert len({(place.x, place.y) for place in places}) == 8
    assert places[0].y == pytest.approx(first_y)
    angles = np.unwrap([math.atan2(place.y, place.x) for place in places])
    assert np.all(np.diff(angles) > 0.0) or np.all(np.diff(angles) < 0.0)
    assert min(math.hypot(max(abs(p.x) - 2.25, 0.0), max(abs(p.y) - 0.9, 0.0)) for p in places) >= 1.59


def test_each_beam_starts_where_the_robot_was_at_its_time():
    poses = PoseHistory()
    for k in range(6):
        poses.add(0.02 * k, Pose2(0.0, 0.0, 0.02 * k * 10.0))
    scan = Scan(0.02, 0.02, 0.0, 0.0, 0.1, 30.0, np.array([1.0, 1.0, np.inf]), ORIGIN)
    points = points_in_map(scan, poses)
    assert np.arctan2(points[:, 1], points[:, 0]) == pytest.approx([0.2, 0.4])


@pytest.mark.parametrize("start_s", [-0.1, 0.07])
def test_sweep_that_poses_do_not_cover_gives_no_points(start_s):
    poses = PoseHistory()
    for k in range(5):
        poses.add(0.02 * k, ORIGIN)
    scan = Scan(start_s, 0.01, 0.0, 0.1, 0.1, 30.0, np.ones(4), ORIGIN)
    assert len(points_in_map(scan, poses)) == 0


def test_gap_between_poses_is_not_bridged():
    poses = PoseHistory()
    for time_s in (0.0, 0.02, 0.30, 0.32):
        poses.add(time_s, ORIGIN)
    assert poses.at(np.array([0.1])) is None
    assert poses.at(np.array([0.31])) is not None


def test_grid_keeps_the_mean_of_a_cell_and_forgets_single_hits():
    grid = PointGrid(0.0, 0.0)
    grid.add(np.array([[1.001, 2.001], [1.003, 2.005], [3.0, 3.0], [90.0, 0.0]]))
    points, hits = grid.points()
    assert points == pytest.approx(np.array([[1.002, 2.003]]))
    assert hits == pytest.approx([2.0])


def test_surface_of_a_noisy_wall_is_not_pulled_outwards():
    rng = np.random.default_rng(3)
    along = rng.uniform(-2.0, 2.0, 20000)
    outward = 0.9 + rng.normal(0.0, 0.03, 20000)
    level, sigma = profile_of(along, outward, np.ones(20000)).extent()
    assert level == pytest.approx(0.9, abs=0.01)
    assert 0.01 < sigma < 0.03


def test_extent_without_agreement_is_unknown():
    levels = np.arange(6) * 0.1
    assert Profile(levels, levels, levels).extent() is None


@pytest.mark.parametrize("name, value", [("ring_distance_m", 0.5), ("look_first_s", math.nan), ("start_x_m", 99.0)])
def test_parameter_out_of_range_is_named(name, value):
    with pytest.raises(ConfigurationError, match=name):
        LocatorParameters(**{name: value})
