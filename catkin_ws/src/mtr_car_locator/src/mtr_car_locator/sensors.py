"""Subscriptions of the locator: poses always, scans only when needed, maps when there is a new one."""
# SPDX-License-Identifier: Apache-2.0
import threading
import time
from typing import List, Optional

import rospy
from rospy.numpy_msg import numpy_msg
from sensor_msgs.msg import LaserScan

from mtr_core import names, schedule
from mtr_core.lockstep import StampedQueue
from mtr_core.lockstep.clock import is_lockstep
from mtr_core.lockstep.patience import patience_at_least_s
from mtr_description.mounts import LidarMounts
from mtr_msgs.msg import LocalizedPose
from mtr_msgs.msg import SurfaceMap as SurfaceMapMessage

from .conversions import robot_pose_from, scan_from, scan_mounts, surface_map_from
from .poses import RobotPose
from .scan import Scan
from .steps import SCAN_LAG_NS, ScanWindow, is_map_due
from .survey.surface_map import SurfaceMap

# A map announced by a pose is awaited like any other message: a shorter wait would depend on the machine load.
MAP_WAIT_WALL_S = schedule.PRODUCER_LOST_AFTER_WALL_S


class PoseSource:
    """Poses of the robot.

    Attributes:
        map_revision: map that the newest pose is in.
    """

    def __init__(self) -> None:
        self._queue = StampedQueue(names.LOCALIZED_POSE, LocalizedPose, schedule.LOCALIZATION, 0)
        self.map_revision = 0

    def take(self, tick_ns: int) -> List[RobotPose]:
        """Return the valid poses up to the tick, each once."""
        valid = [message for message in self._queue.take(tick_ns) if message.valid]
        if valid:
            self.map_revision = valid[-1].map_revision
        return [robot_pose_from(message) for message in valid]


class ScanSource:
    """Scans of the LiDARs while they are needed."""

    def __init__(self, lidars: LidarMounts, time_increment_s: float = 0.0):
        """Create a source. time_increment_s: time between beams, if the scans do not state it."""
        self._mounts, self._time_increment_s = scan_mounts(lidars), time_increment_s
        self._queues: List[StampedQueue] = []
        self._window = ScanWindow()

    def take(self, tick_ns: int, wanted: bool) -> List[Scan]:
        """Return the scans since the last tick."""
        self._window.follow(tick_ns, wanted)
        if not wanted:
            self._close()
            return []
        if not self._queues:
            self._queues = [StampedQueue(topic, numpy_msg(LaserScan), schedule.LIDAR, SCAN_LAG_NS)
                            for topic in self._mounts]
        return [scan_from(message, mount, topic == names.REAR_SCAN, self._time_increment_s)
                for queue, (topic, mount) in zip(self._queues, self._mounts.items())
                for message in queue.take(tick_ns) if self._window.counts(message.header.stamp.to_nsec())]

    def _close(self) -> None:
        for queue in self._queues:
            queue.close()
        self._queues = []


class MapSource:
    """Newest surface map of localization."""

    def __init__(self) -> None:
        self._changed = threading.Condition()
        self._message: Optional[SurfaceMapMessage] = None
        self._map: Optional[SurfaceMap] = None
        self._patience_s = patience_at_least_s(MAP_WAIT_WALL_S) if is_lockstep() else 0.0
        self._subscriber = rospy.Subscriber(names.SURFACE_MAP, SurfaceMapMessage, self._take, queue_size=2)

    def at(self, tick_ns: int, pose_revision: int) -> Optional[SurfaceMap]:
        """Return the map at a tick; in lock-step, wait for the map of the poses."""
        deadline = time.monotonic() + self._patience_s
        with self._changed:
            while self._revision() < pose_revision and time.monotonic() < deadline:
                self._changed.wait(deadline - time.monotonic())
            message = self._message
            if message is None:
                return None
            is_due = is_map_due(message.header.stamp.to_nsec(), tick_ns)
            return self._map if is_due or message.revision == pose_revision else None

    def _revision(self) -> int:
        return 0 if self._message is None else self._message.revision

    def _take(self, message: SurfaceMapMessage) -> None:
        with self._changed:
            self._message, self._map = message, surface_map_from(message)
            self._changed.notify_all()
