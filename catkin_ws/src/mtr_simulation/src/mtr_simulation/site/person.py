"""A person who stands, then walks to and fro; the robot pushes nobody away, so a contact counts as a collision."""
# SPDX-License-Identifier: Apache-2.0
import math

import mujoco

from ..physics.mjcf import HIP_HEIGHT_M
from .surroundings import Walk

STRIDE_M = 1.4
LEG_SWING_RAD = 0.35
HALF_HIP_M = 0.1


class Person:
    """Moves the bodies of torso and legs along the walk."""

    def __init__(self, model: mujoco.MjModel, data: mujoco.MjData, walk: Walk):
        self._data, self._walk = data, walk
        self._bodies = [int(model.body(name).mocapid[0]) for name in ("person", "left_leg", "right_leg")]
        (x1, y1), (x2, y2) = walk.start, walk.end
        self._length_m = max(math.hypot(x2 - x1, y2 - y1), 1e-6)
        self._direction = ((x2 - x1) / self._length_m, (y2 - y1) / self._length_m)

    def move(self, elapsed_s: float) -> None:
        """Put the person where it is after that time."""
        walked = self._walk.speed_mps * max(0.0, elapsed_s - self._walk.stands_s)
        along = walked % (2.0 * self._length_m)
        along = min(along, 2.0 * self._length_m - along)
        (x, y), (dx, dy) = self._walk.start, self._direction
        x, y = x + dx * along, y + dy * along
        half_yaw = 0.5 * math.atan2(dy, dx)
        half_swing = 0.5 * LEG_SWING_RAD * math.sin(2.0 * math.pi * walked / STRIDE_M)
        for body, side, swing in zip(self._bodies, (0.0, HALF_HIP_M, -HALF_HIP_M), (0.0, half_swing, -half_swing)):
            self._data.mocap_pos[body] = (x - dy * side, y + dx * side, HIP_HEIGHT_M if side else 0.0)
            # Yaw, then pitch about the hip.
            self._data.mocap_quat[body] = (
                math.cos(half_yaw) * math.cos(swing), -math.sin(half_yaw) * math.sin(swing),
                math.cos(half_yaw) * math.sin(swing), math.sin(half_yaw) * math.cos(swing))
