"""Remote key as a device: its motion sensor switches it to sleep at rest."""
# SPDX-License-Identifier: Apache-2.0
import math
from typing import Optional, Tuple

from .parameters import KeyParameters

Point = Tuple[float, float, float]


class RemoteKey:
    """Follows the key's place.

    Attributes:
        is_awake: the key answers polls; false after sleep_after_s without a motion of wake_move_m.
    """

    def __init__(self, parameters: KeyParameters):
        self._parameters = parameters
        self._rest: Optional[Point] = None
        self._moved_ns = 0
        self.is_awake = True

    def step(self, time_ns: int, key_xyz: Point) -> None:
        """Update the key's place."""
        p = self._parameters
        if self._rest is None or math.dist(self._rest, key_xyz) >= p.wake_move_m:
            self._rest, self._moved_ns = key_xyz, time_ns
        self.is_awake = p.sleep_after_s == 0.0 or time_ns - self._moved_ns < p.sleep_after_s * 1e9

    @property
    def buttons_work(self) -> bool:
        """True if a press is transmitted."""
        return self.is_awake or self._parameters.buttons_wake
