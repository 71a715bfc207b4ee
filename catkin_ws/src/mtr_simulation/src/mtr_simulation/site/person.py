"""Person who waits, then walks to and fro; the robot does not push persons away, so a contact counts as a collision."""
# SPDX-License-Identifier: Apache-2.0
import math
from typing import Tuple

import mujoco

from .figures import figure_named
from .surroundings import Walk

LEG_SWING_RAD = 0.35


class Person:
    """Moves the bodies of torso and legs, or of another figure, along the walk."""

    def __init__(self, model: mujoco.MjModel, data: mujoco.MjData, walk: Walk):
        self._data, self._walk, self._figure = data, walk, figure_named(walk.figure)
        names = ("person", *(leg.name for leg in self._figure.legs))
        self._bodies = [int(model.body(name).mocapid[0]) for name in names]
        (x1, y1), (x2, y2) = walk.start, walk.end
        self._length_m = max(math.hypot(x2 - x1, y2 - y1), 1e-6)
        self._direction = ((x2 - x1) / self._length_m, (y2 - y1) / self._length_m)

    def move(self, elapsed_s: float) -> None:
        """Move the person to its place after that time."""
        walked = self._walk.speed_mps * max(0.0, elapsed_s - self._walk.stands_s)
        along = walked % (2.0 * self._length_m)
        along = min(along, 2.0 * self._length_m - along)
        (x, y), (dx, dy) = self._walk.start, self._direction
        x, y = x + dx * along, y + dy * along
        half_yaw = 0.5 * math.atan2(dy, dx)
        half_swing = 0.5 * LEG_SWING_RAD * math.sin(2.0 * math.pi * walked / self._figure.stride_m)
        self._put(self._bodies[0], (x, y, 0.0), half_yaw, 0.0)
        for body, leg in zip(self._bodies[1:], self._figure.legs):
            self._put(body, (x - dy * leg.side_m, y + dx * leg.side_m, self._figure.hip_height_m), half_yaw,
                      leg.sense * half_swing)

    def _put(self, body: int, place: Tuple[float, float, float], half_yaw: float, half_swing: float) -> None:
        """Place a body with yaw, then pitch about the hip."""
        self._data.mocap_pos[body] = place
        self._data.mocap_quat[body] = (
            math.cos(half_yaw) * math.cos(half_swing), -math.sin(half_yaw) * math.sin(half_swing),
            math.cos(half_yaw) * math.sin(half_swing), math.sin(half_yaw) * math.cos(half_swing))
