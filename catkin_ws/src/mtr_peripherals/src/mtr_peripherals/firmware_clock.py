"""Maps the firmware's clock, 32-bit microseconds that wrap, to the robot's steady clock, and that to the robot's clock.

The firmware's clock is compared with the steady clock only, so that steps of the robot's clock have no effect.
"""
# SPDX-License-Identifier: Apache-2.0
from typing import Optional

from mtr_core.liveness import Instant

MICROSECOND_NS = 1000
WRAP_US = 2 ** 32
WRAP_NS = WRAP_US * MICROSECOND_NS
# The error of a ceramic resonator, as on an Arduino Mega, is up to 0.5 %; the estimate may follow twice that drift.
DRIFT_LIMIT = 0.01
# A message that is earlier than the estimate by more than this, or whose time decreases, shows a restarted firmware. A
# message that is later by more than this was delayed. If only such messages arrive for LATE_FOR_NS, the estimate is
# wrong.
RESTART_NS = 1_000_000_000
LATE_FOR_NS = 5_000_000_000
# Two readings of the same offset differ by less, see mtr_core.lockstep.clock.
SAME_OFFSET_NS = 2_000_000


def nearest_unwrapped_ns(time_us: int, near_ns: int) -> int:
    """Return the time in ns that equals time_us modulo the wrap and is nearest to near_ns."""
    time_ns = time_us * MICROSECOND_NS
    return time_ns + (near_ns - time_ns + WRAP_NS // 2) // WRAP_NS * WRAP_NS


class SharedClock:
    """The simulated firmware's clock, which differs from the robot's clock only by a constant, modulo the wrap."""

    restarts = 0

    def __init__(self, start_us: int = 0):
        self._start_us = start_us

    def observe(self, time_us: int, arrival_ns: int) -> int:
        """Return the steady time at which the firmware sent a message, from its time and the time near arrival."""
        return nearest_unwrapped_ns(time_us - self._start_us, arrival_ns)

    def steady_ns(self, time_us: int, near_ns: int) -> int:
        """Return the steady time of an instant of the firmware's clock near a known one."""
        return nearest_unwrapped_ns(time_us - self._start_us, near_ns)

    def firmware_us(self, steady_ns: int) -> Optional[int]:
        """Return the firmware's clock at a steady time."""
        return (steady_ns // MICROSECOND_NS + self._start_us) % WRAP_US


class FirmwareClock:
    """A separate clock: a message may be late by transport, never early, so the least delay yields the best estimate.

    The estimate of the offset rises slowly to follow drift, and falls at once when a message had less delay.

    Attributes:
        restarts: number of restarts of the firmware.
    """

    def __init__(self) -> None:
        self.restarts = 0
        self._offset_ns = 0
        self._last_firmware_ns: Optional[int] = None
        self._in_time_ns = 0

    def observe(self, time_us: int, arrival_ns: int) -> int:
        """Return the steady time at which the firmware sent a message, from its time and the steady time at arrival."""
        if self._last_firmware_ns is None:
            return self._begin(time_us, arrival_ns)
        firmware_ns = nearest_unwrapped_ns(time_us, arrival_ns - self._offset_ns)
        late_ns = arrival_ns - firmware_ns - self._offset_ns
        if firmware_ns < self._last_firmware_ns or late_ns < -RESTART_NS:
            self.restarts += 1
            return self._begin(time_us, arrival_ns)
        if late_ns <= RESTART_NS:
            self._in_time_ns = arrival_ns
        elif arrival_ns - self._in_time_ns > LATE_FOR_NS:
            return self._begin(time_us, arrival_ns)
        leak_ns = int((firmware_ns - self._last_firmware_ns) * DRIFT_LIMIT)
        self._offset_ns += min(late_ns, leak_ns)
        self._last_firmware_ns = firmware_ns
        return firmware_ns + self._offset_ns

    def steady_ns(self, time_us: int, near_ns: int) -> int:
        """Return the steady time of an instant of the firmware's clock near a known steady time."""
        return nearest_unwrapped_ns(time_us, near_ns - self._offset_ns) + self._offset_ns

    def firmware_us(self, steady_ns: int) -> Optional[int]:
        """Return the firmware's clock at a steady time, or None before its first message."""
        if self._last_firmware_ns is None:
            return None
        return (steady_ns - self._offset_ns) // MICROSECOND_NS % WRAP_US

    def _begin(self, time_us: int, arrival_ns: int) -> int:
        self._last_firmware_ns = time_us * MICROSECOND_NS
        self._offset_ns = arrival_ns - self._last_firmware_ns
        self._in_time_ns = arrival_ns
        return arrival_ns


class RobotClock:
    """Converts steady times to the robot's clock, with an offset that changes only when the robot's clock is set."""

    def __init__(self) -> None:
        self._offset_ns: Optional[int] = None

    def update(self, now: Instant) -> None:
        """Process a reading of both clocks."""
        if self._offset_ns is None or abs(now.offset_ns - self._offset_ns) > SAME_OFFSET_NS:
            self._offset_ns = now.offset_ns

    def robot_ns(self, steady_ns: int) -> int:
        """Return the time of the robot's clock at a steady time, for its present offset."""
        return steady_ns + (self._offset_ns or 0)
