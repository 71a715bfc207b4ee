"""Conversions between ROS messages and the locator's types, and rviz markers."""
# SPDX-License-Identifier: Apache-2.0
import math
from dataclasses import replace

import genpy
import numpy as np
import pytest
import rosbag
from locator_surfels import PARAMETERS, box, prior, surfels
from sensor_msgs.msg import LaserScan
from visualization_msgs.msg import Marker

from mtr_car_locator.conversions import (
    check_message,
    estimate_message,
    mapping_message,
    markers_message,
    robot_pose_from,
    scan_from,
    scans_in,
    surface_map_from,
    task_from,
)
from mtr_car_locator.drawing import shapes_of
from mtr_car_locator.estimate import Estimate, LocatorTask, result_at
from mtr_car_locator.find.fit import fit_car
from mtr_car_locator.measure.car_fit import SideSigmas
from mtr_car_locator.offline import FilesUnusable
from mtr_car_locator.poses import PoseMode
from mtr_car_locator.scan import RangeBias
from mtr_car_locator.survey.surface_map import MapPhase
from mtr_car_locator.watch.self_check import CheckReport
from mtr_core import names
from mtr_core.conversions import waypoint_message
from mtr_core.problems import Problem
from mtr_core.requests import CAR_LOCATOR, Goal, GoalId, GoalReport, Waypoint
from mtr_core.se2 import Pose2
from mtr_core.states import CarState, Check, Direction, Result
from mtr_description.shipped import shipped_geometry
from mtr_msgs.msg import (
    CarCheck,
    CarEstimate,
    KeyFrame,
    LocalizedPose,
    MappingOrder,
    RobotMode,
    SurfaceMap,
)

FOUND = Problem("car_locator.found", "Found.")
MOVED = Problem("car_locator.moved", "Moved.", (("shift_cm", "3.0"),))
LIDARS = shipped_geometry().lidars()
STAMP = genpy.Time(9, 60_000_000)


@pytest.fixture(scope="module")
def estimate():
    fit = fit_car(surfels(box()), prior(), PARAMETERS)
    place = Waypoint(4, CAR_LOCATOR, "map", Pose2(1.0, 2.0, 0.5), Direction.FORWARD)
    return Estimate(CarState.LOCATED, replace(fit.rectangle, pose=Pose2(3.0, 1.0, math.pi / 2.0)), fit.outline,
                    (0.1, 0.2, 0.01), 0.03, 0.02, place, 5, FOUND, 2, Pose2(0.01, 0.02, 0.003), MapPhase.FREEZE, 77,
                    CheckReport(6, Check.FAILED, 0.03, 0.002, MOVED), (place.pose,), fit,
                    side_sigmas=SideSigmas(0.11, 0.075, 0.03, 0.04))


def test_order_names_mapping_checking_and_the_goal():
    waypoint = Waypoint(3, CAR_LOCATOR, "map", Pose2(1.0, 2.0, 0.0))
    task = task_from(RobotMode(mode=RobotMode.CHECKING_CAR, goal=waypoint_message(waypoint), goal_attempt=9,
                                 map_car_id=5, check_car_id=8))
    assert (task.mapping, task.checking, task.check_car_id, task.map_car_id) == (False, True, 8, 5)
    assert task.goal == Goal(waypoint, 9)
    assert task_from(None) is None


def test_motion_counts_for_the_waypoint_that_is_the_goal_and_for_no_other():
    waypoint = Waypoint(3, CAR_LOCATOR, "map", Pose2(1.0, 2.0, 0.0))
    task, motion = LocatorTask(True, 0, Goal(waypoint, 9)), GoalReport(GoalId(CAR_LOCATOR, 3, 9), Result.BLOCKED)
    assert result_at(waypoint, task, motion) is Result.BLOCKED
    assert result_at(replace(waypoint, id=4), task, motion) is Result.IDLE
    assert result_at(None, task, motion) is result_at(waypoint, None, motion) is Result.IDLE
    assert result_at(waypoint, task, replace(motion, goal_id=GoalId(CAR_LOCATOR, 3, 8))) is Result.IDLE
    operators = replace(waypoint, requester="application/5")
    assert result_at(waypoint, LocatorTask(True, 0, Goal(operators, 9)),
                     replace(motion, goal_id=GoalId("application/5", 3, 9))) is Result.IDLE
    assert result_at(waypoint, LocatorTask(True, 0), GoalReport()) is Result.IDLE


def test_pose_carries_mode_map_and_motion():
    message = LocalizedPose(valid=True, x=1.0, y=2.0, heading=0.5, speed_mps=0.3, yaw_rate_radps=0.1, mode=2,
                            map_revision=4, covariance=[0.01, 0, 0, 0, 0.03, 0, 0, 0, 0.001])
    message.header.stamp = genpy.Time(7, 500_000_000)
    robot = robot_pose_from(message)
    assert (robot.pose, robot.speed_mps) == (Pose2(1.0, 2.0, 0.5), 0.3)
    assert robot.time_s == pytest.approx(7.5)
    assert (robot.mode, robot.map_revision, robot.stands) == (PoseMode.LOCALIZED, 4, False)
    assert robot.position_sigma_m == pytest.approx(math.sqrt(0.02))


