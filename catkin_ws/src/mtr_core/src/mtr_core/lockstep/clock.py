"""Time of the ROS clock in integer nanoseconds, the steady clock, and waiting without lost wake-ups."""
# SPDX-License-Identifier: Apache-2.0
import functools
import time
from typing import Callable

import rospy
from rospy.rostime import get_rostime_cond

from mtr_core.liveness import Instant
from mtr_core.schedule import MILLISECOND_NS

# Each /clock message notifies the condition; the time-out only bounds the delay of a shutdown.
SHUTDOWN_CHECK_S = 0.2
# If the two readings are farther apart than this, a clock step in between is not detectable, and they are repeated.
READING_APART_NS = 2 * MILLISECOND_NS
READINGS = 5
# In addition to /use_sim_time; without it, simulated time does not wait for the nodes, as with other simulators.
LOCKSTEP_PARAMETER = "/lockstep"
# Set for the clock of a replay, which waits for the nodes' ticks while the nodes do not wait for each other.
HELD_PARAMETER = "/held_clock"


def is_simulated() -> bool:
    """Return True if /use_sim_time is set, so that time comes from /clock."""
    return not rospy.rostime.is_wallclock()


def is_lockstep() -> bool:
    """Return True if the simulated clock waits for the nodes' holds, and they for each other: LOCKSTEP_PARAMETER."""
    return is_simulated() and _is_wanted(LOCKSTEP_PARAMETER)


def is_held() -> bool:
    """Return True if the simulated clock waits for the nodes' holds, as in lock-step: HELD_PARAMETER."""
    return is_lockstep() or (is_simulated() and _is_wanted(HELD_PARAMETER))


@functools.lru_cache(maxsize=None)
def _is_wanted(parameter: str) -> bool:
    return bool(rospy.get_param(parameter, False))


def now_ns() -> int:
    """Return the ROS time in nanoseconds."""
    return rospy.get_rostime().to_nsec()


def steady_ns() -> int:
    """Return the steady time for ages, which is never set, in nanoseconds. In simulation it is the simulated time."""
    return now_ns() if is_simulated() else _boot_time_ns()


def steady_at(tick_ns: int) -> int:
    """Return the steady time at the current tick; in lock-step the tick itself, however late the machine is."""
    return tick_ns if is_lockstep() else steady_ns()


def reading() -> Instant:
    """Return both clocks at one instant."""
    if is_simulated():
        now = now_ns()
        return Instant(now, now)
    for _ in range(READINGS):
        before, now, after = _boot_time_ns(), now_ns(), _boot_time_ns()
        if after - before < READING_APART_NS:
            break
    return Instant(now, (before + after) // 2)


def stamp_of(time_ns: int) -> rospy.Time:
    """Return nanoseconds as the stamp of a message."""
    return rospy.Time(time_ns // 1_000_000_000, time_ns % 1_000_000_000)


def wait_until(time_ns: int, meanwhile: Callable[[], None] = lambda: None) -> None:
    """Return at the given ROS time; rospy.ROSInterruptException on shutdown. meanwhile: called regularly while
    simulated time does not advance.

    rospy.sleep checks the time outside its condition variable, so it can miss the wake-up when the clock stops at a
    barrier. Here the check holds the lock.
    """
    if not is_simulated():
        rospy.sleep((time_ns - now_ns()) * 1e-9)
    else:
        condition = get_rostime_cond()
        with condition:
            while now_ns() < time_ns and not rospy.is_shutdown():
                condition.wait(SHUTDOWN_CHECK_S)
                meanwhile()
    if rospy.is_shutdown():
        raise rospy.ROSInterruptException("shutdown")


def _boot_time_ns() -> int:
    """Return the same time as steady_time.hpp: it is never set and includes the time of a suspended machine."""
    return time.clock_gettime_ns(time.CLOCK_BOOTTIME)
