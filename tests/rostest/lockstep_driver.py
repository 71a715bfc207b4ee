#!/usr/bin/env python3
"""A node that drives the simulated robot in lock-step; prints a digest of what it saw, or falls silent."""
# SPDX-License-Identifier: Apache-2.0
import hashlib
import time

import rospy
from geometry_msgs.msg import Twist
from nav_msgs.msg import Odometry
from sensor_msgs.msg import Imu

from mtr_core import names, schedule
from mtr_core.lockstep import Ticker, TickInput

CRUISE_MPS = 0.4
TURN_GAIN_PER_M = 1.5


def main() -> None:
    """Drive for some ticks; decisions depend on what was seen, so that one late message changes all that follows."""
    rospy.init_node("lockstep_driver")
    digest = hashlib.sha256()
    odometry = TickInput(names.WHEEL_ODOMETRY, Odometry, schedule.SENSORS, lag_ns=0)
    imu = TickInput(names.IMU_DATA, Imu, schedule.SENSORS, lag_ns=0)
    wheels = rospy.Publisher(names.WHEEL_COMMAND, Twist, queue_size=10, tcp_nodelay=True)
    ticker = Ticker(schedule.DISPATCHER)
    for _ in range(rospy.get_param("~ticks")):
        tick_ns = ticker.sleep()
        # Work that takes this long on a slow machine.
        time.sleep(rospy.get_param("~work_wall_s"))
        seen, spin = odometry.at(tick_ns), imu.at(tick_ns)
        if seen is None or spin is None:
            # Started in the midst of time, where what is due now was said before it could hear it.
            continue
        place = seen.pose.pose.position
        digest.update(repr((tick_ns, seen.header.stamp.to_nsec(), place.x, place.y, seen.twist.twist.linear.x,
                            spin.header.stamp.to_nsec(), spin.angular_velocity.z)).encode())
        twist = Twist()
        twist.linear.x, twist.angular.z = CRUISE_MPS, TURN_GAIN_PER_M * place.x + spin.angular_velocity.z
        wheels.publish(twist)
        ticker.messages_sent += 1
    if rospy.get_param("~falls_silent"):
        while not rospy.is_shutdown():
            time.sleep(0.1)
    # What was sent last is counted by the simulator with the next hold.
    ticker.sleep()
    print(digest.hexdigest(), flush=True)


if __name__ == "__main__":
    main()
