"""The quick estimate of a route's time is close to the time of the planned motion."""
# SPDX-License-Identifier: Apache-2.0
import pytest

from mtr_core.se2 import Pose2
from mtr_motion_planner.limits import MotionLimits
from mtr_motion_planner.parameters import Slip
from mtr_motion_planner.search.estimate import time_of
from mtr_motion_planner.search.shaping import Driving, RouteShape, Start, curve_of, route_of
from mtr_motion_planner.timing.motion import CurveMotion

LIMITS = MotionLimits()
RADIUS_M = 0.45


@pytest.mark.parametrize("end, turns", [
    # The turn at the end is driven at the speed limit; the one at the start is too short for it.
    (Pose2(6.0, 1.0, 1.2), (1, 1)), (Pose2(6.0, -0.5, -1.5), (-1, -1)), (Pose2(3.0, 3.0, 1.5), (1, 1))])
def test_estimate_is_the_time_of_the_motion_within_a_tenth(end, turns):
    shape, speed, start = RouteShape(RADIUS_M * turns[0], RADIUS_M * turns[1]), 0.5, Pose2(0.0, 0.0, 0.0)
    curve = curve_of(shape, Start(start), end, Driving(LIMITS, Slip(0.0, 0.0, 0.0), speed))
    driven_s = CurveMotion(curve, 1).timed(LIMITS, speed).duration_s
    assert time_of(route_of(shape, start, end), shape, LIMITS, speed, 0.0) == pytest.approx(driven_s, rel=0.1)
