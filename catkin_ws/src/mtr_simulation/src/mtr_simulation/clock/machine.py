"""Machine's clock instead of the simulated one: nothing waits, and sensors are stamped with their time of measurement.

A car park does not stop while a computer is busy, but the simulated world does. Wheels and gyro then report a stopped
robot. Otherwise a turning rate would last longer than the robot turned, and no map would fit.
"""
# SPDX-License-Identifier: Apache-2.0
import os
import pathlib
from typing import Callable, List

from mtr_core.errors import ConfigurationError
from mtr_core.liveness import Instant
from mtr_core.schedule import CLOCK_STEP

from ..sensors.readings import Sensors

REAL_TIME = 1.0
# Lost time of the loop that is made up for. With more, on a machine that is too slow, all data would be so old that the
# robot stops.
MADE_UP_S = 0.1
# After a longer pause, for example a suspended machine, the sensors have been silent.
MAX_STOOD_NS = 2_000_000_000
# The simulation is not the robot's software, so it runs before other programs if the system permits it.
NICENESS = -10
# Linux shares processors between sessions first (sched(7), autogroup), and niceness counts only within a session.
# roslaunch starts each node in its own session; a shared session is left unchanged.
AUTOGROUP = pathlib.Path("/proc/self/autogroup")
# Two readings of both clocks differ by less unless one was set. A tick is longer, so that stamps never decrease.
SET_NS = 5_000_000


def take_precedence() -> bool:
    """Run this process before others; return False if the system does not permit it."""
    try:
        os.setpriority(os.PRIO_PROCESS, 0, NICENESS)
        if os.getsid(0) == os.getpid() and AUTOGROUP.exists():
            AUTOGROUP.write_text(str(NICENESS), encoding="ascii")
    except OSError:
        return False
    return True


class StampOffset:
    """Offset of the stamps from the simulated clock at its newest tick."""

    def __init__(self, is_simulated: bool, real_time_factor: float, due_s: Callable[[], float],
                 reading: Callable[[], Instant]):
        """
        Args:
            due_s: when the newest tick was due, by the steady clock.
            reading: the machine's and the steady clock.

        Raises:
            ConfigurationError: the machine's clock cannot run faster.
        """
        if not is_simulated and real_time_factor != REAL_TIME:
            raise ConfigurationError(f"Parameter real_time_factor is {real_time_factor:g}; allowed without "
                                     f"/use_sim_time is {REAL_TIME:g}, the machine's own speed.")
        self._is_simulated, self._due_s, self._reading = is_simulated, due_s, reading
        self._set_ns = 0

    def at(self, time_ns: int) -> int:
        """Return the offset in ns, at a tick of the simulated clock."""
        if self._is_simulated:
            return 0
        set_ns = self._reading().offset_ns
        if abs(set_ns - self._set_ns) > SET_NS:
            self._set_ns = set_ns
        return round(self._due_s() * 1e9) + self._set_ns - time_ns


def stood_offsets(offset_ns: int, lost_ns: int) -> List[int]:
    """Return the stamps for the time in which the world stopped after a tick, one each 20 ms, up to the newest.

    Args:
        offset_ns: offset from StampOffset.at that tick, including the loop's lost time.
        lost_ns: lost time of the loop.
    """
    if not 0 < lost_ns <= MAX_STOOD_NS:
        return []
    period_ns = CLOCK_STEP.period_ns
    return [offset_ns - back_ns for back_ns in range((lost_ns - 1) // period_ns * period_ns, -1, -period_ns)]


def stamped(sensors: Sensors, offset_ns: int) -> Sensors:
    """Return the readings with their stamps advanced by the offset."""
    front, rear = (scan and scan._replace(stamp_ns=scan.stamp_ns + offset_ns)
                   for scan in (sensors.front_scan, sensors.rear_scan))
    return sensors._replace(time_ns=sensors.time_ns + offset_ns, front_scan=front, rear_scan=rear)
