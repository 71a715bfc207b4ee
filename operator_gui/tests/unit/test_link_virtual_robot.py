"""The virtual robot: ways around the Car, motion, orders."""
# SPDX-License-Identifier: Apache-2.0
import math

import pytest

from mtr_operator.domain.geometry.pose import Pose
from mtr_operator.domain.requests import DesiredState, Press, Waypoint
from mtr_operator.domain.robot_status import Mode, WaypointResult
from mtr_operator.robot_link.virtual.robot import VirtualRobot, VirtualWorld
from mtr_operator.robot_link.virtual.route import Box, advance, route

BOX = Box(2.5, 1.2)
QUICK = VirtualWorld(starting_s=0.0, mapping_s=0.0)


@pytest.mark.parametrize("bearing_deg", range(0, 360, 15))
def test_way_to_any_side_never_enters_the_box(bearing_deg):
    bearing = math.radians(bearing_deg)
    start, goal = (5.0, 0.3), (5.0 * math.cos(bearing), 5.0 * math.sin(bearing))
    points = [start, *route(start, goal, BOX)]
    assert points[-1] == goal
    assert not any(BOX.crosses(a, b) for a, b in zip(points, points[1:]))


def test_way_to_the_opposite_side_is_the_shorter_one():
    assert all(y > 0 for _, y in route((4.0, 1.0), (-4.0, 1.0), BOX))
    assert all(y < 0 for _, y in route((4.0, -1.0), (-4.0, -1.0), BOX)[:-1])


def test_advance_stops_at_the_end_of_the_way():
    assert advance((0.0, 0.0), [(1.0, 0.0), (1.0, 1.0)], 1.5) == ((1.0, 0.5), [(1.0, 1.0)])
    assert advance((0.0, 0.0), [(1.0, 0.0)], 5.0) == ((1.0, 0.0), [])


def driven(robot, desired, seconds):
    """Status after some time under one desired state."""
    robot.take(1, 1, desired)
    for _ in range(round(seconds * 10)):
        robot.step()
    return robot.status()


def test_car_is_mapped_for_whoever_asks_for_it_and_not_after_a_stop():
    robot = VirtualRobot(1, VirtualWorld(starting_s=0.0, mapping_s=2.0))
    assert driven(robot, DesiredState(), 3).mode is Mode.READY_TO_MAP_CAR
    assert driven(robot, DesiredState(map_car_id=1), 1).mode is Mode.MAPPING_CAR
    assert driven(robot, DesiredState(map_car_id=1, stop=True), 9).car is None
    assert driven(robot, DesiredState(map_car_id=1), 1.2).car is not None


def test_robot_keeps_to_the_speed_and_reports_it():
    robot = VirtualRobot(1, QUICK)
    driven(robot, DesiredState(waypoint=Waypoint(1, Pose(4.0, 0.0, math.pi)), max_speed_mps=2.0), 20)
    status = driven(robot, DesiredState(waypoint=Waypoint(2, Pose(3.0, 0.0, math.pi)), max_speed_mps=0.4), 1.0)
    assert (status.x, status.speed_mps) == pytest.approx((3.6, 0.4), abs=1e-6)
    status = driven(robot, DesiredState(waypoint=Waypoint(3, Pose(4.0, 0.0, math.pi)), max_speed_mps=0.4), 0.5)
    assert status.speed_mps == pytest.approx(-0.4)


def test_stop_stands_still_and_the_waypoint_is_kept():
    robot = VirtualRobot(1, QUICK)
    goal = Waypoint(1, Pose(4.0, 3.0, 0.0))
    here = driven(robot, DesiredState(waypoint=goal), 1.0)
    stopped = driven(robot, DesiredState(waypoint=goal, stop=True), 2.0)
    assert (stopped.x, stopped.y, stopped.speed_mps) == (here.x, here.y, 0.0)
    assert driven(robot, DesiredState(waypoint=goal), 60.0).waypoint_result is WaypointResult.REACHED


def test_waypoint_in_the_car_is_refused_with_a_sentence():
    status = driven(VirtualRobot(1, QUICK), DesiredState(waypoint=Waypoint(1, Pose(0.5, 0.0, 0.0))), 0.1)
    assert status.waypoint_result is WaypointResult.REFUSED
    assert "too close" in status.waypoint_message


def test_new_mapping_order_maps_again():
    robot = VirtualRobot(1)
    goal = Waypoint(1, Pose(4.0, 3.0, 0.0))
    driven(robot, DesiredState(waypoint=goal), 60.0)
    again = driven(robot, DesiredState(waypoint=goal, map_car_id=1), 1.0)
    assert again.is_mapping_car and not again.pose_valid and again.map_car_id == 1
    assert driven(robot, DesiredState(waypoint=goal, map_car_id=1), 5.0).pose_valid


def test_stop_holds_the_key_and_lets_no_press_begin_and_the_height_is_reached_after_it():  # A3
    robot = VirtualRobot(1, QUICK)
    rising = driven(robot, DesiredState(key_height_m=1.5), 2.0)
    press = Press(1, (1,), 1.0, 0.2)
    stopped = driven(robot, DesiredState(key_height_m=1.5, press=press, stop=True), 3.0)
    assert stopped.key_height_m == rising.key_height_m < 1.0
    assert [(report.id, bool(report.error)) for report in stopped.presses] == [(1, True)]
    after = driven(robot, DesiredState(key_height_m=1.5, press=press), 10.0)
    assert after.key_height_m == pytest.approx(1.5) and after.presses == stopped.presses
