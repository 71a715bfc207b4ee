"""Time of the ROS clock in integer nanoseconds, the steady clock beside it, and waiting without lost wake-ups."""
# SPDX-License-Identifier: Apache-2.0
import functools
import time
from typing import Callable

import rospy
from rospy.rostime import get_rostime_cond

from mtr_core.liveness import Instant
from mtr_core.schedule import MILLISECOND_NS

# The condition is notified on each /clock message; the time-out only bounds how late a shutdown is noticed.
SHUTDOWN_CHECK_S = 0.2
# Two clocks read this far apart do not tell whether one of them was set in between; so many readings are tried.
READING_APART_NS = 2 * MILLISECOND_NS
READINGS = 5
# Beside /use_sim_time; without it simulated time is taken as it comes, as another simulator's.
LOCKSTEP_PARAMETER = "/lockstep"
# The same of a replay's clock, which waits for the nodes' ticks while they do not wait for each other.
HELD_PARAMETER = "/held_clock"


def is_simulated() -> bool:
    """True when /use_sim_time is set, so that time comes from /clock."""
    return not rospy.rostime.is_wallclock()


def is_lockstep() -> bool:
    """True when the simulated clock waits for the nodes' holds, and they for each other: LOCKSTEP_PARAMETER."""
    return is_simulated() and _is_wanted(LOCKSTEP_PARAMETER)


def is_held() -> bool:
    """True when the simulated clock waits for the nodes' holds, as in lock-step: HELD_PARAMETER."""
    return is_lockstep() or (is_simulated() and _is_wanted(HELD_PARAMETER))


@functools.lru_cache(maxsize=None)
def _is_wanted(parameter: str) -> bool:
    return bool(rospy.get_param(parameter, False))


def now_ns() -> int:
    """ROS time in nanoseconds."""
    return rospy.get_rostime().to_nsec()


def steady_ns() -> int:
    """Time for liveness in nanoseconds: nobody sets this clock. In simulation it is the simulated one."""
    return now_ns() if is_simulated() else _boot_time_ns()


def steady_at(tick_ns: int) -> int:
    """The steady clock's time at a tick at hand; in lock-step the tick itself, however late the machine is."""
    return tick_ns if is_lockstep() else steady_ns()


def reading() -> Instant:
    """Both clocks at one instant."""
    if is_simulated():
        now = now_ns()
        return Instant(now, now)
    for _ in range(READINGS):
        before, now, after = _boot_time_ns(), now_ns(), _boot_time_ns()
        if after - before < READING_APART_NS:
            break
    return Instant(now, (before + after) // 2)


def stamp_of(time_ns: int) -> rospy.Time:
    """Nanoseconds as the stamp of a message."""
    return rospy.Time(time_ns // 1_000_000_000, time_ns % 1_000_000_000)


def wait_until(time_ns: int, meanwhile: Callable[[], None] = lambda: None) -> None:
    """Return at the given ROS time; rospy.ROSInterruptException on shutdown. meanwhile: called while simulated time
    stands still, every now and then.

    rospy.sleep checks the time outside its condition variable, so a clock that stands still at a barrier can cost it
    a wake-up; here the check is under the lock.
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
    """As in steady_time.hpp: nobody sets it, and it counts the time for which the machine was suspended."""
    return time.clock_gettime_ns(time.CLOCK_BOOTTIME)
