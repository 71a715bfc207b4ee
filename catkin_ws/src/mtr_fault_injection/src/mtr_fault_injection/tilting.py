"""IMU readings of a robot that is lifted at its rear, for gyro and accelerometer. No ROS inside."""
# SPDX-License-Identifier: Apache-2.0
import copy
import math
from typing import Any, Optional

# Turning rate of a robot that drives onto a ramp.
RATE_RADPS = math.radians(10.0)
# A message after a longer gap belongs to another motion.
LONGEST_STEP_S = 0.1


class Tilting:
    """Pitch of the robot, which changes steadily to the fault's pitch and back."""

    def __init__(self) -> None:
        self._pitch_rad = 0.0
        self._said_s: Optional[float] = None

    def passed(self, message: Any, wanted_rad: float, now_s: float) -> Any:
        """Return the reading at the current pitch; the message itself on level ground."""
        step_s = 0.0 if self._said_s is None else min(LONGEST_STEP_S, max(0.0, now_s - self._said_s))
        self._said_s = now_s
        most_rad = RATE_RADPS * step_s
        turned_rad = max(-most_rad, min(most_rad, wanted_rad - self._pitch_rad))
        self._pitch_rad += turned_rad
        if self._pitch_rad == 0.0 and turned_rad == 0.0:
            return message
        return _pitched(message, self._pitch_rad, turned_rad / step_s if step_s else 0.0)


def _pitched(message: Any, pitch_rad: float, rate_radps: float) -> Any:
    """Return a copy at this pitch, in which vectors that pointed up also point to the rear; positive: the nose is
    down."""
    turned = copy.copy(message)
    turned.angular_velocity, turned.linear_acceleration = (
        copy.copy(message.angular_velocity), copy.copy(message.linear_acceleration))
    cos, sin = math.cos(pitch_rad), math.sin(pitch_rad)
    for vector in (turned.angular_velocity, turned.linear_acceleration):
        vector.x, vector.z = cos * vector.x - sin * vector.z, sin * vector.x + cos * vector.z
    turned.angular_velocity.y += rate_radps
    return turned
