"""Mutated Statuses at the inbox, and what a test does with those that are taken."""
# SPDX-License-Identifier: Apache-2.0
import json
import math

from mtr_operator.domain.actions.pose_history import PoseHistory
from mtr_operator.domain.geometry.axes import axes_around
from mtr_operator.domain.ports import LinkStatistics
from mtr_operator.domain.results.journal import plain_fields
from mtr_operator.domain.results.progress import Progress, car_from
from mtr_operator.robot_link.conversions import status_message_from
from mtr_operator.robot_link.inbox import Inbox
from mtr_operator.robot_link.virtual.robot import VirtualRobot

FLOATS = (math.nan, math.inf, -math.inf, 0.0, -0.0, -1.0, 1e-30, 1e6, 1e9, 1e30, -1e30, 3.4e38, 0.5)
WHOLES = (0, 1, -1, 100, 101, 2 ** 31 - 1, 2 ** 32 - 1, 2 ** 63, 2 ** 64 - 1)
# So far from the robot's clock in s that no test is meant.
LATEST_S = 1e12


def prepare(_):
    """The case of this border."""
    robot = VirtualRobot(1)
    for _ in range(100):
        robot.step()
    messages = []
    for _ in range(50):
        robot.step()
        messages.append(status_message_from(robot.status()))

    def case(chance):
        message = type(messages[0])()
        message.CopyFrom(chance.choice(messages))
        for _ in range(chance.randint(1, 3)):
            spoil(message, chance)
        payload = message.SerializePartialToString()
        if chance.random() < 0.3:
            payload = spoilt_bytes(payload, chance)
        return try_status(payload)
    return case


def spoil(message, chance):
    """Give a field of the message, or of one within it, another value."""
    field = chance.choice(message.DESCRIPTOR.fields)
    is_list = field.label == field.LABEL_REPEATED
    if field.cpp_type == field.CPPTYPE_MESSAGE:
        spoil(getattr(message, field.name).add() if is_list else getattr(message, field.name), chance)
        return
    if field.cpp_type in (field.CPPTYPE_DOUBLE, field.CPPTYPE_FLOAT):
        values = FLOATS
    elif field.cpp_type == field.CPPTYPE_STRING:
        values = ("", "x" * 300, "\0", "\N{DEGREE SIGN}" * 100)
    elif field.cpp_type == field.CPPTYPE_ENUM:
        values = [value.number for value in field.enum_type.values]
    else:
        values = WHOLES
    value = chance.choice(values)
    try:
        if is_list:
            getattr(message, field.name).extend([value] * chance.choice((1, 3, 1001)))
        else:
            setattr(message, field.name, value)
    except (ValueError, TypeError):
        message.ClearField(field.name)


def spoilt_bytes(payload, chance):
    """With bits flipped, or cut."""
    content = bytearray(payload)
    for _ in range(chance.randint(1, 5)):
        content[chance.randrange(len(content))] ^= 1 << chance.randrange(8)
    return bytes(content[:chance.randrange(len(content))] if chance.random() < 0.2 else content)


def try_status(payload):
    """Take it, and use it as a test does."""
    statistics = LinkStatistics()
    inbox = Inbox(statistics)
    inbox.put([payload])
    status = inbox.take()
    if status is None:
        return "refused", "" if statistics.last_error else "refused without a sentence"
    poses = PoseHistory()
    poses.add(status)
    if status.car is not None:
        axes_around(status.car, 0.05)
        json.dumps(Progress("autolock", {}, {}, car_from(plain_fields(status.car))).to_document(), allow_nan=False)
    return "taken", nonsense_in(status)


def nonsense_in(status):
    """What was accepted and cannot be; told independently of the application's own limits."""
    if not 0 <= status.stamp_s < LATEST_S:
        return f"stamp {status.stamp_s}"
    car = status.car
    if car is not None and not (0.5 < car.length < 40 and 0.3 < car.width < 8 and 0 <= car.length_sigma < 10
                                and 0 <= car.width_sigma < 10):
        return f"Car {car.length} m x {car.width} m"
    if not status.pose_valid:
        return ""
    for name, largest in (("x", 2000.0), ("y", 2000.0), ("heading", 100.0), ("speed_mps", 20.0), ("key_x", 10.0),
                          ("key_y", 10.0)):
        if not abs(getattr(status, name)) < largest:
            return f"{name} {getattr(status, name)}"
    if not (math.isnan(status.position_sigma_m) or 0 < status.position_sigma_m < 1000):
        return f"position sigma {status.position_sigma_m}"
    return ""
