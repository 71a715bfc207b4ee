"""Ticks of the periodic nodes, and the sample of a producer that is due at a given time.

All times are integer nanoseconds of the ROS clock, so that a tick is exact. A tick of a slot is a time `n * period +
phase`. Phases are staggered so that a decision passes from node to node within one period of the slowest.
"""
# SPDX-License-Identifier: Apache-2.0
from dataclasses import dataclass

MILLISECOND_NS = 1_000_000


@dataclass(frozen=True)
class Slot:
    """Period and phase of one periodic producer, in nanoseconds."""

    period_ns: int
    phase_ns: int

    def next_after(self, time_ns: int) -> int:
        """Return the first tick later than time_ns."""
        return self.last_at(time_ns) + self.period_ns

    def last_at(self, time_ns: int) -> int:
        """Return the last tick not later than time_ns."""
        return (time_ns - self.phase_ns) // self.period_ns * self.period_ns + self.phase_ns


def slot(period_ms: int, phase_ms: int = 0) -> Slot:
    """Return a slot with period and phase in milliseconds."""
    return Slot(period_ms * MILLISECOND_NS, phase_ms * MILLISECOND_NS)


# Smallest step of /clock in simulation; every period and phase below is a multiple of it.
CLOCK_STEP = slot(20)

SENSORS = slot(20)
LOCALIZATION = slot(20)
DRIVE_CONTROL = slot(20)
MOTION_PLANNER = slot(40)
LIDAR = slot(40)
FIRMWARE = slot(40)
CONTROLLER_INPUT = slot(40)
DISPATCHER = slot(100)
STATE_MACHINE = slot(100, 20)
PERIPHERALS = slot(100, 40)
CAR_LOCATOR = slot(100, 60)

# Time at which a simulated clock starts; no tick is earlier. It is not zero, because zero means "no time yet" in ROS.
SIMULATION_START_NS = 1_000 * MILLISECOND_NS

# Wall time after which a producer that delays a simulated tick counts as dead. Consumers then no longer wait for it
# until its next message, and see the age of its last sample grow.
PRODUCER_LOST_AFTER_WALL_S = 4.0
# Share of that wait for a producer that was given up and has been late since. A producer that is late at every tick,
# such as behind an injected delay, would cost the whole wait each time.
LATE_PRODUCER_SHARE = 0.1
# Number of a producer's samples that a consumer stores.
KEPT_SAMPLES = 64
