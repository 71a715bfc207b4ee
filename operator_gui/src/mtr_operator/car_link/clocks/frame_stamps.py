"""Time of a frame on the bus: the stamp of kernel or adapter if the interface supplies one, else the arrival.

An arrival stamp of this program is late if the program is busy or the disk is slow; kernel and adapter stamps are not.
"""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import math
import time
from typing import NamedTuple

import can

from .stamp_kind import StampKind

# The kernel stamps frames with the laptop's clock of day (SO_TIMESTAMP, Linux' Documentation/networking/can.rst).
_BY_KERNEL = frozenset({"socketcan"})
# Their drivers supply the adapter's own clock, in s from an arbitrary origin.
_BY_ADAPTER = frozenset({"pcan", "kvaser", "vector", "ixxat"})
# An age above this means that the clock of day was set after the stamp.
_MAX_AGE_S = 1.0


class FrameTime(NamedTuple):
    """Time of a frame. arrival_s: laptop's monotonic clock; stamp_s: adapter's clock, None without one. kind: the clock
    that counts."""

    arrival_s: float
    stamp_s: float | None
    kind: StampKind = StampKind.ARRIVAL


def frame_time(interface: str, message: can.Message, now_s: float) -> FrameTime:
    """Time of a frame that was read at now_s of the laptop's monotonic clock."""
    if interface in _BY_ADAPTER and math.isfinite(message.timestamp) and message.timestamp > 0.0:
        return FrameTime(now_s, message.timestamp, StampKind.ADAPTER)
    if interface in _BY_KERNEL:
        age_s = time.time() - message.timestamp
        if 0.0 <= age_s <= _MAX_AGE_S:
            return FrameTime(now_s - age_s, None, StampKind.KERNEL)
    return FrameTime(now_s, None)
