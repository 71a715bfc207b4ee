"""Outline, test area and collision stop: forbidden areas, and the reported sentences."""
# SPDX-License-Identifier: Apache-2.0
import dataclasses
import math
from itertools import groupby

import numpy as np
import pytest
from motion_simulation import FOOTPRINT, OUTLINE, PARAMETERS, PERIOD_S, ROBOT, SimulatedRobot, car_at
from shapely.geometry import Polygon, box
from shapely.geometry.polygon import orient

from mtr_core.errors import ConfigurationError
from mtr_core.problems import NO_PROBLEM, Problem
from mtr_core.se2 import Pose2
from mtr_core.states import Direction, Result
from mtr_motion_planner.geometry.keep_out import KeepOut, OutlineUnusable, centres, plain_of
from mtr_motion_planner.inputs import CollisionStop, Zone
from mtr_motion_planner.parameters import Margins, Slip
from mtr_motion_planner.search.options import Target
from mtr_motion_planner.search.planning import Planning
from mtr_motion_planner.timing.plan import Moving

TEST_AREA = (-7.0, -7.0, 7.0, -7.0, 7.0, 1.5, -7.0, 1.5)  # no room to pass on the Car's left
FENCED = dataclasses.replace(PARAMETERS, margins=Margins(geofence_xy=TEST_AREA))


def footprint_at(pose):
    front, rear, width = FOOTPRINT.front_m, FOOTPRINT.rear_m, FOOTPRINT.half_width_m
    base = pose @ PARAMETERS.slip.base_from_centre.inverse()
    return Polygon([base.apply(x, y) for x, y in ((front, width), (-rear, width), (-rear, -width),
                                                  (front, -width))])


@pytest.mark.parametrize("pose", [Pose2(3.0, 0.4, 0.3), Pose2(0.2, -1.5, 1.5), Pose2(-2.6, 1.2, -0.8)])
def test_clearance_is_the_distance_of_the_two_polygons(pose):
    keep_out = KeepOut(OUTLINE, ROBOT, PARAMETERS.margins)
    assert keep_out.clearance(pose) == pytest.approx(footprint_at(pose).distance(Polygon(OUTLINE)), abs=0.003)


def test_clearance_is_zero_on_and_inside_the_outline():
    keep_out = KeepOut(OUTLINE, ROBOT, PARAMETERS.margins)
    assert keep_out.clearance(Pose2(0.0, 0.0, 0.0)) == 0.0
    assert keep_out.clearance(Pose2(2.2, 0.0, 0.0)) == 0.0


@pytest.mark.parametrize("radius", [0.465, 0.8, 1.4])
def test_ring_grown_by_its_radius_covers_the_hull_grown_by_the_gap(radius):
    keep_out = KeepOut(OUTLINE, ROBOT, PARAMETERS.margins)
    ring = Polygon(centres(keep_out.hull, radius, 0.465)).buffer(radius, 64)
    assert ring.buffer(0.002).contains(keep_out.hull.buffer(0.465, 64))


@pytest.mark.parametrize("roundness_m", [0.2, 0.6])
def test_plain_zone_of_a_round_car_has_four_corners_and_covers_it(roundness_m):
    hull = orient(box(-2.2, -0.9, 2.2, 0.9).buffer(-roundness_m).buffer(roundness_m, 4))
    plain = plain_of(hull)
    assert len(plain.exterior.coords) == 5
    assert plain.buffer(1e-6).contains(hull)


def test_plain_zone_does_not_reach_far_beyond_a_blunt_corner():
    hull = orient(Polygon([(2.0, 0.0), (1.2, 0.9), (-2.0, 0.9), (-2.0, -0.9), (1.2, -0.9)]))
    assert plain_of(hull).equals(hull)


