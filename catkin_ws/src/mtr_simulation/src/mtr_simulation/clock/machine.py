"""The machine's clock instead of the simulated one: nothing waits, and sensors are stamped when they measured.

A car park does not stand still while a computer is busy. Where the simulated one does, its wheels and gyro say that the
robot stood: a rate that lasted longer than the robot turned would tell of a turn that never was, and no map would fit.
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
# Time that the loop loses up to this is made up for. More, on a machine that is too slow, and what the robot is told
# would be so old at all times that it stops.
MADE_UP_S = 0.1
# Who was away for longer, as a machine that was suspended, has sensors that were silent.
MAX_STOOD_NS = 2_000_000_000
# What is simulated is no software of the robot's: it does not wait for other programs where the system permits that.
NICENESS = -10
# Linux shares processors out to sessions first (sched(7), autogroup), and a niceness counts within one. roslaunch gives
# each node a session of its own; whoever has one beside others leaves it as it is.
AUTOGROUP = pathlib.Path("/proc/self/autogroup")
# Two readings of both clocks differ by less unless one was set; a tick is longer, so that no stamp goes back.
SET_NS = 5_000_000


def take_precedence() -> bool:
    """Have this process run before others; False where the system does not permit it."""
    try:
        os.setpriority(os.PRIO_PROCESS, 0, NICENESS)
        if os.getsid(0) == os.getpid() and AUTOGROUP.exists():
            AUTOGROUP.write_text(str(NICENESS), encoding="ascii")
    except OSError:
        return False
    return True


class StampOffset:
    """What the stamps are ahead of the simulated clock at its newest tick."""

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
        """In ns, at a tick of the simulated clock."""
        if self._is_simulated:
            return 0
        set_ns = self._reading().offset_ns
        if abs(set_ns - self._set_ns) > SET_NS:
            self._set_ns = set_ns
        return round(self._due_s() * 1e9) + self._set_ns - time_ns


def stood_offsets(offset_ns: int, lost_ns: int) -> List[int]:
    """Where stamps lie while the world stands still after a tick, one each 20 ms, up to the newest.

    Args:
        offset_ns: StampOffset.at that tick, the time included that the loop has lost.
        lost_ns: that time.
    """
    if not 0 < lost_ns <= MAX_STOOD_NS:
        return []
    period_ns = CLOCK_STEP.period_ns
    return [offset_ns - back_ns for back_ns in range((lost_ns - 1) // period_ns * period_ns, -1, -period_ns)]


def stamped(sensors: Sensors, offset_ns: int) -> Sensors:
    """The readings with their stamps so far ahead."""
    front, rear = (scan and scan._replace(stamp_ns=scan.stamp_ns + offset_ns)
                   for scan in (sensors.front_scan, sensors.rear_scan))
    return sensors._replace(time_ns=sensors.time_ns + offset_ns, front_scan=front, rear_scan=rear)
