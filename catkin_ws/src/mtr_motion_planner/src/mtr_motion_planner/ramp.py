"""The commanded velocity: it changes within the limits and never runs away from the measured one."""
# SPDX-License-Identifier: Apache-2.0
from typing import Optional

from .inputs import RobotState
from .parameters import MotionParameters
from .profile import clamp, slew

# A robot that is held (drive control, a wheel block) must not be left with a command that has wound up.
LEAD_MPS, LEAD_RADPS = 0.25, 0.6
PERIOD_S = 0.04
# A gap between ticks counts as at most this.
LONGEST_STEP_S = 0.1
STILL_MPS, STILL_RADPS = 0.02, 0.05


class Ramp:
    """Commanded velocity of the robot.

    Attributes:
        linear_mps: commanded along base_link x.
        angular_radps: commanded about z.
    """

    def __init__(self, parameters: MotionParameters):
        self._parameters = parameters
        self._last_s: Optional[float] = None
        self._step_s = PERIOD_S
        self.linear_mps = 0.0
        self.angular_radps = 0.0

    @property
    def is_still(self) -> bool:
        """True when nothing is commanded any more."""
        return abs(self.linear_mps) < STILL_MPS and abs(self.angular_radps) < STILL_RADPS

    def begin(self, now_s: float, robot: RobotState) -> None:
        """Start a tick."""
        passed = PERIOD_S if self._last_s is None else now_s - self._last_s
        self._step_s = max(0.0, min(passed, LONGEST_STEP_S))
        self._last_s = now_s
        self.linear_mps = robot.speed_mps + clamp(self.linear_mps - robot.speed_mps, LEAD_MPS)
        self.angular_radps = robot.yaw_rate_radps + clamp(self.angular_radps - robot.yaw_rate_radps, LEAD_RADPS)

    def drive(self, linear_mps: float, angular_radps: float) -> None:
        """Move towards the wanted velocity."""
        limits = self._parameters
        self.linear_mps = slew(self.linear_mps, linear_mps, limits.acceleration_mps2 * self._step_s)
        self.angular_radps = slew(self.angular_radps, clamp(angular_radps, limits.max_angular_radps),
                                  limits.angular_acceleration_radps2 * self._step_s)

    def brake(self) -> None:
        """Move towards standstill."""
        self.drive(0.0, 0.0)

    def drop(self) -> None:
        """Command zero at once: there is nothing to control by."""
        self.linear_mps = self.angular_radps = 0.0
        self._last_s = None
