"""Records poses, clock and stops of a simulated robot until its input ends; then prints one line of JSON.

Usage: python -m mtr_benchmarks.gazebo.probe. It is a separate process, because each robot has its own ROS master.
"""
# SPDX-License-Identifier: Apache-2.0
import json
import sys
import threading
import time
from dataclasses import asdict
from typing import Any, Dict, Optional

import rospy
from nav_msgs.msg import Odometry
from rosgraph_msgs.msg import Clock

from mtr_core import names
from mtr_core.se2 import Pose2, heading_of
from mtr_msgs.msg import CarEstimate, DriveStatus, LocalizedPose

from ..harness.ros_shutdown import shut_down
from .noted import Notes

QUEUE = 500
# Every fifth of the 50 poses per second is sufficient.
EACH = 5


class Probe:
    """Records from its construction on."""

    def __init__(self) -> None:
        self.notes = Notes()
        self._map_from_car: Optional[Pose2] = None
        self._poses = 0
        self._lock = threading.Lock()
        for topic, kind, take in (("/clock", Clock, self._clock), (names.SIM_TRUTH, Odometry, self._truth),
                                  (names.CAR_ESTIMATE, CarEstimate, self._car),
                                  (names.LOCALIZED_POSE, LocalizedPose, self._pose),
                                  (names.DRIVE_STATUS, DriveStatus, self._status)):
            rospy.Subscriber(topic, kind, take, queue_size=QUEUE, tcp_nodelay=True)

    def _clock(self, message: Clock) -> None:
        pair = (time.monotonic(), message.clock.to_sec())
        with self._lock:
            self.notes.clock[1:] = [pair]

    def _truth(self, message: Odometry) -> None:
        pose = message.pose.pose
        with self._lock:
            self.notes.truth[message.header.stamp.to_nsec()] = (
                pose.position.x, pose.position.y, heading_of(pose.orientation.z, pose.orientation.w))

    def _car(self, message: CarEstimate) -> None:
        with self._lock:
            located = message.state == CarEstimate.LOCATED
            self._map_from_car = Pose2(message.x, message.y, message.heading) if located else None

    def _pose(self, message: LocalizedPose) -> None:
        with self._lock:
            self._poses += 1
            if self._map_from_car is None or not message.valid or self._poses % EACH:
                return
            pose = self._map_from_car.inverse() @ Pose2(message.x, message.y, message.heading)
            self.notes.believed.append((message.header.stamp.to_nsec(), pose.x, pose.y, pose.heading))

    def noted(self) -> Dict[str, Any]:
        """Return the observations so far, as JSON types."""
        with self._lock:
            return asdict(self.notes)

    def _status(self, message: DriveStatus) -> None:
        with self._lock:
            if message.blockages > self.notes.blockages:
                self.notes.blocked.append(message.message)
            self.notes.blockages = message.blockages


def main() -> int:
    """Record until the input ends; return the exit status."""
    rospy.init_node("gazebo_probe", anonymous=True, disable_signals=True, disable_rostime=True)
    probe = Probe()
    print("ready", flush=True)
    sys.stdin.read()
    print(json.dumps(probe.noted()), flush=True)
    shut_down("The run is over.")
    return 0


if __name__ == "__main__":
    sys.exit(main())
