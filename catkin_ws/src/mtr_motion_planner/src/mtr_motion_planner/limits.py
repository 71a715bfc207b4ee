"""Limits of the robot's own motion, and jerk-limited motion from rest to rest within them."""
# SPDX-License-Identifier: Apache-2.0
import math
from dataclasses import dataclass

from mtr_core.parameters import ParameterSet, number


@dataclass(frozen=True)
class MotionLimits(ParameterSet):
    """Limits of planned motion, lower than in drive control, so that it does not clip the controller's feedback.

    Attributes:
        max_linear_mps: speed on a straight line; drive control allows 0.75 with the key raised.
        curve_lever_m: on a curve max_linear_mps limits speed + curve_lever_m * yaw rate, as in drive control.
        acceleration_mps2: of the linear speed, also when braking; drive control allows 1.0 and 1.5.
        jerk_mps3: of the linear speed from constant speed; a change from accelerating to braking has twice this
            jerk. It limits the swinging of a mast.
        max_angular_radps: yaw rate; drive control allows 1.5.
        angular_acceleration_radps2: of the yaw rate; drive control allows 2.0.
        angular_jerk_radps3: of the yaw rate on the spot.
        lateral_acceleration_mps2: speed times yaw rate; drive control allows 1.0.
    """

    max_linear_mps: float = number(0.71, 0.05, 2.0, "m/s")
    curve_lever_m: float = number(0.25, 0.0, 1.0, "m")
    acceleration_mps2: float = number(0.8, 0.05, 3.0, "m/s2")
    jerk_mps3: float = number(4.0, 0.5, 50.0, "m/s3")
    max_angular_radps: float = number(1.2, 0.1, 4.0, "rad/s")
    angular_acceleration_radps2: float = number(1.4, 0.1, 10.0, "rad/s2")
    angular_jerk_radps3: float = number(12.0, 1.0, 200.0, "rad/s3")
    lateral_acceleration_mps2: float = number(0.8, 0.05, 3.0, "m/s2")

    @property
    def ramp_s(self) -> float:
        """Time in s in which the linear acceleration builds up under the jerk limit."""
        return self.acceleration_mps2 / self.jerk_mps3

    @property
    def angular_ramp_s(self) -> float:
        """Time in s in which the angular acceleration builds up under the jerk limit."""
        return self.angular_acceleration_radps2 / self.angular_jerk_radps3

    def stopping_distance(self, speed_mps: float) -> float:
        """Return the distance in m within which the robot stops from a speed."""
        return speed_mps ** 2 / (2.0 * self.acceleration_mps2) + 0.5 * abs(speed_mps) * self.ramp_s

    def stopping_angle(self, rate: float) -> float:
        """Return the angle in rad within which the robot ends a turn on the spot."""
        return rate ** 2 / (2.0 * self.angular_acceleration_radps2) + 0.5 * abs(rate) * self.angular_ramp_s

    def turn_time(self, angle: float) -> float:
        """Return the time in s of a turn on the spot."""
        return rest_to_rest_time(abs(angle), self.max_angular_radps, self.angular_acceleration_radps2,
                                 self.angular_ramp_s)

    def corner_speed(self, curvature: float) -> float:
        """Return the highest speed in m/s on an arc."""
        bend = max(abs(curvature), 1e-9)
        return min(self.max_linear_mps / (1.0 + self.curve_lever_m * bend), self.max_angular_radps / bend,
                   math.sqrt(self.lateral_acceleration_mps2 / bend))

    def corner_radius(self, speed_mps: float) -> float:
        """Return the smallest radius in m at which the robot keeps a speed."""
        return max(speed_mps / self.max_angular_radps, speed_mps ** 2 / self.lateral_acceleration_mps2)


def rest_to_rest_time(way: float, speed: float, acceleration: float, ramp_s: float) -> float:
    """Return the time from rest to rest over a distance >= 0; the ramp limits the jerk."""
    if way <= 0.0:
        return 0.0
    if way <= speed ** 2 / acceleration:
        return 2.0 * math.sqrt(way / acceleration) + ramp_s
    return way / speed + speed / acceleration + ramp_s
