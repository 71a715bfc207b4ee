"""Reads recorded bags: decisions, and raw messages."""
# SPDX-License-Identifier: Apache-2.0
import pathlib
from typing import Any, Iterable, Iterator

import rosbag

from mtr_core import names
from mtr_core.bags.diagnosis import unreadable
from mtr_core.se2 import Pose2
from mtr_core.states import CarState

from .decisions import CarSeen, Decisions
from .mcap_file import Recorded
from .profiles import CannotRecord

DECIDED = [names.CAR_ESTIMATE, names.LOCALIZED_POSE]


def decisions_in(bags: Iterable[pathlib.Path]) -> Decisions:
    """Return the decisions in bags in the order of their times; CannotRecord if one cannot be read."""
    found = Decisions()
    for path in bags:
        try:
            with rosbag.Bag(str(path)) as bag:
                for topic, message, _ in bag.read_messages(topics=DECIDED):
                    _take(found, topic, message)
        except Exception as error:
            raise CannotRecord(unreadable(path, error)) from None
    return found


def messages_in(path: pathlib.Path) -> Iterator[Recorded]:
    """Yield all messages of a bag in the order of their times; CannotRecord if it cannot be read."""
    try:
        with rosbag.Bag(str(path)) as bag:
            for topic, raw, time, header in bag.read_messages(raw=True, return_connection_header=True):
                yield Recorded(topic, raw[0], _text(header["message_definition"]), raw[1], time.to_nsec())
    except Exception as error:
        raise CannotRecord(unreadable(path, error)) from None


def _text(value: Any) -> str:
    # Fields of a ROS connection header are bytes or text in Python 3, depending on the version of ROS.
    return value.decode() if isinstance(value, bytes) else str(value)


def _take(found: Decisions, topic: str, message: Any) -> None:
    if topic == names.LOCALIZED_POSE:
        found.add_mode(message.mode, message.valid)
    else:
        found.add_car(CarSeen(CarState(message.state), message.revision,
                              Pose2(message.x, message.y, message.heading), message.length, message.width))
