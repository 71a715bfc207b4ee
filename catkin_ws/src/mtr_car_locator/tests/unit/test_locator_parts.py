"""Parts of the locator: prior, ring, poses at beam times, sides, wheels, maps, parameters."""
# SPDX-License-Identifier: Apache-2.0
import dataclasses
import math

import numpy as np
import pytest

from mtr_car_locator.estimate import Inputs
from mtr_car_locator.find.prior import prior_from_start
from mtr_car_locator.locator import CarLocator
from mtr_car_locator.measure.axis import axis_of, robust_line
from mtr_car_locator.measure.outline import outline_of
from mtr_car_locator.measure.side import Side, side_of
from mtr_car_locator.parameters import LocatorParameters
from mtr_car_locator.poses import PoseHistory, RobotPose
from mtr_car_locator.rectangle import Rectangle
from mtr_car_locator.scan import RangeBias, Scan, returns_in_map
from mtr_car_locator.surfels import surfels_from
from mtr_car_locator.survey.ring import Ring
from mtr_car_locator.survey.surfel_grid import SurfelGrid
from mtr_car_locator.watch.corners import corners
from mtr_core.errors import ConfigurationError
from mtr_core.se2 import Pose2
from mtr_core.states import CarState

PARAMETERS = LocatorParameters()
ORIGIN = Pose2(0.0, 0.0, 0.0)
CAR = Rectangle(ORIGIN, 4.5, 1.8)


def history(rows):
    first, *rest = (RobotPose(time_s, pose) for time_s, pose in rows)
    poses = PoseHistory(first)
    for robot in rest:
        poses.add(robot)
    return poses


