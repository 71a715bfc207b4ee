#!/usr/bin/env python3
"""The encrypted link of a running dispatcher: only a paired controller moves the robot, until it is revoked."""
# SPDX-License-Identifier: Apache-2.0
import pathlib
import secrets
import sys
import time
import unittest

import rospy
import rostest
import zmq

from mtr_core import names
from mtr_dispatcher.access.authorised_keys import AuthorisedKeys, Entry, Role
from mtr_dispatcher.access.key_folder import KeyFolder
from mtr_msgs.msg import MotionLock
from mtr_proto import robot_link_pb2 as link

LIMIT_S = 10.0
POLL_MS = 20


class Application:
    """The Operator's end of the link, encrypted with a key pair or not encrypted."""

    def __init__(self, robot_key, keys):
        self.session_id = secrets.randbits(62) | 1
        self.context = zmq.Context()
        self.statuses, self.commands = self.context.socket(zmq.SUB), self.context.socket(zmq.PUB)
        self.statuses.setsockopt(zmq.SUBSCRIBE, b"")
        for socket, port in ((self.statuses, "status_port"), (self.commands, "command_port")):
            socket.setsockopt(zmq.LINGER, 0)
            if keys is not None:
                socket.curve_publickey, socket.curve_secretkey = keys
                socket.curve_serverkey = robot_key
            socket.connect(f"tcp://127.0.0.1:{rospy.get_param('~' + port)}")

    def step(self):
        """Return the newest Status after answering it with a waypoint, or None without one."""
        newest = None
        while self.statuses.poll(0 if newest else POLL_MS):
            newest = link.Status.FromString(self.statuses.recv())
        if newest is not None:
            self.commands.send(link.Command(
                session_id=self.session_id, id=1, seen_status_id=newest.id, seen_robot_time_s=newest.sent_time_s,
                waypoint=link.Waypoint(id=1, x=1.0, y=2.0, heading=0.5)).SerializeToString())
        return newest

    def close(self):
        """Disconnect."""
        self.context.destroy(0)


class DispatcherEncrypted(unittest.TestCase):
    """Tests of one running dispatcher; no application is in control when a test begins."""

    @classmethod
    def setUpClass(cls):
        rospy.init_node("dispatcher_encrypted")
        cls.folder = KeyFolder(pathlib.Path(rospy.get_param("~key_folder")))
        cls.robot_key, cls.lock = cls.folder.own_keys().public, MotionLock(engaged=True)
        cls.subscriber = rospy.Subscriber(names.MOTION_LOCK, MotionLock, cls.take_lock)

    @classmethod
    def take_lock(cls, message):
        if message.owner == "dispatcher":
            cls.lock = message

    def setUp(self):
        self.folder.change(lambda known: AuthorisedKeys())
        # Wait until the application in control has timed out.
        self.until(lambda _: self.lock.engaged)

    def application(self, name="", role=Role.CONTROLLER):
        """Return an application that is paired under this name; without a name its key is unknown."""
        keys = zmq.curve_keypair()
        if name:
            entry = Entry(name, role, "2026-11-23", keys[0].decode())
            self.folder.change(lambda known: known.with_entry(entry))
        return self.opened(keys)

    def opened(self, keys):
        made = Application(self.robot_key, keys)
        self.addCleanup(made.close)
        return made

    def until(self, condition, *applications):
        """Return the first application's newest Status as soon as the condition holds."""
        status, end_s = None, time.monotonic() + LIMIT_S
        while time.monotonic() < end_s:
            if not applications:
                rospy.rostime.wallsleep(0.01)
            for number, application in enumerate(applications):
                found = application.step()
                status = (found or status) if number == 0 else status
            if condition(status):
                return status
        raise AssertionError("The condition was not fulfilled in time.")

    def test_paired_controller_moves_the_robot_until_its_key_is_revoked(self):
        jana, petr = self.application("Jana"), self.application("Petr")
        # The lock is published at once, the controller's name with the next Status.
        status = self.until(lambda status: status and status.controller_name == "Jana" and not self.lock.engaged, jana)
        self.assertEqual(status.session_id, jana.session_id)
        self.folder.change(lambda known: known.without("Jana"))
        self.until(lambda status: self.lock.engaged, petr, jana)
        self.until(lambda status: status and status.controller_name == "Petr", petr, jana)

    def test_strangers_move_nothing_and_are_counted_once_for_the_paired_viewer(self):
        eva = self.application("Eva", Role.VIEWER)
        status = self.until(lambda status: status and "connections_refused" in codes(status), eva,
                            self.application(), self.opened(None))
        self.assertTrue(self.lock.engaged)
        self.assertEqual(sum(notice.code == "connections_refused" for notice in status.notifications), 1)
        status = self.until(lambda status: status and "key_refused" in codes(status), eva)
        self.assertNotEqual(status.session_id, eva.session_id)
        self.assertTrue(self.lock.engaged)


def codes(status):
    """Return the codes of the notifications."""
    return {notice.code for notice in status.notifications}


if __name__ == "__main__":
    rostest.rosrun("mtr_dispatcher", "dispatcher_encrypted", DispatcherEncrypted, sys.argv)
