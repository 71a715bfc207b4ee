#!/usr/bin/env python3
"""Serial bridge from the user's view: topics, a service, unplugging, a frozen device, and messages."""
# SPDX-License-Identifier: Apache-2.0
import json
import pathlib
import signal
import subprocess
import sys
import tempfile
import threading
import time
import unittest

import roslib.packages
import rospy
import rostest
from device_on_pty import DeviceOnPty
from diagnostic_msgs.msg import DiagnosticArray, KeyValue
from roscpp.srv import GetLoggers

from mtr_msgs.msg import FirmwareEcho, FirmwareHealth
from mtr_serial_link.connections import bytes_of, md5_of
from mtr_serial_link.fake_device import FakeSerialDevice
from mtr_serial_link.frames import SerialFrame, encode
from mtr_serial_link.wire import ReservedId, TopicInfo

LIMIT_S = 10.0
STOPPED_S = 1.5
# An order in transit when the bridge is stopped may still be sent; the bridge discards older ones.
MAX_ORDER_AGE_S = 0.6
ECHO, HEALTH, CALL, ANSWER = 125, 126, 101, 127


def info(topic_id, name, type_name, part=""):
    """Return a description with the local checksum."""
    return TopicInfo(topic_id, name, type_name, md5_of(type_name + part), 280)


def echo(seq):
    """Return a report of the device on its topic /device/echo."""
    return encode(SerialFrame(ECHO, bytes((seq,))))


ENDPOINTS = (
    (ReservedId.PUBLISHER, info(ECHO, "/device/echo", "mtr_msgs/FirmwareEcho")),
    (ReservedId.SUBSCRIBER, info(102, "/device/health", "mtr_msgs/FirmwareHealth")),
    (ReservedId.SERVICE_REQUEST, info(CALL, "/device/loggers", "roscpp/GetLoggers", "Request")),
    (ReservedId.SERVICE_RESPONSE, info(ANSWER, "/device/loggers", "roscpp/GetLoggers", "Response")),
)


# Topics expected by the bridge; the device describes more.
EXPECTED = ("from /device/echo mtr_msgs/FirmwareEcho", "to /device/health mtr_msgs/FirmwareHealth",
            "service /device/loggers roscpp/GetLoggers")
WHEELS = "/jackal_velocity_controller/cmd_vel"
FOREIGN = (ReservedId.PUBLISHER, info(128, WHEELS, "diagnostic_msgs/KeyValue"))


class MessageRecorder:
    """Waits for a matching message."""

    def __init__(self, topic, message_class):
        self._changed = threading.Condition()
        self._messages = []
        self._subscriber = rospy.Subscriber(topic, message_class, self._take)

    def _take(self, message):
        with self._changed:
            self._messages.append(message)
            self._changed.notify_all()

    def clear(self):
        with self._changed:
            self._messages.clear()

    def wait_for(self, fits, limit_s=LIMIT_S):
        with self._changed:
            return self._changed.wait_for(lambda: any(fits(message) for message in self._messages), limit_s)


