"""Parameters of the motion planner."""
# SPDX-License-Identifier: Apache-2.0
import math
from dataclasses import dataclass

from mtr_core.errors import check_range
from mtr_core.parameters import ParameterSet, number


@dataclass(frozen=True)
class MotionParameters(ParameterSet):
    """What the motion planner is started with.

    Attributes:
        acceleration_mps2: limit of the linear acceleration, also when braking.
        angular_acceleration_radps2: limit of the angular acceleration.
        max_angular_radps: limit of the yaw rate.
        footprint_length_m: the robot's length, centred about base_link.
        footprint_width_m: the robot's width, centred about base_link.
        keep_out_m: the footprint never gets closer to the Car's outline by plan.
        turn_margin_m: gap beside the circle of the turning robot that must be free where it turns.
        route_margin_m: the same gap on a route around the Car.
        goal_along_m: REACHED needs this along the goal's heading.
        goal_across_m: REACHED needs this across the goal's heading.
        goal_heading_rad: REACHED needs this.
        corrections: attempts to get within these tolerances before the robot stays where it is.
        lookahead_m: distance on the route to the point that is steered for.
        turn_in_place_rad: a larger change of direction is made standing.
        longest_reverse_route_m: a longer route that is not straight along an axis is driven forwards.
        input_age_limit_s: older inputs stop the robot.
    """

    acceleration_mps2: float = number(0.5, 0.05, 3.0, "m/s2")
    angular_acceleration_radps2: float = number(1.0, 0.1, 10.0, "rad/s2")
    max_angular_radps: float = number(1.0, 0.1, 4.0, "rad/s")
    footprint_length_m: float = number(0.51, 0.1, 2.0, "m")
    footprint_width_m: float = number(0.43, 0.1, 2.0, "m")
    keep_out_m: float = number(0.10, 0.02, 1.0, "m")
    turn_margin_m: float = number(0.05, 0.0, 1.0, "m")
    route_margin_m: float = number(0.20, 0.0, 2.0, "m")
    goal_along_m: float = number(0.02, 0.005, 0.5, "m")
    goal_across_m: float = number(0.03, 0.005, 0.5, "m")
    goal_heading_rad: float = number(math.radians(1.0), 0.003, 0.5, "rad")
    corrections: int = number(3, 0, 20, "attempts")
    lookahead_m: float = number(0.4, 0.1, 2.0, "m")
    turn_in_place_rad: float = number(math.radians(45.0), 0.2, 1.5, "rad")
    longest_reverse_route_m: float = number(3.0, 0.0, 20.0, "m")
    input_age_limit_s: float = number(0.3, 0.1, 2.0, "s")

    def __post_init__(self) -> None:
        super().__post_init__()
        check_range("route_margin_m", self.route_margin_m, self.turn_margin_m, 2.0, "m")

    @property
    def turn_radius_m(self) -> float:
        """Radius about base_link that a turn on the spot sweeps."""
        return 0.5 * math.hypot(self.footprint_length_m, self.footprint_width_m)
