"""Substitute of the demo car's lock message, for tests and benchmarks without a simulated Car."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

# Layout of mtr_demo_car.dbc: LockState, LockStateChanged and LastCommandSource share a byte, the counters follow.
_ALIVE_MODULUS, _COMMAND_MODULUS = 16, 256
_CHANGED_BIT, _SOURCE_BIT = 2, 4
_CHANGED_FRAMES = 5


class DemoLockMessage:
    """Data of consecutive frames, with matching counters and flag.

    Attributes:
        is_locked, source: content of the next frame; source: raw value, 0 for none.
    """

    def __init__(self, is_locked: bool = True) -> None:
        self.is_locked, self.source = is_locked, 0
        self._was_locked = is_locked
        self._alive = self._commands = self._changed_frames = 0

    def next(self) -> bytes:
        """Return the data of the next frame."""
        self._alive = (self._alive + 1) % _ALIVE_MODULUS
        self._changed_frames = max(self._changed_frames - 1, 0)
        if self.is_locked is not self._was_locked:
            self._was_locked = self.is_locked
            self._commands = (self._commands + 1) % _COMMAND_MODULUS
            self._changed_frames = _CHANGED_FRAMES
        return self.encoded(0 if self.is_locked else 1)

    def encoded(self, state: int) -> bytes:
        """Return data with this raw state and the counters of the last frame."""
        flags = state | (self._changed_frames > 0) << _CHANGED_BIT | self.source << _SOURCE_BIT
        return bytes([flags, self._commands, self._alive, 0])
