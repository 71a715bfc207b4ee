"""Publishes satellite fixes from the simulated robot's true position, because the simulator has no receiver."""
# SPDX-License-Identifier: Apache-2.0
import math

import rospy
from nav_msgs.msg import Odometry
from sensor_msgs.msg import NavSatFix, NavSatStatus

from mtr_core import names

PERIOD_S = 0.2
# Arbitrary origin; metres per degree of latitude there, WGS 84.
LATITUDE_DEG, LONGITUDE_DEG, METRES_PER_DEG = 50.0, 14.0, 111_229.0
# 1 sigma with corrections (RTK), m.
SIGMA_M = 0.02


class Receiver:
    """Publishes a fix five times per second of the robot's clock."""

    def __init__(self) -> None:
        self._publisher = rospy.Publisher(names.NAVSAT_FIX, NavSatFix, queue_size=10, tcp_nodelay=True)
        self._said_s = -math.inf

    def take(self, truth: Odometry) -> None:
        """Publish a fix at the robot's true position, if one is due."""
        now_s = truth.header.stamp.to_sec()
        if now_s - self._said_s < PERIOD_S:
            return
        self._said_s = now_s
        place = truth.pose.pose.position
        fix = NavSatFix(latitude=LATITUDE_DEG + place.y / METRES_PER_DEG,
                        longitude=LONGITUDE_DEG + place.x / (METRES_PER_DEG * math.cos(math.radians(LATITUDE_DEG))),
                        position_covariance_type=NavSatFix.COVARIANCE_TYPE_KNOWN)
        fix.header.stamp, fix.header.frame_id = truth.header.stamp, "base_link"
        fix.status.status = NavSatStatus.STATUS_GBAS_FIX
        fix.position_covariance = [SIGMA_M ** 2, 0.0, 0.0, 0.0, SIGMA_M ** 2, 0.0, 0.0, 0.0, SIGMA_M ** 2]
        self._publisher.publish(fix)
