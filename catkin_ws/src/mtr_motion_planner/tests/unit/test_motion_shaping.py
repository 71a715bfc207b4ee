"""Curves and their timing end at the goal and respect every limit."""
# SPDX-License-Identifier: Apache-2.0
import math

import numpy as np
import pytest

from mtr_core.se2 import Pose2, wrap_angle
from mtr_motion_planner.geometry.circles import Circle, circle_through, tangent
from mtr_motion_planner.limits import MotionLimits
from mtr_motion_planner.parameters import Slip
from mtr_motion_planner.search.shaping import Driving, RouteShape, Start, curve_of
from mtr_motion_planner.timing.motion import CurveMotion, Pivot
from mtr_motion_planner.timing.speeds import SAMPLE_S

LIMITS = MotionLimits()
NO_SLIP = Slip(0.0, 0.0, 0.0)
# End, and the directions of the turns out of the start and into the end.
ENDS = {Pose2(3.0, 0.5, 0.0): (1, -1), Pose2(3.0, 3.0, 1.5): (1, 1), Pose2(2.0, -2.0, -0.4): (-1, 1),
        Pose2(4.0, 0.2, 0.1): (1, 1), Pose2(3.0, 1.5, 0.0): (1, -1), Pose2(3.0, 0.0, 0.0): (1, 1),
        Pose2(0.5, 0.0, 0.0): (1, 1)}


def curve_to(end, start=None, slip=NO_SLIP, speed=0.5, radius=0.45):
    first, last = ENDS[end]
    return curve_of(RouteShape(radius * first, radius * last), start or Start(Pose2(0.0, 0.0, 0.0)), end,
                    Driving(LIMITS, slip, speed))


@pytest.mark.parametrize("turns", [(1.0, 2.0), (1.0, -0.5), (-0.7, -0.7), (0.0, 1.0)])
def test_tangent_touches_both_circles(turns):
    first, second = Circle(0.0, 0.0, turns[0]), Circle(5.0, 1.0, turns[1])
    direction, length = tangent(first, second)
    (ax, ay), (bx, by) = first.point(direction), second.point(direction)
    assert math.hypot(bx - ax, by - ay) == pytest.approx(length)
    assert math.atan2(by - ay, bx - ax) == pytest.approx(direction)


def test_circle_passes_through_its_pose():
    assert circle_through(Pose2(1.0, 2.0, 0.7), -0.3).point(0.7) == pytest.approx((1.0, 2.0))


@pytest.mark.parametrize("slip", [NO_SLIP, Slip()])
@pytest.mark.parametrize("end", ENDS)
def test_curve_ends_at_its_end_whether_the_base_slides_or_not(end, slip):
    reached = curve_to(end, slip=slip).end
    assert math.hypot(reached.x - end.x, reached.y - end.y) < 0.001
    assert abs(wrap_angle(reached.heading - end.heading)) < 0.001


@pytest.mark.parametrize("speed", [0.3, 0.7, 1.2])
@pytest.mark.parametrize("end", ENDS)
def test_trajectory_keeps_all_limits_and_ends_at_rest(end, speed):
    trajectory = CurveMotion(curve_to(end, speed=speed), 1).timed(LIMITS, speed)
    ways = trajectory.ways
    speeds = np.diff(ways) / SAMPLE_S
    rates = trajectory.angular
    assert speeds.min() > -1e-9
    assert speeds.max() <= speed + 1e-6
    assert np.abs(np.diff(speeds)).max() / SAMPLE_S <= LIMITS.acceleration_mps2 * 1.02
    # Twice the limit if braking immediately follows acceleration.
    assert np.abs(np.diff(speeds, 2)).max() / SAMPLE_S ** 2 <= 2.0 * LIMITS.jerk_mps3 * 1.02
    assert np.abs(rates).max() <= LIMITS.max_angular_radps * 1.03
    assert np.abs(np.diff(rates)).max() / SAMPLE_S <= LIMITS.angular_acceleration_radps2 * 1.25
    assert np.abs(speeds * rates[1:]).max() <= LIMITS.lateral_acceleration_mps2 * 1.05
    assert speeds[-1] == pytest.approx(0.0, abs=0.01)


def test_motion_goes_on_from_its_speed_and_curvature():
    curve = curve_to(Pose2(3.0, 1.5, 0.0), Start(Pose2(0.0, 0.0, 0.0), 0.5, 0.4), radius=1.2)
    first = CurveMotion(curve, 1).timed(LIMITS, 0.5, 0.5).at(0.0)
    assert first.linear_mps == pytest.approx(0.5, abs=0.01)
    assert first.angular_radps == pytest.approx(0.2, abs=0.02)


def test_curve_too_short_to_stop_on_has_no_timing():
    assert CurveMotion(curve_to(Pose2(0.5, 0.0, 0.0)), 1).timed(LIMITS, 1.2, 1.2) is None


def test_straight_way_takes_the_time_of_the_formula():
    trajectory = CurveMotion(curve_to(Pose2(3.0, 0.0, 0.0)), 1).timed(LIMITS, 0.5)
    assert trajectory.duration_s == pytest.approx(3.0 / 0.5 + 0.5 / 0.8 + 0.2, abs=0.06)


@pytest.mark.parametrize("angle", [0.05, -1.5, 3.0])
def test_turn_on_the_spot_ends_at_its_angle_in_the_time_of_the_formula(angle):
    trajectory = Pivot(Pose2(1.0, 2.0, 0.3), angle).timed(LIMITS, 0.0)
    end = trajectory.at(math.inf).pose
    assert (end.x, end.y) == (1.0, 2.0)
    assert wrap_angle(end.heading - 0.3 - angle) == pytest.approx(0.0, abs=1e-6)
    assert trajectory.duration_s == pytest.approx(LIMITS.turn_time(angle), abs=0.1)


@pytest.mark.parametrize("way", [0.5, 1.5])
def test_rest_of_a_motion_ends_where_the_whole_does(way):
    whole = CurveMotion(curve_to(Pose2(3.0, 0.5, 0.0)), -1)
    rest = whole.from_way(way)
    assert rest.length_m == pytest.approx(whole.length_m - way, abs=1e-6)
    assert rest.timed(LIMITS, 0.5).at(math.inf).pose.distance_to(whole.timed(LIMITS, 0.5).at(math.inf).pose) < 1e-6