def test_way_around_a_car_with_cut_corners_takes_no_longer_than_around_its_box():
    def time_s(outline):
        planning = Planning(KeepOut(outline, ROBOT, PARAMETERS.margins), None, PARAMETERS, 0.7)
        return planning.plan(Moving(Pose2(4.0, -2.0, 2.6)), Target(Pose2(-3.5, 1.0, -1.2), Direction.ANY)).duration_s
    assert time_s(OUTLINE) < time_s(box(-2.25, -0.9, 2.25, 0.9).exterior.coords[:-1]) + 0.1


@pytest.mark.parametrize("outline", [(), ((0, 0), (1, 1)), ((1, 1), (1, 1), (1, 1)), ((0, 0), (4, 0), (2, 0)),
                                     ((0, 0), (4, 2), (4, 0), (0, 2))])
def test_outline_without_area_or_crossing_itself_is_refused_with_a_sentence(outline):
    with pytest.raises(OutlineUnusable, match="outline"):
        KeepOut(outline, ROBOT, PARAMETERS.margins)
    robot = SimulatedRobot(Pose2(4.0, 2.6, 0.0), car_at(outline=outline))
    robot.go(1, 6.0, 0.0, 0.0)
    assert robot.planner_says(Result.REFUSED, "outline")
    assert robot.pose == Pose2(4.0, 2.6, 0.0)


def test_notch_of_the_outline_may_be_entered_straight():
    notched = ((2.0, 1.0), (-2.0, 1.0), (-2.0, -1.0), (-0.6, -1.0), (-0.6, -0.2), (0.6, -0.2), (0.6, -1.0), (2.0, -1.0))
    robot = SimulatedRobot(Pose2(0.0, -3.0, math.radians(90.0)), car_at(outline=notched))
    robot.go(1, 0.0, -0.75, 90.0, Direction.FORWARD)
    assert robot.run().result == Result.REACHED
    assert robot.least_clearance > 0.09


def test_goal_outside_the_test_area_is_refused():
    robot = SimulatedRobot(Pose2(4.0, 0.0, 0.0), parameters=FENCED)
    robot.go(1, 3.0, 3.0, 0.0)
    assert robot.planner_says(Result.REFUSED, "test area")


def test_robot_outside_the_test_area_stays():
    robot = SimulatedRobot(Pose2(0.0, 4.0, 0.0), parameters=FENCED)
    robot.go(1, 4.0, 0.0, 0.0)
    assert robot.planner_says(Result.REFUSED, "outside")


def test_way_around_the_car_takes_the_side_inside_the_test_area():
    robot = SimulatedRobot(Pose2(4.0, 1.2, math.radians(180.0)), parameters=FENCED)
    robot.go(1, -4.0, 1.2, 180.0)
    assert robot.run().result == Result.REACHED
    area = Polygon(list(zip(TEST_AREA[::2], TEST_AREA[1::2])))
    centre = PARAMETERS.slip.base_from_centre
    assert all(area.contains(footprint_at(pose @ centre)) for pose in robot.poses[::10])
    assert min(pose.y for pose in robot.poses) < -1.0


@pytest.mark.parametrize("numbers", [(0.0, 0.0, 1.0), (0.0, 0.0, 1.0, 1.0), (0.0, 0.0, 1.0, 1.0, math.nan, 2.0)])
def test_test_area_that_is_no_polygon_is_named(numbers):
    with pytest.raises(ConfigurationError, match="geofence_xy"):
        Margins(geofence_xy=numbers)


@pytest.mark.parametrize("bearing, side", [(0.0, "ahead"), (1.5, "to the left"), (-1.5, "to the right"),
                                           (3.0, "behind")])
def test_obstacle_is_named_and_the_robot_goes_on_when_it_is_gone(bearing, side):
    robot = SimulatedRobot(Pose2(0.0, -6.0, math.radians(90.0)))
    robot.go(1, 0.0, -3.0, 90.0)
    robot.run_for(2.0)
    robot.held, robot.collision_stop = True, CollisionStop(robot.now, Zone.BLOCKED, 0.6, bearing)
    output = robot.run_for(5.0)
    assert output.result is Result.BLOCKED
    assert output.message.text == f"The robot is blocked by an obstacle 0.6 m {side}."
    assert abs(output.linear_mps) <= 0.35
    robot.held, robot.collision_stop = False, None
    assert robot.run().result == Result.REACHED
    assert robot.miss().distance_to(Pose2(0.0, 0.0, 0.0)) < 0.02


