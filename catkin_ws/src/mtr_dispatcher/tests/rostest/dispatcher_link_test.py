#!/usr/bin/env python3
"""Commands in, DesiredState and Status out, on the robot's own clock."""
# SPDX-License-Identifier: Apache-2.0
import secrets
import sys
import time
import unittest

import rospkg
import rospy
import rostest
import zmq
from sensor_msgs.msg import LaserScan

from mtr_core import names
from mtr_msgs.msg import DesiredState, DriveStatus, LocalizedPose, MotionLock, RobotMode
from mtr_proto import robot_link_pb2 as link

LIMIT_S = 5.0


class Application:
    """The Operator's end of the link."""

    def __init__(self, status_port, command_port):
        self.session_id, self.number = secrets.randbits(63) | 1, 0
        context = zmq.Context.instance()
        self._statuses, self._commands = context.socket(zmq.SUB), context.socket(zmq.PUB)
        self._statuses.setsockopt(zmq.SUBSCRIBE, b"")
        self._statuses.connect(f"tcp://127.0.0.1:{status_port}")
        self._commands.connect(f"tcp://127.0.0.1:{command_port}")

    def status(self):
        """Return the next Status."""
        if not self._statuses.poll(1000 * LIMIT_S):
            raise AssertionError("The robot is silent.")
        return link.Status.FromString(self._statuses.recv())

    def status_where(self, condition):
        """Return the first Status that fulfils the condition."""
        deadline = time.monotonic() + LIMIT_S
        while time.monotonic() < deadline:
            status = self.status()
            if condition(status):
                return status
        raise AssertionError("No Status fulfilled the condition in time.")

    def send(self, status, **content):
        """Answer the Status."""
        self._commands.send(link.Command(session_id=self.session_id, id=self.number, seen_status_id=status.id,
                                         seen_robot_time_s=status.sent_time_s, **content).SerializeToString())

    def send_bytes(self, data):
        """Send bytes that need not be a Command."""
        self._commands.send(data)

    def insist(self, condition, **content):
        """Answer each Status with a new Command until one fulfils the condition."""
        self.number += 1

        def answered(status):
            self.send(status, **content)
            return condition(status)
        return self.status_where(answered)

    def close(self):
        """Disconnect."""
        self._statuses.close(0)
        self._commands.close(100)


