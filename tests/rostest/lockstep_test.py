#!/usr/bin/env python3
"""The simulator waits for a slow node, so that it gets the same answer, and neither for a silent nor for a dead one."""
# SPDX-License-Identifier: Apache-2.0
import signal
import sys
import threading
import time
import unittest

import rospy
import rostest
from nav_msgs.msg import Odometry
from node_process import NodeProcess
from rosgraph_msgs.msg import Clock, Log
from scripted_time import NS, wait_for

from mtr_core import names
from mtr_core.schedule import SIMULATION_START_NS

DRIVER = "lockstep_driver"
TICKS = 25
# Of a driver that is killed long before.
MANY_TICKS = 100_000
SLOW_WALL_S = 0.2
# Of docs/lock-step.md: a silent node is dropped after 5 s of wall time; a slow machine notices it somewhat later.
DROPPED_AFTER_WALL_S = (4.5, 15.0)
DRIVER_PERIOD_S = 0.1
# A tick of an encoder in 20 ms looks like 0.6 mm/s.
STANDING_MPS = 0.002


class LockStep(unittest.TestCase):
    """Each test has a simulator of its own."""

    @classmethod
    def setUpClass(cls):
        rospy.init_node("lockstep_test", disable_rostime=True)

    def setUp(self):
        self.simulator = NodeProcess("mtr_simulation", "simulator_node", "simulator", real_time_factor=0.0, seed=5,
                                     hold_for=[DRIVER])
        self.driver = None

    def tearDown(self):
        for process in (self.driver, self.simulator):
            if process:
                process.stop()

    def start_driver(self, **parameters):
        """A driver; returns its process."""
        self.driver = NodeProcess("mtr_tests", "lockstep_driver.py", DRIVER,
                                  **{"ticks": TICKS, "work_wall_s": 0.0, "falls_silent": False, **parameters})
        return self.driver

    def test_slow_node_sees_the_same_as_a_fast_one(self):
        fast = self.start_driver().output()
        self.tearDown()
        self.setUp()
        slow = self.start_driver(work_wall_s=SLOW_WALL_S).output()
        self.assertEqual(len(fast.strip()), 64, "The driver did not end well.")
        self.assertEqual(slow, fast)

    def test_node_that_is_killed_and_started_again_at_once_comes_back(self):
        watch = Watch()
        self.start_driver(ticks=MANY_TICKS)
        wait_for(lambda: watch.now_s > SIMULATION_START_NS * NS + 1.0, "a clock that goes on")
        self.driver.signal(signal.SIGKILL)
        self.driver.stop()
        again = self.start_driver()
        self.assertEqual(len(again.output().strip()), 64, "The driver that was started again did not end well.")
        wait_for(lambda: any(f"/{DRIVER} has ended" in text for text in watch.warnings), "a sentence")

    def test_silent_node_is_dropped_with_a_sentence_and_the_robot_stands(self):
        watch = Watch()
        last_tick_s = SIMULATION_START_NS * NS + TICKS * DRIVER_PERIOD_S
        self.start_driver(falls_silent=True)
        wait_for(lambda: watch.now_s > last_tick_s + 1.0, "a clock that goes on")
        stood_still_at_s, stood_still_wall_s = watch.longest_stop()
        self.assertAlmostEqual(stood_still_at_s, last_tick_s, delta=0.021)
        self.assertTrue(DROPPED_AFTER_WALL_S[0] < stood_still_wall_s < DROPPED_AFTER_WALL_S[1], stood_still_wall_s)
        wait_for(lambda: any(f"/{DRIVER} has been silent" in text for text in watch.warnings), "a sentence")
        self.assertLess(abs(watch.speed_mps), STANDING_MPS)


class Watch:
    """What is heard of the simulator.

    Attributes:
        now_s: its time.
        speed_mps: of the wheels.
        warnings: its sentences.
    """

    def __init__(self):
        self.now_s, self.speed_mps, self.warnings = 0.0, 0.0, []
        self._lock = threading.Lock()
        self._ticks = []
        self._subscribers = [rospy.Subscriber("/clock", Clock, self._take_clock, tcp_nodelay=True),
                             rospy.Subscriber(names.WHEEL_ODOMETRY, Odometry, self._take_odometry, tcp_nodelay=True),
                             rospy.Subscriber("/rosout", Log, lambda entry: self.warnings.append(entry.msg))]

    def longest_stop(self):
        """Time at which the clock stood still longest, and for how long in wall time."""
        with self._lock:
            stops = [(later[1] - tick[1], tick[0]) for tick, later in zip(self._ticks, self._ticks[1:])]
        duration_wall_s, at_s = max(stops)
        return at_s, duration_wall_s

    def _take_clock(self, message):
        with self._lock:
            self.now_s = message.clock.to_sec()
            self._ticks.append((self.now_s, time.monotonic()))

    def _take_odometry(self, message):
        self.speed_mps = message.twist.twist.linear.x


if __name__ == "__main__":
    rostest.rosrun("mtr_tests", "lockstep_test", LockStep, sys.argv)