def side(outward, name="left", sigma=0.002):
    """Return a side with one sample per centimetre, ten of them per surfel."""
    count = len(outward)
    return Side(name, np.arange(count) * 0.01 - 0.005 * count, np.asarray(outward, dtype=float), np.full(count, sigma),
                np.arange(count) // 10)


def test_prior_before_mapping_follows_the_robot_and_is_grown_by_the_margin():
    locator = CarLocator(PARAMETERS)
    assert locator.step(Inputs(1.0)).outline == ()
    robot = Pose2(1.0, 2.0, 0.5)
    locator.add_pose(RobotPose(1.0, robot))
    estimate = locator.step(Inputs(1.1))
    assert estimate.state == CarState.UNKNOWN
    assert estimate.outline[0] == pytest.approx((2.75, 1.4))
    seen = estimate.rectangle.pose.inverse() @ robot
    assert (seen.x, seen.y) == pytest.approx((4.0, 2.6))


def test_error_of_the_prior_is_that_of_the_robots_place_not_of_the_cars():
    prior = prior_from_start(ORIGIN, PARAMETERS)
    # The robot is at the right place and rotated by 20 degrees: the Car is 1.7 m from the prior.
    actual = PARAMETERS.car_from_start @ Pose2(0.0, 0.0, math.radians(20.0))
    car = actual.inverse()
    assert car.distance_to(prior.car.pose) > 1.6
    off_m, off_rad = prior.error_of(car)
    assert off_m == pytest.approx(0.0, abs=1e-9) and math.degrees(off_rad) == pytest.approx(20.0)


@pytest.mark.parametrize("heading_deg, first_y", [(-147.0, 2.5), (-90.0, 0.9)])
def test_ring_goes_round_and_back_to_its_first_place_beginning_with_the_smaller_turn(heading_deg, first_y):
    ring = Ring(Pose2(4.0, 2.6, math.radians(heading_deg)), CAR, 1.6)
    places = visited(ring)
    assert len(places) == 9 and (places[0].x, places[0].y) == (places[-1].x, places[-1].y)
    assert places[0].y == pytest.approx(first_y)
    angles = np.unwrap([math.atan2(place.y, place.x) for place in places])
    assert np.all(np.diff(angles) > 0.0) or np.all(np.diff(angles) < 0.0)
    assert min(math.hypot(max(abs(p.x) - 2.25, 0.0), max(abs(p.y) - 0.9, 0.0)) for p in places) >= 1.59


def visited(ring, blocked=()):
    """Return the places in the order of a robot that cannot reach the blocked ones."""
    places = []
    while not ring.is_finished:
        place = ring.place(CAR)
        if any(place.distance_to(each) < 0.1 for each in blocked):
            ring.turn_back()
        else:
            places.append(place)
            ring.pass_place()
    return places


@pytest.mark.parametrize("first", range(8))
@pytest.mark.parametrize("count", [1, 2, 3])
def test_ring_with_blocked_places_visits_all_others_and_ends_where_it_began(first, count):
    def fresh():
        return Ring(Pose2(4.0, 2.6, -2.5), CAR, 1.6)
    round_once = visited(fresh())[:8]
    blocked = [round_once[(first + k) % 8] for k in range(count)]
    places = visited(fresh(), blocked)
    assert {(p.x, p.y) for p in places} == {(p.x, p.y) for p in round_once} - {(p.x, p.y) for p in blocked}
    assert places[-1].distance_to(places[0]) < 1e-9


def test_corner_places_face_the_car():
    for place in corners(CAR, 1.6):
        assert math.hypot(abs(place.x) - 2.25, abs(place.y) - 0.9) == pytest.approx(1.6)
        assert place.apply(math.hypot(place.x, place.y), 0.0) == pytest.approx((0.0, 0.0), abs=1e-9)


def test_each_beam_starts_where_the_robot_was_at_its_time():
    poses = history((0.02 * k, Pose2(0.0, 0.0, 0.02 * k * 10.0)) for k in range(6))
    scan = Scan(0.02, 0.02, 0.0, 0.0, 0.1, 30.0, np.array([1.0, 1.0, np.inf]), Pose2(0.1, 0.0, 0.0))
    seen = returns_in_map(scan, poses)
    assert np.arctan2(seen.points[:, 1], seen.points[:, 0]) == pytest.approx([0.2, 0.4])
    assert seen.viewer == pytest.approx([0.1 * math.cos(0.4), 0.1 * math.sin(0.4)])


@pytest.mark.parametrize("start_s", [-0.1, 0.07])
def test_sweep_that_poses_do_not_cover_gives_no_points(start_s):
    poses = history((0.02 * k, ORIGIN) for k in range(5))
    scan = Scan(start_s, 0.01, 0.0, 0.1, 0.1, 30.0, np.ones(4), ORIGIN)
    assert returns_in_map(scan, poses) is None


@pytest.mark.parametrize("is_rear, range_m", [(False, 0.98), (True, 1.01)])
def test_range_bias_is_that_of_the_lidar(is_rear, range_m):
    poses = history((0.02 * k, ORIGIN) for k in range(5))
    scan = Scan(0.02, 0.01, 0.0, 0.0, 0.1, 30.0, np.ones(4), ORIGIN, is_rear)
    assert returns_in_map(scan, poses, RangeBias(0.02, -0.01)).points[:, 0] == pytest.approx([range_m] * 4)


SOUND = Scan(0.02, 0.001, 0.0, 0.1, 0.1, 30.0, np.ones(4), ORIGIN)


@pytest.mark.parametrize("wrong", [
    {"first_angle_rad": math.nan}, {"beam_angle_rad": math.inf}, {"beam_angle_rad": -2.5}, {"beam_period_s": -0.001},
    {"beam_period_s": 1e30}, {"beam_period_s": 0.1}, {"range_min_m": math.nan}, {"range_max_m": -1e30},
    {"start_s": math.inf}], ids=str)
@pytest.mark.filterwarnings("error")
def test_sweep_of_a_driver_that_says_anything_gives_no_points(wrong):
    poses = history((0.02 * k, ORIGIN) for k in range(5))
    assert len(returns_in_map(SOUND, poses).points) == 4
    assert returns_in_map(dataclasses.replace(SOUND, **wrong), poses) is None


def test_gap_between_poses_and_change_of_map_are_not_bridged():
    poses = history((time_s, ORIGIN) for time_s in (0.0, 0.02, 0.30, 0.32))
    assert poses.at(np.array([0.1])) is None
    assert poses.at(np.array([0.31])) is not None
    poses.add(RobotPose(0.34, Pose2(0.2, 0.0, 0.0), map_revision=1))
    assert poses.at(np.array([0.33])) is None


def test_robot_stands_from_its_last_motion_on():
    poses = PoseHistory(RobotPose(0.0, ORIGIN, 0.0))
    for time_s, speed_mps in ((0.1, 0.3), (0.2, 0.0), (0.3, 0.005)):
        poses.add(RobotPose(time_s, ORIGIN, speed_mps))
    assert poses.standing_s(1.0) == pytest.approx(0.8)
    poses.add(RobotPose(1.1, ORIGIN, 0.0, 0.1))
    assert poses.standing_s(1.2) == 0.0


def test_grid_makes_surfels_that_face_the_viewer_and_forgets_single_hits():
    rng = np.random.default_rng(3)
    grid = SurfelGrid(0.0, 0.0)
    wall = np.column_stack((rng.uniform(-1.0, 1.0, 4000), 2.04 + rng.normal(0.0, 0.01, 4000)))
    grid.add(wall, np.array([0.0, 0.0]))
    grid.add(np.array([[3.0, 3.0], [90.0, 0.0]]), np.array([0.0, 0.0]))
    surfels = grid.surfels(0.005)
    assert len(surfels) > 20
    assert surfels.normal[:, 1] == pytest.approx(np.full(len(surfels), -1.0), abs=0.05)
    assert np.median(surfels.position[:, 1]) == pytest.approx(2.04, abs=0.002)
    assert surfels.length.sum() == pytest.approx(2.0, abs=0.2)
    assert np.all(surfels.sigma > 0.005)


def test_surfels_that_are_no_numbers_or_have_no_size_are_left_out():
    rows = [(1.0, 2.0, 0.0, 0.1, 0.003, 20), (math.nan, 2.0, 0.0, 0.1, 0.003, 20), (1.0, 2.0, 0.0, 0.0, 0.003, 20),
            (1.0, 2.0, 0.0, 0.1, 0.0, 20)]
    assert len(surfels_from(np.array(rows))) == 1


def test_extent_of_a_noisy_side_is_not_pulled_outwards():
    rng = np.random.default_rng(3)
    found = side(0.9 + np.repeat(rng.normal(0.0, 0.002, 40), 10)).extent()
    assert found.level == pytest.approx(0.9, abs=0.003)
    assert 0.002 < found.sigma < 0.006


def test_mirror_does_not_count_for_the_width_and_a_bumper_does():
    sill, mirror, bumper = np.full(180, 0.88), np.full(20, 1.05), np.linspace(0.84, 0.90, 60)
    assert side(np.concatenate((sill, mirror))).extent().level == pytest.approx(0.88, abs=0.001)
    assert side(np.concatenate((sill, bumper))).extent().level == pytest.approx(0.893, abs=0.004)


def test_end_of_a_tilted_surfel_sticks_out_less_than_its_tilt_says():
    rows = [(x, 0.88, math.pi / 2.0, 0.1, 0.003, 20) for x in np.arange(-0.9, 0.95, 0.1)]
    tilted = (1.1, 0.886, math.pi / 2.0 + math.radians(7.0), 0.25, 0.003, 20)
    side_with_it = side_of("left", surfels_from(np.array([*rows, tilted])))
    reach_m = 0.5 * 0.25 * math.sin(math.radians(7.0))
    assert side_with_it.outward.max() < 0.886 + 0.75 * reach_m
    assert side_with_it.extent().level == pytest.approx(0.893, abs=0.003)


def test_extent_without_support_is_unknown():
    assert side(np.full(10, 0.9)).extent() is None
    assert side(np.linspace(0.2, 0.9, 30)).extent() is None


@pytest.mark.parametrize("axle_m", [0.95, 1.07])
def test_wheels_of_one_side_of_a_short_car_tell_its_heading(axle_m):
    rows = [(middle + part, -0.75 + 0.01 * (middle + part), -math.pi / 2.0, 0.1, 0.003, 40)
            for middle in (axle_m, -axle_m) for part in np.arange(-0.25, 0.3, 0.1)]
    left, right = (side_of(name, surfels_from(np.array(rows))) for name in ("left", "right"))
    axis = axis_of(left, right, length=3.18)
    assert axis.slope == pytest.approx(0.01, abs=0.001) and not axis.is_centred


def test_line_through_most_points_forgets_the_others():
    along = np.linspace(-2.0, 2.0, 41)
    level = 0.9 + 0.01 * along
    level[:8] -= 0.05
    slope, offset, slope_sigma, _ = robust_line(along, level)
    assert slope == pytest.approx(0.01, abs=0.0015) and offset == pytest.approx(0.9, abs=0.002)
    assert slope_sigma > 0.0


def test_outline_of_a_car_seen_from_one_corner_is_completed():
    rows = [(2.25, y, 0.0, 0.1, 0.003, 20) for y in np.arange(-0.8, 0.85, 0.1)]
    rows += [(x, 0.9, math.pi / 2.0, 0.1, 0.003, 20) for x in np.arange(-2.2, 2.25, 0.1)]
    outline = np.array(outline_of(surfels_from(np.array(rows)), CAR, ("front", "left")))
    assert outline.min(axis=0) == pytest.approx((-2.25, -0.9))
    assert outline.max(axis=0) == pytest.approx((2.25, 0.9), abs=0.01)


@pytest.mark.parametrize("name, value", [("ring_distance_m", 0.5), ("look_first_s", math.nan), ("start_x_m", 99.0),
                                         ("start_x_m", 1.0), ("start_y_m", 0.0)])
def test_parameter_out_of_range_is_named(name, value):
    with pytest.raises(ConfigurationError, match=name):
        LocatorParameters(**{name: value})
