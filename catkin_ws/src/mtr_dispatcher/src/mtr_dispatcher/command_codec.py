"""Decodes the bytes of the link into a Command."""
# SPDX-License-Identifier: Apache-2.0
import math
from typing import Any, Optional

from google.protobuf.message import DecodeError

from mtr_core import names
from mtr_core.problems import ProblemError
from mtr_core.requests import Press, Waypoint, application
from mtr_core.se2 import Pose2
from mtr_proto import robot_link_pb2 as link
from mtr_proto.parsing import parse_whole

from . import problems
from .area.order import AreaOrder
from .command import Command

# A Command has about 200 bytes.
MAX_MESSAGE_BYTES = 64 * 1024


class UndecodableError(ProblemError):
    """The bytes are not a valid Command."""


def decode(data: bytes) -> Command:
    """Return the Command in the bytes; raises UndecodableError with a sentence."""
    if len(data) > MAX_MESSAGE_BYTES:
        raise UndecodableError(problems.OVERSIZED(size=len(data), maximum=MAX_MESSAGE_BYTES))
    message = link.Command()
    try:
        parse_whole(message, data)
    except DecodeError:
        raise UndecodableError(problems.UNDECODABLE(size=len(data))) from None
    if not message.session_id or not message.id:
        raise UndecodableError(problems.INCOMPLETE())
    return Command(
        session_id=message.session_id, id=message.id, seen_status_id=message.seen_status_id,
        seen_robot_time_s=_float(message, "seen_robot_time_s", math.nan), stop=message.stop,
        waypoint=_waypoint(message), max_speed_mps=_choice(message, "max_speed_mps"),
        key_height_m=_choice(message, "device_height_m"), press=_press(message), map_car_id=message.map_car_id,
        end_session=message.end_session, check_car_id=message.check_car_id,
        resume_hold_id=message.resume_hold_id, watches=message.watches,
        area=_area(message), enter_service=message.enter_service, leave_service_id=message.leave_service_id)


def _float(message: Any, name: str, absent: float) -> float:
    return getattr(message, name) if message.HasField(name) else absent


def _choice(message: Any, name: str) -> Optional[float]:
    return getattr(message, name) if message.HasField(name) else None


def _waypoint(message: link.Command) -> Optional[Waypoint]:
    if not message.HasField("waypoint"):
        return None
    sent = message.waypoint
    pose = Pose2(_float(sent, "x", math.nan), _float(sent, "y", math.nan), _float(sent, "heading", math.nan))
    return Waypoint(sent.id, application(message.session_id), names.CAR, pose, sent.direction)


def _press(message: link.Command) -> Optional[Press]:
    if not message.HasField("press"):
        return None
    sent = message.press
    return Press(sent.id, message.session_id, tuple(sent.buttons), _float(sent, "strength", 1.0), sent.duration_s)


def _area(message: link.Command) -> Optional[AreaOrder]:
    if not message.HasField("test_area"):
        return None
    sent = message.test_area
    return AreaOrder(sent.id, sent.origin_id, tuple(sent.x), tuple(sent.y))
