"""Time of the ROS clock in integer nanoseconds, and waiting for it without lost wake-ups."""
# SPDX-License-Identifier: Apache-2.0
import rospy
from rospy.rostime import get_rostime_cond

# The condition is notified on each /clock message; the time-out only bounds how late a shutdown is noticed.
SHUTDOWN_CHECK_S = 0.2


def is_simulated() -> bool:
    """True when /use_sim_time is set, so that time comes from /clock."""
    return not rospy.rostime.is_wallclock()


def now_ns() -> int:
    """ROS time in nanoseconds."""
    return rospy.get_rostime().to_nsec()


def stamp_of(time_ns: int) -> rospy.Time:
    """Nanoseconds as the stamp of a message."""
    return rospy.Time(time_ns // 1_000_000_000, time_ns % 1_000_000_000)


def wait_until(time_ns: int) -> None:
    """Return at the given ROS time; rospy.ROSInterruptException on shutdown.

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
    if rospy.is_shutdown():
        raise rospy.ROSInterruptException("shutdown")