class DispatcherLink(unittest.TestCase):
    """Each test is one application's session, from its first Command to its end."""

    @classmethod
    def setUpClass(cls):
        rospy.init_node("dispatcher_link")
        cls.desired, cls.lock = DesiredState(), MotionLock()
        cls.subscribers = [rospy.Subscriber(names.DESIRED_STATE, DesiredState, cls.take_desired),
                           rospy.Subscriber(names.MOTION_LOCK, MotionLock, cls.take_lock)]
        cls.mode = rospy.Publisher(names.ROBOT_MODE, RobotMode, queue_size=1)

    @classmethod
    def take_desired(cls, message):
        cls.desired = message

    @classmethod
    def take_lock(cls, message):
        if message.owner == "dispatcher":
            cls.lock = message

    def setUp(self):
        self.application = Application(rospy.get_param("~status_port"), rospy.get_param("~command_port"))
        self.application.insist(lambda status: status.session_id == self.application.session_id,
                                waypoint=link.Waypoint(id=1, x=1.0, y=2.0, heading=0.5))

    def tearDown(self):
        self.application.insist(lambda status: status.session_id == 0, end_session=True)
        self.assertTrue(self.eventually(lambda: self.lock.engaged and self.desired.stop))
        self.application.close()

    def eventually(self, condition):
        """Wait until the condition holds; return False after LIMIT_S."""
        deadline = time.monotonic() + LIMIT_S
        while not condition() and time.monotonic() < deadline:
            rospy.rostime.wallsleep(0.005)
        return condition()

    def test_command_moves_the_robot(self):
        self.assertTrue(self.eventually(lambda: self.desired.waypoint.id == 1 and not self.lock.engaged))
        self.assertEqual((self.desired.waypoint.x, self.desired.waypoint.frame_id), (1.0, names.CAR))
        self.assertTrue(self.desired.link_alive)

    def test_stop_command_locks_the_robot(self):
        self.application.insist(lambda status: status.command_id == self.application.number, stop=True)
        self.assertTrue(self.eventually(lambda: self.lock.engaged and self.desired.stop))
        self.assertIn("Operator", self.lock.reason)

    def test_silent_link_stops_the_robot_until_the_same_command_arrives(self):
        silent_since = time.monotonic()
        lost = self.application.status_where(lambda status: "link_lost" in codes(status))
        self.assertTrue(0.7 < time.monotonic() - silent_since < 1.5)  # A5
        self.assertTrue(self.eventually(lambda: self.lock.engaged and not self.desired.link_alive))
        self.application.send(lost, waypoint=link.Waypoint(id=1, x=1.0, y=2.0, heading=0.5))
        self.assertTrue(self.eventually(lambda: not self.lock.engaged and self.desired.waypoint.id == 1))

    def test_command_that_comes_too_late_moves_nothing(self):
        old = self.application.status()
        self.application.status_where(lambda status: status.sent_time_s > old.sent_time_s + 1.2)
        self.application.send(old)
        self.application.status_where(lambda status: "command_expired" in codes(status))
        self.assertTrue(self.lock.engaged)

    def test_bad_messages_are_counted_reported_and_ignored(self):
        before = self.application.status().rejected_messages
        self.application.send_bytes(b"\xff\xff")
        self.application.send_bytes(bytes(60_000))
        status = self.application.status_where(lambda status: status.rejected_messages == before + 2)
        self.assertIn("bad_message", codes(status))
        self.assertFalse(self.lock.engaged)

    def test_second_application_does_not_get_control(self):
        other = Application(rospy.get_param("~status_port"), rospy.get_param("~command_port"))
        other.number = 1

        def rejected(status):
            self.application.send(status, waypoint=link.Waypoint(id=1, x=1.0, y=2.0, heading=0.5))
            other.send(status)
            return "controlled_by_other" in codes(status)
        status = self.application.status_where(rejected)
        self.assertEqual(status.session_id, self.application.session_id)
        other.close()

    def test_watching_application_releases_the_lock_for_a_person_and_claims_nothing(self):
        self.application.insist(lambda status: status.session_id == 0, end_session=True)
        self.assertTrue(self.eventually(lambda: self.lock.engaged))
        watching = Application(rospy.get_param("~status_port"), rospy.get_param("~command_port"))
        watching.insist(lambda status: status.session_id == 0 and not self.lock.engaged, watches=True)
        # Only manual control is possible.
        self.assertTrue(self.desired.stop and not self.desired.session_id)
        watching.close()
        self.assertTrue(self.eventually(lambda: self.lock.engaged))

    def test_folders_of_the_robot_are_left_for_a_preflight(self):
        written = rospy.get_param(names.WRITTEN_FOLDERS)
        self.assertEqual(written, [rospkg.get_ros_home(), rospkg.get_log_dir(), "/robot/memory"])

    def test_lidars_and_obstacle_are_seen(self):
        scan = rospy.Publisher(names.FRONT_SCAN, LaserScan, queue_size=1)
        pose = rospy.Publisher(names.LOCALIZED_POSE, LocalizedPose, queue_size=1)
        drive = rospy.Publisher(names.DRIVE_STATUS, DriveStatus, queue_size=1)
        self.assertTrue(self.eventually(lambda: all(each.get_num_connections() for each in (scan, pose, drive))))

        def is_seen(status):
            now = rospy.Time.now()
            for publisher, message in ((scan, LaserScan(ranges=[2.0, 2.0], range_max=30.0)), (pose, LocalizedPose()),
                                       (drive, DriveStatus(zone=DriveStatus.BLOCKED, obstacle_m=0.5))):
                message.header.stamp = now
                publisher.publish(message)
            return len(status.surroundings.points_cm) == 4
        status = self.application.status_where(is_seen)
        self.assertEqual(status.surroundings.zone, link.STOP_ZONE_BLOCKED)
        self.assertAlmostEqual(status.surroundings.obstacle_m, 0.5)
        for publisher in (scan, pose, drive):
            publisher.unregister()

    def test_confirmation_is_sent_at_once(self):
        self.assertTrue(self.eventually(lambda: self.mode.get_num_connections() > 0))
        delays_s = []
        for attempt in range(6):
            # Just after a periodic Status the next one is almost a period away.
            self.application.status()
            message = RobotMode(mode=4, session_id=self.application.session_id, waypoint_id=1,
                                waypoint_result=1 + attempt % 2)
            message.header.stamp = rospy.Time.now()
            self.mode.publish(message)
            status = self.application.status_where(
                lambda status, message=message: status.waypoint_result == message.waypoint_result)
            delays_s.append(status.sent_time_s - message.header.stamp.to_sec())
        self.assertLess(min(delays_s), 0.06)


def codes(status):
    """Codes of the notifications."""
    return {notice.code for notice in status.notifications}


if __name__ == "__main__":
    rostest.rosrun("mtr_dispatcher", "dispatcher_link", DispatcherLink, sys.argv)