class SerialBridgeTest(unittest.TestCase):
    """One bridge; each test has a new device on a new port."""

    def setUp(self):
        self._folder = tempfile.TemporaryDirectory()
        self.port = pathlib.Path(self._folder.name) / "board"
        self.board = DeviceOnPty(FakeSerialDevice(ENDPOINTS), self.port, echo(0))
        self.board.device.answers[CALL] = (ANSWER, lambda request: (0).to_bytes(4, "little"))
        self.diagnostics = MessageRecorder("/diagnostics", DiagnosticArray)
        self.echoes = MessageRecorder("/device/echo", FirmwareEcho)
        self.bridge = subprocess.Popen([roslib.packages.find_node("mtr_serial_link", "serial_bridge_node")[0],
                                        f"_port:={self.port}", "_service_timeout_s:=0.5",
                                        f"_topics:={json.dumps(EXPECTED)}"])

    def tearDown(self):
        self.bridge.send_signal(signal.SIGINT)
        self.assertEqual(self.bridge.wait(LIMIT_S), 0)
        self.board.unplug()
        self._folder.cleanup()

    def says(self, part):
        return self.diagnostics.wait_for(lambda message: part in message.status[0].message)

    def receives(self, seq):
        """Set the number reported by the device; return True when it arrives in ROS."""
        self.board.report = echo(seq)
        return self.echoes.wait_for(lambda message: message.seq == seq)

    def call(self):
        rospy.wait_for_service("/device/loggers", LIMIT_S)
        return rospy.ServiceProxy("/device/loggers", GetLoggers)()

    def test_topics_and_service_pass_and_are_back_after_a_replug(self):
        self.assertTrue(self.says("is missing"))
        for seq in (7, 8):
            self.board.plug()
            self.assertEqual(self.call().loggers, [])
            self.assertTrue(self.receives(seq))
            self.diagnostics.clear()
            self.board.unplug()
            self.assertTrue(self.says("is missing"))

    def test_message_reaches_the_device_as_it_was_sent(self):
        self.board.plug()
        publisher = rospy.Publisher("/device/health", FirmwareHealth, queue_size=1, latch=True)
        publisher.publish(FirmwareHealth(resets=513))
        self.call()
        self.assertTrue(self.says("linked"))
        self.assertTrue(self.receives(9))
        self.assertEqual(self.board.received(LIMIT_S), [bytes_of(FirmwareHealth(resets=513))])

    def test_call_to_a_frozen_device_fails_in_time_and_works_again_later(self):
        self.board.plug()
        self.call()
        self.board.frozen = True
        with self.assertRaises(rospy.ServiceException):
            self.call()
        self.assertTrue(self.says("fallen silent"))
        self.board.frozen = False
        self.diagnostics.clear()
        self.assertTrue(self.says("linked"))

    def test_foreign_topic_of_the_board_is_not_served_and_told(self):  # F1
        self.board.device.endpoints.append(FOREIGN)
        wheels = MessageRecorder(WHEELS, KeyValue)
        self.board.plug()
        self.board.report = echo(5) + encode(SerialFrame(128, bytes_of(KeyValue())))
        self.assertTrue(self.receives(5))
        self.assertTrue(self.diagnostics.wait_for(
            lambda message: message.status[0].level == 1 and any(WHEELS in value.key
                                                                 for value in message.status[0].values)))
        self.assertFalse(wheels.wait_for(lambda message: True, 1.0))

    def test_bridge_that_was_stopped_sends_no_old_order(self):  # F2, B8
        """Without the age limit, old frames reach the board when the bridge continues."""
        self.board.plug()
        publisher = rospy.Publisher("/device/health", FirmwareHealth, queue_size=1)
        self.call()
        started = time.monotonic()

        def speak(duration_s):
            until = time.monotonic() + duration_s
            while time.monotonic() < until:
                publisher.publish(FirmwareHealth(worst_loop_us=round(1e3 * (time.monotonic() - started))))
                time.sleep(0.02)
        speak(0.5)
        self.assertTrue(self.board.received(LIMIT_S))
        self.bridge.send_signal(signal.SIGSTOP)
        speak(STOPPED_S)
        self.board.device.received.clear()
        self.bridge.send_signal(signal.SIGCONT)
        went_on_ms = 1e3 * (time.monotonic() - started)
        speak(1.0)
        sent_ms = [FirmwareHealth().deserialize(payload).worst_loop_us for payload in self.board.received(LIMIT_S)]
        self.assertGreater(min(sent_ms), went_on_ms - 1e3 * MAX_ORDER_AGE_S)
        self.assertGreater(len(sent_ms), 5)

    def test_port_that_another_program_has_is_called_busy(self):
        self.board.plug()
        self.call()
        second = subprocess.Popen([roslib.packages.find_node("mtr_serial_link", "serial_bridge_node")[0],
                                   f"_port:={self.port}", "__name:=second"])
        self.assertTrue(self.says("is busy"))
        second.send_signal(signal.SIGINT)
        second.wait(LIMIT_S)


if __name__ == "__main__":
    rospy.init_node("serial_bridge_test")
    rostest.rosrun("mtr_serial_link", "serial_bridge", SerialBridgeTest, sys.argv)