def test_surface_map_becomes_surfels_and_a_damaged_one_is_not_valid():
    message = SurfaceMap(map_car_id=77, revision=3, valid=True, x=[1.0, 2.0], y=[0.0, 0.0], normal=[0.0, math.pi / 2.0],
                         length=[0.1, 0.2], sigma=[0.003, 0.004], hits=[9, 8],
                         key_frames=[KeyFrame(stamp=genpy.Time(5, 250_000_000), x=1.0, y=2.0, heading=0.3)],
                         range_bias_m=0.012, rear_range_bias_m=-0.004)
    found = surface_map_from(message)
    assert (found.map_id, found.revision, found.valid, len(found.surfels)) == (77, 3, True, 2)
    assert found.surfels.normal[1] == pytest.approx((0.0, 1.0), abs=1e-6)
    assert found.key_frames.tolist() == [[5.25, 1.0, 2.0, 0.3]]
    assert found.range_bias == RangeBias(0.012, -0.004)
    message.hits = [9]
    assert not surface_map_from(message).valid and "damaged" in surface_map_from(message).message.text


def test_estimate_survives_as_a_message(estimate):
    message = estimate_message(estimate, STAMP)
    assert (message.state, message.map_car_id, message.revision) == (CarEstimate.LOCATED, 5, 2)
    assert (message.message, [problem.code for problem in message.problems]) == (FOUND.text, [FOUND.code])
    assert (message.correction_x, message.correction_y, message.correction_heading) == (0.01, 0.02, 0.003)
    assert (message.next_waypoint.id, message.next_waypoint.requester) == (4, "car_locator")
    assert (message.next_waypoint.frame_id, message.next_waypoint.direction) == ("map", 1)
    assert (message.front_sigma, message.rear_sigma) == (0.11, 0.075)
    assert (message.left_sigma, message.right_sigma) == (0.03, 0.04)
    # The Car's x axis is along map's y: 0.1 m along the Car is along y.
    assert message.covariance[[0, 4, 8]] == pytest.approx([0.04, 0.01, 0.0001])
    assert len(message.outline_x) == len(message.outline_y) == len(estimate.outline)


def test_mapper_and_check_are_told(estimate):
    mapping = mapping_message(estimate, STAMP)
    assert (mapping.phase, mapping.map_car_id, mapping.header.stamp) == (MappingOrder.FREEZE, 77, STAMP)
    check = check_message(estimate, PARAMETERS.refinement, STAMP)
    assert (check.id, check.state, check.message) == (6, CarCheck.FAILED, MOVED.text)
    assert [problem.code for problem in check.problems] == [MOVED.code]
    assert (check.difference_m, check.limit_m) == (0.03, PARAMETERS.refinement.check_limit_m)


@pytest.mark.parametrize("said_s, told_s, used_s", [(0.0, 6e-5, 6e-5), (3e-5, 6e-5, 3e-5), (0.0, 0.0, 0.0)])
def test_beams_are_timed_as_told_where_the_scan_does_not_say_it(said_s, told_s, used_s):
    message = LaserScan(time_increment=said_s, angle_increment=0.1, range_max=30.0, ranges=[1.0, 2.0])
    assert scan_from(message, Pose2(0.0, 0.0, 0.0), False, told_s).beam_period_s == pytest.approx(used_s)


def test_numbers_are_those_of_the_messages():
    assert (MapPhase.IDLE, MapPhase.COLLECT, MapPhase.FREEZE) == (MappingOrder.IDLE, MappingOrder.COLLECT,
                                                                 MappingOrder.FREEZE)
    assert [mode.value for mode in PoseMode] == [LocalizedPose.DEAD_RECKONING, LocalizedPose.MAPPING,
                                                 LocalizedPose.LOCALIZED, LocalizedPose.LOST]


def test_markers_show_outline_band_surfels_and_places(estimate):
    shapes = {shape.name: shape for shape in shapes_of(estimate)}
    assert set(shapes) == {"outline", "front", "outer", "inner", "surfels", "centre", "places"}
    # The band is 2 sigma of half the length and of the centre wider on each end; the Car points to map's y.
    span = {name: np.ptp([y for _, y in shapes[name].points]) for name in ("outline", "outer", "inner")}
    assert span["outer"] - span["outline"] == pytest.approx(4.0 * math.hypot(0.1, 0.015), abs=0.01)
    assert span["outline"] - span["inner"] == pytest.approx(span["outer"] - span["outline"], abs=1e-6)
    markers = markers_message(list(shapes.values()), STAMP).markers
    assert markers[0].action == Marker.DELETEALL and len(markers) == 1 + len(shapes)
    outline = next(marker for marker in markers if marker.ns == "outline")
    assert outline.points[0] == outline.points[-1] and outline.header.frame_id == "map"


def test_before_the_car_is_found_only_the_guess_is_shown(estimate):
    rough = replace(estimate, state=CarState.COLLECTING, fit=None, places=())
    assert {shape.name for shape in shapes_of(rough)} == {"outline", "front"}


def test_scans_in_a_bag_come_in_order_with_their_mounting(tmp_path):
    bag = tmp_path / "drive.bag"
    with rosbag.Bag(str(bag), "w") as recorded:
        for time_s, topic in ((2, names.REAR_SCAN), (1, names.FRONT_SCAN)):
            message = LaserScan(angle_increment=0.01, range_max=30.0, ranges=[1.0, 2.0])
            message.header.stamp = genpy.Time(time_s)
            recorded.write(topic, message, message.header.stamp)
    found = list(scans_in(bag, LIDARS))
    assert [scan.start_s for scan in found] == [1.0, 2.0]
    assert [scan.base_from_lidar for scan in found] == list(LIDARS)
    assert [scan.is_rear for scan in found] == [False, True]


@pytest.mark.parametrize("content", [None, b"no bag"])
def test_bag_that_cannot_be_read_is_named(tmp_path, content):
    bag = tmp_path / "drive.bag"
    if content is not None:
        bag.write_bytes(content)
    with pytest.raises(FilesUnusable, match=r"drive\.bag cannot be read"):
        list(scans_in(bag, LIDARS))
