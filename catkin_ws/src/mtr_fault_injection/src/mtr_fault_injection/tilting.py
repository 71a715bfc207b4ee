"""Readings of an IMU on a robot that is lifted at its rear: what gyro and accelerometer say then. No ROS inside."""
# SPDX-License-Identifier: Apache-2.0
import copy
import math
from typing import Any, Optional

# As fast as a robot drives onto a ramp.
RATE_RADPS = math.radians(10.0)
# A message that comes later belongs to another motion.
LONGEST_STEP_S = 0.1


class Tilting:
    """Pitch of the robot, which turns steadily to the one of the fault and back."""

    def __init__(self) -> None:
        self._pitch_rad = 0.0
        self._said_s: Optional[float] = None

    def passed(self, message: Any, wanted_rad: float, now_s: float) -> Any:
        """The reading at this pitch; the message itself on level ground."""
        step_s = 0.0 if self._said_s is None else min(LONGEST_STEP_S, max(0.0, now_s - self._said_s))
        self._said_s = now_s
        most_rad = RATE_RADPS * step_s
        turned_rad = max(-most_rad, min(most_rad, wanted_rad - self._pitch_rad))
        self._pitch_rad += turned_rad
        if self._pitch_rad == 0.0 and turned_rad == 0.0:
            return message
        return _pitched(message, self._pitch_rad, turned_rad / step_s if step_s else 0.0)


def _pitched(message: Any, pitch_rad: float, rate_radps: float) -> Any:
    """A copy at this pitch, with which what pointed up points to the rear as well; positive: its nose is down."""
    turned = copy.copy(message)
    turned.angular_velocity, turned.linear_acceleration = (
        copy.copy(message.angular_velocity), copy.copy(message.linear_acceleration))
    cos, sin = math.cos(pitch_rad), math.sin(pitch_rad)
    for vector in (turned.angular_velocity, turned.linear_acceleration):
        vector.x, vector.z = cos * vector.x - sin * vector.z, sin * vector.x + cos * vector.z
    turned.angular_velocity.y += rate_radps
    return turned
