"""Feeds the drive control node, measures the time from stop to zero, and prints the figures line by line.

Usage: python -m mtr_benchmarks.motion.latency_probe SAMPLES
"""
# SPDX-License-Identifier: Apache-2.0
import math
import random
import subprocess
import sys
import threading
import time
from typing import Any, List

import roslib.packages
import rospy
from geometry_msgs.msg import Twist
from nav_msgs.msg import Odometry
from sensor_msgs.msg import Imu, LaserScan

from mtr_benchmarks.harness.probe import cpu_s
from mtr_core import names
from mtr_description.base_controller import CONTROLLER, base_parameters_in
from mtr_description.shipped import shipped_base_file, shipped_urdf
from mtr_msgs.msg import MotionLock, PeripheralsState, RobotMode, VelocityCommand

BEAMS = 720
FIELD_OF_VIEW_RAD = 1.5 * math.pi
# An emergency stop from this speed lasts one period.
CRAWL_MPS = 0.03
GRAVITY_MPS2 = 9.81
START_LIMIT_S = 20.0
# Random pauses, so that stops fall anywhere between two of the node's ticks.
BETWEEN_STOPS_S = (0.15, 0.25)
JOIN_S = 1.0


class DriveControlFeed:
    """Publishes all inputs of drive control at their rates, from one thread; records when the wheel command becomes
    zero."""

    def __init__(self) -> None:
        self._is_stopped = threading.Event()
        self._is_over = threading.Event()
        self._is_zero = threading.Event()
        self._moves = threading.Event()
        self._stopped_at = self.latency_s = 0.0
        self._locks = [(self._topic(names.MOTION_LOCK, MotionLock), owner) for owner in ("dispatcher", "state_machine")]
        self._mode = self._topic(names.ROBOT_MODE, RobotMode)
        self._odometry = self._topic(names.WHEEL_ODOMETRY, Odometry)
        self._imu = self._topic(names.IMU_DATA, Imu)
        self._planner = self._topic(names.PLANNER_VELOCITY, VelocityCommand)
        self._peripherals = self._topic(names.PERIPHERALS_STATE, PeripheralsState)
        self._scans = [(self._topic(topic, LaserScan), frame) for topic, frame in (
            (names.FRONT_SCAN, names.FRONT_LIDAR), (names.REAR_SCAN, names.REAR_LIDAR))]
        self._wheels = rospy.Subscriber(names.WHEEL_COMMAND, Twist, self._take, tcp_nodelay=True)
        self._thread = threading.Thread(target=self._feed)

    def start(self) -> None:
        """Start publishing."""
        self._thread.start()

    def stop_once(self) -> float:
        """Engage the lock, wait for zero, and release the lock; return the latency in s."""
        if not self._moves.wait(START_LIMIT_S):
            raise RuntimeError("Drive control does not let the robot crawl.")
        self._is_zero.clear()
        self._stopped_at = time.monotonic()
        self._is_stopped.set()
        self._lock(0)
        if not self._is_zero.wait(JOIN_S):
            raise RuntimeError("Drive control did not stop.")
        self._is_stopped.clear()
        self._moves.clear()
        self._lock(0)
        return self.latency_s

    def close(self) -> None:
        """Stop the thread."""
        self._is_over.set()
        self._thread.join()

    @staticmethod
    def _topic(topic: str, kind: Any) -> rospy.Publisher:
        return rospy.Publisher(topic, kind, queue_size=10, tcp_nodelay=True)

    def _take(self, twist: Twist) -> None:
        if twist.linear.x > 0.9 * CRAWL_MPS:
            self._moves.set()
        elif self._is_stopped.is_set() and twist.linear.x == 0.0 and not self._is_zero.is_set():
            self.latency_s = time.monotonic() - self._stopped_at
            self._is_zero.set()

    def _lock(self, which: int) -> None:
        topic, owner = self._locks[which]
        message = MotionLock(owner=owner, engaged=self._is_stopped.is_set() and which == 0, reason="Stop.")
        self._publish(topic, message)

    @staticmethod
    def _publish(topic: rospy.Publisher, message: Any) -> None:
        message.header.stamp = rospy.Time.now()
        topic.publish(message)

    def _feed(self) -> None:
        turn = 0
        while not self._is_over.wait(0.02):
            turn += 1
            odometry = Odometry()
            odometry.pose.pose.orientation.w = 1.0
            self._publish(self._odometry, odometry)
            imu = Imu()
            imu.angular_velocity.z = 1e-3 * random.random()
            imu.linear_acceleration.z = GRAVITY_MPS2
            self._publish(self._imu, imu)
            if turn % 2:
                self._publish(self._planner, VelocityCommand(linear_mps=CRAWL_MPS, active=True))
                for topic, frame in self._scans:
                    self._publish(topic, sweep(frame))
            if turn % 5 == 0:
                self._publish(self._peripherals, PeripheralsState(alive=True, key_height_m=1.0, battery=1.0))
                self._publish(self._mode, RobotMode(max_speed_mps=1.0))
                self._lock(0)
                self._lock(1)


def sweep(frame: str) -> LaserScan:
    """Return a sweep with a wall about 3 m away in all directions, the highest load for drive control."""
    scan = LaserScan(angle_min=-FIELD_OF_VIEW_RAD / 2.0, angle_max=FIELD_OF_VIEW_RAD / 2.0,
                     angle_increment=FIELD_OF_VIEW_RAD / (BEAMS - 1), range_min=0.1, range_max=30.0,
                     ranges=[3.0 + 0.01 * random.random() for _ in range(BEAMS)])
    scan.header.frame_id = frame
    return scan


def main(samples: int) -> int:
    """Measure; return 0. Failures raise an error."""
    rospy.init_node("latency_probe")
    rospy.set_param(names.ROBOT_DESCRIPTION, shipped_urdf())
    rospy.set_param(f"/{CONTROLLER}", base_parameters_in(shipped_base_file()))
    node = subprocess.Popen([roslib.packages.find_node("mtr_drive_control", "drive_control_node")[0],
                             "__name:=drive_control"], stdout=subprocess.DEVNULL)
    feed = DriveControlFeed()
    feed.start()
    latencies: List[float] = []
    try:
        feed.stop_once()
        begun, used = time.monotonic(), cpu_s(node.pid)
        for _ in range(samples):
            latencies.append(feed.stop_once())
            time.sleep(random.uniform(*BETWEEN_STOPS_S))
        share = (cpu_s(node.pid) - used) / (time.monotonic() - begun)
    finally:
        feed.close()
        node.terminate()
        node.wait()
    for latency in latencies:
        print("latency_ms", 1e3 * latency)
    print("cpu_percent", 100.0 * share)
    return 0


if __name__ == "__main__":
    sys.exit(main(int(sys.argv[1])))