def test_blind_lidar_is_reported_in_drive_controls_words():
    robot = SimulatedRobot(Pose2(0.0, -6.0, math.radians(90.0)), held=True)
    silent = Problem("drive_control.silent", "The front LiDAR is silent.")
    robot.collision_stop = CollisionStop(robot.now, Zone.BLIND, message=silent)
    robot.go(1, 0.0, -3.0, 90.0)
    output = robot.run_for(1.0)
    assert (output.result, output.message) == (Result.BLOCKED, robot.collision_stop.message)


def test_robot_that_does_not_move_rests_before_each_further_attempt():
    """Drive control resets its lock for an unresponsive base only after one second without a motion request."""
    robot = SimulatedRobot(Pose2(0.0, -6.0, math.radians(90.0)))
    robot.go(1, 0.0, -3.0, 90.0)
    robot.run_for(2.0)
    robot.held = True
    robot.run_for(14.0)
    phases = [(is_still, sum(1 for _ in ticks) * PERIOD_S) for is_still, ticks in groupby(
        robot.outputs, lambda output: output.linear_mps == output.angular_radps == 0.0)]
    rests_s = [duration_s for is_still, duration_s in phases[1:-1] if is_still]
    assert len(rests_s) >= 2 and min(rests_s) > 1.5
    assert {output.result for output in robot.outputs[-200:]} == {Result.BLOCKED}
    assert robot.outputs[-1].message.code == "motion_planner.stalled" and robot.outputs[-1].remaining_m > 1.0
    robot.held = False
    assert robot.run().result == Result.REACHED
    assert robot.miss().distance_to(Pose2(0.0, 0.0, 0.0)) < 0.02
    assert sum(output.path is not None for output in robot.outputs) == 1


def test_command_to_a_slowed_robot_does_not_wind_up_and_its_way_is_kept():
    robot = SimulatedRobot(Pose2(4.0, 2.6, math.radians(-147.0)))
    robot.max_speed = 1.0
    robot.go(1, -4.0, 0.0, 0.0)
    robot.run_for(3.0)
    robot.speed_cap = 0.2
    robot.run_for(8.0)
    assert max(abs(output.linear_mps) for output in robot.outputs[-100:]) <= 0.2 + 0.35
    robot.speed_cap = math.inf
    assert robot.run().result == Result.REACHED
    assert robot.least_clearance > 0.10
    assert robot.miss().distance_to(Pose2(0.0, 0.0, 0.0)) < 0.02
    assert sum(output.path is not None for output in robot.outputs) == 1


def test_robot_is_slow_while_localization_is_degenerate():
    robot = SimulatedRobot(Pose2(0.0, -6.0, math.radians(90.0)))
    robot.go(1, 0.0, -2.0, 90.0)
    robot.run_for(2.5)
    robot.is_degenerate = True
    robot.run_for(1.5)
    assert max(output.linear_mps for output in robot.outputs[-20:]) == pytest.approx(0.3, abs=0.02)
    robot.is_degenerate = False
    assert robot.run_for(2.0).linear_mps == pytest.approx(0.5, abs=0.02)


@pytest.mark.parametrize("slip", [Slip(0.0, 0.0, 0.0), Slip(-0.03, 0.14, 0.18)])
def test_base_that_slides_otherwise_than_expected_arrives_all_the_same(slip):
    robot = SimulatedRobot(Pose2(4.0, 2.6, math.radians(-147.0)), slip=slip)
    robot.go(1, -4.0, -1.0, 60.0)
    output = robot.run()
    assert (output.result, output.message) == (Result.REACHED, NO_PROBLEM)
    assert np.hypot(robot.miss().x, robot.miss().y) < 0.03
