"""Plays a recorded drive to the localization node at its own pace, measures its answers, and prints figures line by
line.

Usage: python -m mtr_benchmarks.localization.real_time_probe BAG SECONDS
"""
# SPDX-License-Identifier: Apache-2.0
import collections
import itertools
import subprocess
import sys
import threading
import time
from typing import Any, Deque, Dict, Iterator, List, NamedTuple, Tuple

import rosbag
import roslib.packages
import rospy
from nav_msgs.msg import Odometry
from sensor_msgs.msg import Imu, LaserScan
from tf2_msgs.msg import TFMessage

from mtr_benchmarks.harness.probe import cpu_s
from mtr_core import names
from mtr_description.shipped import shipped_urdf
from mtr_msgs.msg import LocalizedPose, MappingOrder

KINDS = {names.FRONT_SCAN: LaserScan, names.REAR_SCAN: LaserScan, names.IMU_DATA: Imu, names.WHEEL_ODOMETRY: Odometry,
         names.MAPPING_ORDER: MappingOrder, "/tf_static": TFMessage}
SCANS = (names.FRONT_SCAN, names.REAR_SCAN)
NODE_START_LIMIT_S = 20.0
# Time after the frozen map is in use, until its computation no longer loads the processor.
SETTLE_S = 2.0
# In a recording, the ends of both LiDARs' sweeps and the wheel odometry have the same stamp. These offsets identify the
# input that is answered.
APART_NS = {names.FRONT_SCAN: 0, names.REAR_SCAN: -2000, names.WHEEL_ODOMETRY: 2000}
# Tolerance for stamps, because the duration of a sweep has single precision.
SAME_STAMP_NS = 500


class RecordedMessage(NamedTuple):
    """One message of the recording and its recording time."""

    stamp: rospy.Time
    topic: str
    message: Any


class Latencies:
    """Measures the time from publishing a sweep to the first transform with the time of its end."""

    def __init__(self) -> None:
        self._lock = threading.Lock()
        self._waiting: Deque[Tuple[int, float]] = collections.deque()
        self.values_s: List[float] = []

    def sent(self, end_ns: int) -> None:
        """Note that a sweep is published now."""
        with self._lock:
            self._waiting.append((end_ns, time.monotonic()))

    def received(self, stamp_ns: int) -> None:
        """Note that a transform from map to odom was received."""
        with self._lock:
            for index, (end_ns, sent_s) in enumerate(self._waiting):
                if abs(end_ns - stamp_ns) < SAME_STAMP_NS:
                    self.values_s.append(time.monotonic() - sent_s)
                    del self._waiting[index]
                    return

    @property
    def unanswered(self) -> int:
        """Number of sweeps without a transform so far."""
        with self._lock:
            return len(self._waiting)


class LocalizationProbe:
    """Publishes the recording and receives the node's answers."""

    def __init__(self) -> None:
        self._topics = {topic: rospy.Publisher(topic, kind, queue_size=100, tcp_nodelay=True,
                                               latch=topic == "/tf_static") for topic, kind in KINDS.items()}
        self.latencies = Latencies()
        self._localized_since_s = 0.0
        self._measures = False
        self._answers = (rospy.Subscriber("/tf", TFMessage, self._take_transforms, tcp_nodelay=True),
                         rospy.Subscriber(names.LOCALIZED_POSE, LocalizedPose, self._take_pose, tcp_nodelay=True))

    def wait_for_node(self) -> None:
        """Wait until every topic has a subscriber."""
        deadline = time.monotonic() + NODE_START_LIMIT_S
        while not all(topic.get_num_connections() for topic in self._topics.values()):
            if time.monotonic() > deadline:
                raise RuntimeError("The localization node does not subscribe to all of its topics.")
            time.sleep(0.1)

    def play(self, entries: Iterator[RecordedMessage], node: int, measured_s: float) -> float:
        """Play until measured_s have been measured; return the node's share of one core during that time."""
        first = next(entries)
        begin_s, offset = time.monotonic(), rospy.Time.now() - first.stamp
        begun_s = used_s = 0.0
        for entry in itertools.chain([first], entries):
            time.sleep(max(0.0, begin_s + (entry.stamp - first.stamp).to_sec() - time.monotonic()))
            self._publish(entry, offset)
            now_s = time.monotonic()
            if not self._measures and self._localized_since_s and now_s > self._localized_since_s + SETTLE_S:
                self._measures, begun_s, used_s = True, now_s, cpu_s(node)
            if self._measures and now_s > begun_s + measured_s:
                return (cpu_s(node) - used_s) / (now_s - begun_s)
        raise RuntimeError("The recording ended before the frozen map had been used for long enough.")

    def _publish(self, entry: RecordedMessage, offset: rospy.Duration) -> None:
        message = entry.message
        if entry.topic != "/tf_static":
            message.header.stamp += offset
        if entry.topic in APART_NS:
            message.header.stamp += rospy.Duration(0, APART_NS[entry.topic])
        if self._measures and entry.topic in SCANS:
            self.latencies.sent(message.header.stamp.to_nsec() + round(1e9 * message.scan_time))
        self._topics[entry.topic].publish(message)

    def _take_transforms(self, message: TFMessage) -> None:
        for each in message.transforms:
            if each.header.frame_id == names.MAP:
                self.latencies.received(each.header.stamp.to_nsec())

    def _take_pose(self, pose: LocalizedPose) -> None:
        if pose.mode == LocalizedPose.LOCALIZED and not self._localized_since_s:
            self._localized_since_s = time.monotonic()


def recorded(path: str) -> Iterator[RecordedMessage]:
    """Yield the messages of the recording in order."""
    with rosbag.Bag(path) as bag:
        for topic, message, stamp in bag.read_messages(topics=list(KINDS)):
            yield RecordedMessage(stamp, topic, message)


def main(path: str, measured_s: float) -> int:
    """Measure; return 0. Failures raise an error."""
    rospy.init_node("localization_probe")
    rospy.set_param(names.ROBOT_DESCRIPTION, shipped_urdf())
    node = subprocess.Popen([roslib.packages.find_node("mtr_localization", "localization_node")[0],
                             "__name:=localization"], stdout=subprocess.DEVNULL)
    try:
        probe = LocalizationProbe()
        probe.wait_for_node()
        share = probe.play(recorded(path), node.pid, measured_s)
        deadline = time.monotonic() + 1.0
        while probe.latencies.unanswered and time.monotonic() < deadline:
            time.sleep(0.01)
    finally:
        node.terminate()
        node.wait()
    values: Dict[str, List[float]] = {"latency_ms": [1e3 * value for value in probe.latencies.values_s],
                                      "unanswered": [probe.latencies.unanswered], "cpu_percent": [100.0 * share]}
    for name, numbers in values.items():
        for number in numbers:
            print(name, number)
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1], float(sys.argv[2])))
