"""The commanded velocity, within drive control's acceleration limits and close to the measured velocity."""
# SPDX-License-Identifier: Apache-2.0
from typing import Optional

from ..inputs import RobotState
from ..limits import MotionLimits
from .tracking import Velocity

# A command must not wind up while the robot is stopped externally (drive control, a wheel block).
LEAD_MPS, LEAD_RADPS = 0.3, 0.8
PERIOD_S = 0.04
# Upper limit of the assumed time between two ticks.
MAX_STEP_S = 0.1
STILL_MPS, STILL_RADPS = 0.02, 0.05
# The controller may exceed the planned accelerations; with the defaults these are drive control's limits.
LINEAR_SHARE, ANGULAR_SHARE = 1.25, 1.4


class Ramp:
    """Commanded velocity of the robot.

    Attributes:
        linear_mps: commanded along base_link x.
        angular_radps: commanded about z.
        step_s: time since the last tick.
    """

    def __init__(self, limits: MotionLimits):
        self._limits = limits
        self._last_s: Optional[float] = None
        self.step_s = PERIOD_S
        self.linear_mps = 0.0
        self.angular_radps = 0.0

    @property
    def is_still(self) -> bool:
        """True when the command is zero or almost zero."""
        return abs(self.linear_mps) < STILL_MPS and abs(self.angular_radps) < STILL_RADPS

    def begin(self, now_s: float, robot: RobotState) -> None:
        """Start a tick."""
        passed = PERIOD_S if self._last_s is None else now_s - self._last_s
        self.step_s = max(0.0, min(passed, MAX_STEP_S))
        self._last_s = now_s
        self.linear_mps = robot.speed_mps + _clamp(self.linear_mps - robot.speed_mps, LEAD_MPS)
        self.angular_radps = robot.yaw_rate_radps + _clamp(self.angular_radps - robot.yaw_rate_radps, LEAD_RADPS)

    def drive(self, wanted: Velocity) -> None:
        """Change the command towards the wanted velocity."""
        linear = LINEAR_SHARE * self._limits.acceleration_mps2 * self.step_s
        angular = ANGULAR_SHARE * self._limits.angular_acceleration_radps2 * self.step_s
        self.linear_mps += _clamp(wanted.linear_mps - self.linear_mps, linear)
        self.angular_radps += _clamp(wanted.angular_radps - self.angular_radps, angular)

    def brake(self) -> None:
        """Decelerate to a stop on the present curve."""
        step = self._limits.acceleration_mps2 * self.step_s
        kept = max(0.0, 1.0 - step / abs(self.linear_mps)) if self.linear_mps else 0.0
        angular = self.angular_radps - _clamp(
            self.angular_radps, self._limits.angular_acceleration_radps2 * self.step_s)
        if abs(self.linear_mps) > STILL_MPS:
            angular = self.angular_radps * kept
        self.linear_mps, self.angular_radps = self.linear_mps * kept, angular

    def drop(self) -> None:
        """Command zero at once, because the inputs for control are missing."""
        self.linear_mps = self.angular_radps = 0.0
        self._last_s = None


def _clamp(value: float, limit: float) -> float:
    return max(-limit, min(limit, value))
