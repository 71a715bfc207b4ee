"""The machine's clock instead of the simulated one: nothing waits, and sensors are stamped as drivers do it."""
# SPDX-License-Identifier: Apache-2.0
import time
from typing import Callable

from mtr_core.errors import ConfigurationError

from ..sensors.readings import Sensors

REAL_TIME = 1.0


def offset_of(is_simulated: bool, real_time_factor: float,
              machine_ns: Callable[[], int] = time.time_ns) -> Callable[[int], int]:
    """What the stamps are ahead of the simulated clock, in ns, as a function of that clock at its ticks.

    Raises:
        ConfigurationError: the machine's clock cannot run faster.
    """
    if is_simulated:
        return lambda _: 0
    if real_time_factor != REAL_TIME:
        raise ConfigurationError(f"Parameter real_time_factor is {real_time_factor:g}; allowed without /use_sim_time "
                                 f"is {REAL_TIME:g}, the machine's own speed.")
    return lambda time_ns: machine_ns() - time_ns


def stamped(sensors: Sensors, offset_ns: int) -> Sensors:
    """The readings with their stamps so far ahead."""
    front, rear = (scan and scan._replace(stamp_ns=scan.stamp_ns + offset_ns)
                   for scan in (sensors.front_scan, sensors.rear_scan))
    return sensors._replace(time_ns=sensors.time_ns + offset_ns, front_scan=front, rear_scan=rear)
