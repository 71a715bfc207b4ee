"""Maps the firmware's clock, 32-bit microseconds that wrap, to the robot's clock."""
# SPDX-License-Identifier: Apache-2.0
from typing import Optional

MICROSECOND_NS = 1000
WRAP_US = 2 ** 32
WRAP_NS = WRAP_US * MICROSECOND_NS
# A ceramic resonator, as on an Arduino Mega, is off by up to 0.5 %; the estimate may follow twice that.
DRIFT_LIMIT = 0.01
# A message later than this against the estimate means that the firmware has started again.
RESTART_NS = 1_000_000_000


def nearest_unwrapped_ns(time_us: int, near_ns: int) -> int:
    """Time in ns that is time_us modulo the wrap and nearest to near_ns."""
    time_ns = time_us * MICROSECOND_NS
    return time_ns + (near_ns - time_ns + WRAP_NS // 2) // WRAP_NS * WRAP_NS


class SharedClock:
    """The simulated firmware's clock is the robot's own but for a constant, modulo the wrap."""

    def __init__(self, start_us: int = 0):
        self._start_us = start_us

    def observe(self, time_us: int, arrival_ns: int) -> int:
        """Robot's time at which the firmware sent a message, from its time and the robot's time near arrival."""
        return nearest_unwrapped_ns(time_us - self._start_us, arrival_ns)

    def robot_ns(self, time_us: int, near_ns: int) -> int:
        """Robot's time of an instant of the firmware's clock that lies near a known one."""
        return nearest_unwrapped_ns(time_us - self._start_us, near_ns)


class FirmwareClock:
    """A clock of its own: a message is late by transport, never early, so the least delay is the best estimate.

    The estimate of the offset rises slowly to follow drift, and falls at once when a message had less delay.

    Attributes:
        restarts: how often the firmware has started again.
    """

    def __init__(self) -> None:
        self.restarts = 0
        self._offset_ns = 0
        self._last_firmware_ns: Optional[int] = None

    def observe(self, time_us: int, arrival_ns: int) -> int:
        """Robot's time at which the firmware sent a message, from its time and the robot's time at arrival."""
        if self._last_firmware_ns is None:
            return self._begin(time_us, arrival_ns)
        firmware_ns = nearest_unwrapped_ns(time_us, arrival_ns - self._offset_ns)
        offset_ns = arrival_ns - firmware_ns
        if firmware_ns < self._last_firmware_ns or abs(offset_ns - self._offset_ns) > RESTART_NS:
            self.restarts += 1
            return self._begin(time_us, arrival_ns)
        leak_ns = int((firmware_ns - self._last_firmware_ns) * DRIFT_LIMIT)
        self._offset_ns = min(offset_ns, self._offset_ns + leak_ns)
        self._last_firmware_ns = firmware_ns
        return firmware_ns + self._offset_ns

    def robot_ns(self, time_us: int, near_ns: int) -> int:
        """Robot's time of an instant of the firmware's clock that lies near a known one (robot's time)."""
        return nearest_unwrapped_ns(time_us, near_ns - self._offset_ns) + self._offset_ns

    def _begin(self, time_us: int, arrival_ns: int) -> int:
        self._last_firmware_ns = time_us * MICROSECOND_NS
        self._offset_ns = arrival_ns - self._last_firmware_ns
        return arrival_ns
