"""Load of the bus and cycle of the lock message, counted on the laptop's clock as frames arrive."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import collections

from mtr_operator.domain.ports import BusTraffic

from .can_frame import CanFrame

# Long enough for several cycles of the slowest lock messages, short enough to be current.
WINDOW_S = 4.0
# ISO 11898-1: bits of a frame without its data, including the gap of three bits. Stuffed bits depend on the content and
# are not counted: they increase the load by up to a fifth.
_BITS, _EXTENDED_BITS = 47, 67
# Bits of a CAN FD frame: at the bit rate, and at the data bit rate with a short and a long check sum.
_FD_BITS, _FD_EXTENDED_BITS = 30, 49
_FD_DATA_BITS, _FD_LONG_DATA_BITS, _FD_SHORT_BYTES = 31, 36, 16
_BITS_PER_BYTE = 8


class TrafficMeter:
    """Meter, updated with every frame in the order of arrival. data_bitrate_bps: of CAN FD frames, None for classic
    CAN."""

    def __init__(self, bitrate_bps: int, data_bitrate_bps: int | None = None):
        self._bitrate_bps = bitrate_bps
        self._data_bitrate_bps = data_bitrate_bps or bitrate_bps
        self._frames: collections.deque[tuple[float, float]] = collections.deque()
        self._locks: collections.deque[float] = collections.deque()
        self._begun_s: float | None = None

    def frame(self, frame: CanFrame, is_lock_message: bool) -> None:
        """Add a frame."""
        if self._begun_s is None:
            self._begun_s = frame.arrival_s
        self._frames.append((frame.arrival_s, self._duration_s(frame)))
        if is_lock_message:
            self._locks.append(frame.arrival_s)
        self._forget(frame.arrival_s)

    def traffic(self, now_s: float, expected_cycle_s: float) -> BusTraffic:
        """Return the traffic of the last few seconds of the laptop's clock."""
        self._forget(now_s)
        begun_s = now_s if self._begun_s is None else self._begun_s
        span_s = min(WINDOW_S, now_s - begun_s)
        busy_s = sum(frame_s for _, frame_s in self._frames)
        gaps = len(self._locks) - 1
        cycle_s = (self._locks[-1] - self._locks[0]) / gaps if gaps > 0 else None
        load = busy_s / span_s if span_s > 0.0 else 0.0
        return BusTraffic(min(load, 1.0), cycle_s, expected_cycle_s)

    def _duration_s(self, frame: CanFrame) -> float:
        data_bits = _BITS_PER_BYTE * len(frame.data)
        if not frame.is_fd:
            return ((_EXTENDED_BITS if frame.is_extended else _BITS) + data_bits) / self._bitrate_bps
        data_bits += _FD_DATA_BITS if len(frame.data) <= _FD_SHORT_BYTES else _FD_LONG_DATA_BITS
        return ((_FD_EXTENDED_BITS if frame.is_extended else _FD_BITS) / self._bitrate_bps
                + data_bits / self._data_bitrate_bps)

    def _forget(self, now_s: float) -> None:
        while self._frames and now_s - self._frames[0][0] > WINDOW_S:
            self._frames.popleft()
        while self._locks and now_s - self._locks[0] > WINDOW_S:
            self._locks.popleft()
