"""Publishes the robot's orders under other names, so that the playback of a recording cannot move a robot."""
# SPDX-License-Identifier: Apache-2.0
from typing import Any, Callable, List, Mapping

import rospy
from geometry_msgs.msg import Twist
from sensor_msgs.msg import Joy

from mtr_core import names
from mtr_msgs.msg import FirmwareCommand, FirmwarePress, FirmwareSignals, LiftCommand, MotionLock, VelocityCommand

from .profiles import PROFILES, recorded_name

TYPES: Mapping[str, Any] = {
    names.JOY: Joy, names.WHEEL_COMMAND: Twist, names.PLANNER_VELOCITY: VelocityCommand,
    names.MANUAL_VELOCITY: VelocityCommand, names.MANUAL_LIFT: LiftCommand, names.MOTION_LOCK: MotionLock,
    names.FIRMWARE_COMMAND: FirmwareCommand, names.FIRMWARE_PRESS: FirmwarePress,
    names.FIRMWARE_SIGNALS: FirmwareSignals}
QUEUE = 100


def relay_orders(profile: str, resolve: Callable[[str], str]) -> List[rospy.Subscriber]:
    """Start to relay the orders of a profile. resolve: returns the name of a topic on this robot."""
    return [_relay(resolve(topic), kind) for topic, kind in TYPES.items() if topic in PROFILES[profile]]


def _relay(topic: str, kind: Any) -> rospy.Subscriber:
    publisher = rospy.Publisher(recorded_name(topic), kind, queue_size=QUEUE, tcp_nodelay=True)
    return rospy.Subscriber(topic, kind, publisher.publish, queue_size=QUEUE, tcp_nodelay=True)
