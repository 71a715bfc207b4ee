"""Speed of the robot's fastest point. No ROS inside."""
# SPDX-License-Identifier: Apache-2.0
import math

from mtr_description.shipped import shipped_geometry

RADIUS_M = shipped_geometry().footprint().radius_m()


def fastest_point_mps(linear_mps: float, angular_radps: float, lateral_mps: float = 0.0) -> float:
    """Return an upper bound for the speed of every point of the footprint. A robot that turns on the spot is moving."""
    return math.hypot(linear_mps, lateral_mps) + abs(angular_radps) * RADIUS_M
