"""Silence of the CAN bus, measured on the robot's clock, so that a paused simulation does not count as a silent bus.

Some time of the laptop's clock must pass as well: in an accelerated simulation half a second is short, and the reading
thread may be delayed.
"""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import math

from .profile import CarProfile

SILENCE_LIMIT_S = 0.5
_WALL_LIMIT_S = 0.1
# Limit of missing cycles for slow messages.
_CYCLE_LIMIT = 3.0


class _Heartbeat:
    """Robot time since the last count; 0 within a short wall time after it."""

    def __init__(self) -> None:
        self.count = 0
        self.silence_s = 0.0
        self._seen = 0
        self._alive_s = self._alive_wall_s = math.nan

    def observe(self, stamp_s: float, wall_s: float) -> None:
        if self.count != self._seen or math.isnan(self._alive_s):
            self._seen, self._alive_s, self._alive_wall_s = self.count, stamp_s, wall_s
        self.silence_s = stamp_s - self._alive_s if wall_s - self._alive_wall_s >= _WALL_LIMIT_S else 0.0


class Liveness:
    """Watch of all frames, and of the lock message among them."""

    def __init__(self, profile: CarProfile):
        self._profile = profile
        self._frames = _Heartbeat()
        self._lock_messages = _Heartbeat()
        # If the state is sent only on change, another message or any frame must be cyclic.
        self._message = profile.liveness if profile.is_only_on_change else profile.message
        self._lock_limit_s = max(SILENCE_LIMIT_S, _CYCLE_LIMIT * profile.cycle_time_s) if self._message else math.inf
        self._is_without_state = False

    def frame(self, is_lock_message: bool, is_without_state: bool = False) -> None:
        """Add a frame. is_lock_message: a frame of the lock message, or of another required cyclic message.
        is_without_state: a frame of the lock message that does not contain the state."""
        self._frames.count += 1
        self._lock_messages.count += is_lock_message
        self._is_without_state = not is_lock_message and (self._is_without_state or is_without_state)

    def observe(self, stamp_s: float, wall_s: float) -> None:
        """Advance to a Status with this stamp. At wall_s of the laptop's clock, it and all frames before it have
        arrived."""
        self._frames.observe(stamp_s, wall_s)
        self._lock_messages.observe(stamp_s, wall_s)

    @property
    def silence_s(self) -> float:
        """Robot time since the last frame."""
        return self._frames.silence_s

    @property
    def is_silent(self) -> bool:
        """True without frames for longer than the limit."""
        return self.silence_s > self._silence_limit_s

    @property
    def _silence_limit_s(self) -> float:
        # Without other traffic, the lock message alone proves that the bus is alive.
        only_lock = self._message is not None and self._frames.count == self._lock_messages.count
        return self._lock_limit_s if only_lock and self._frames.count else SILENCE_LIMIT_S

    @property
    def problem(self) -> str:
        """Current fault as one sentence, or empty."""
        if self.is_silent:
            return (f"No CAN frame for {self.silence_s:.1f} s; check the plug, the bit rate and that the Car is awake.")
        if self._lock_messages.silence_s > self._lock_limit_s:
            message = self._message
            if self._is_without_state:
                return (f"Message {message.name} (id 0x{message.frame_id:X}) comes without the signal "
                        f"{self._profile.signal}: another page of a multiplexed message, or a shorter one than the "
                        "database says; check the car profile.")
            return (f"No message {message.name} (id 0x{message.frame_id:X}) for {self._lock_messages.silence_s:.1f} s "
                    "although the CAN bus is alive; check the car profile.")
        return ""
