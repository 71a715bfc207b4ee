"""How fast the robot moves, whichever of its points. No ROS inside."""
# SPDX-License-Identifier: Apache-2.0
import math

from mtr_description.shipped import shipped_geometry

RADIUS_M = shipped_geometry().footprint().radius_m()


def fastest_point_mps(linear_mps: float, angular_radps: float, lateral_mps: float = 0.0) -> float:
    """No point of the footprint moves faster: a robot that turns on the spot does not stand."""
    return math.hypot(linear_mps, lateral_mps) + abs(angular_radps) * RADIUS_M
