"""The topics that the locator hears only while it needs them."""
# SPDX-License-Identifier: Apache-2.0
from typing import List, Optional

from rospy.numpy_msg import numpy_msg
from sensor_msgs.msg import LaserScan

from mtr_core import names, schedule
from mtr_core.schedule import CLOCK_STEP, MILLISECOND_NS
from mtr_core.se2 import Pose2
from mtr_lockstep import StampedQueue
from mtr_msgs.msg import LocalizedPose, MotionStatus

from .conversions import drive_from, scan_from
from .locator import CarLocator, Drive
from .parameters import LocatorParameters
from .scan import Scan

# A scan bears its first beam's time and is there when the sweep has ended; the pose of its last beam is there too then.
SCAN_LAG_NS = 100 * MILLISECOND_NS


class PoseSource:
    """Feeds the robot's poses to the locator while it needs them."""

    def __init__(self, locator: CarLocator):
        self._locator = locator
        self._queue: Optional[StampedQueue] = open_poses()

    def feed(self, tick_ns: int, needed: bool) -> None:
        """Hand over the poses up to the tick."""
        if needed and self._queue is None:
            self._queue = open_poses()
        if not needed and self._queue is not None:
            self._queue.close()
            self._queue = None
        for message in self._queue.take(tick_ns) if self._queue else []:
            if message.valid:
                pose = Pose2(message.x, message.y, message.heading)
                self._locator.add_pose(message.header.stamp.to_nsec() * 1e-9, pose)


def open_poses() -> StampedQueue:
    """Subscription to the robot's pose, which is there before the clock reaches its stamp."""
    return StampedQueue(names.LOCALIZED_POSE, LocalizedPose, schedule.LOCALIZATION, 0)


class MappingSources:
    """Scans and the motion planner's word, from the beginning of a mapping to its end."""

    def __init__(self, parameters: LocatorParameters):
        scan_type = numpy_msg(LaserScan)
        self._mounts = (parameters.base_from_front_lidar, parameters.base_from_rear_lidar)
        self._scans = tuple(StampedQueue(topic, scan_type, schedule.LIDAR, SCAN_LAG_NS)
                            for topic in (names.FRONT_SCAN, names.REAR_SCAN))
        self._statuses = StampedQueue(names.MOTION_STATUS, MotionStatus, schedule.MOTION_PLANNER, CLOCK_STEP.period_ns)
        self._drive: Optional[Drive] = None

    def scans(self, tick_ns: int) -> List[Scan]:
        """Scans that have come since the last tick."""
        return [scan_from(message, mount) for queue, mount in zip(self._scans, self._mounts)
                for message in queue.take(tick_ns)]

    def drive(self, tick_ns: int) -> Optional[Drive]:
        """Newest word of the motion planner."""
        for message in self._statuses.take(tick_ns)[-1:]:
            self._drive = drive_from(message)
        return self._drive

    def close(self) -> None:
        """End the subscriptions."""
        for queue in (*self._scans, self._statuses):
            queue.close()
