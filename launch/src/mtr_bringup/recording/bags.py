"""Decisions in recorded bags."""
# SPDX-License-Identifier: Apache-2.0
import pathlib
from typing import Any, Iterable

import rosbag

from mtr_core import names
from mtr_core.se2 import Pose2
from mtr_core.states import CarState

from .decisions import CarSeen, Decisions
from .profiles import CannotRecord

DECIDED = [names.CAR_ESTIMATE, names.LOCALIZED_POSE]


def decisions_in(bags: Iterable[pathlib.Path]) -> Decisions:
    """Of bags in the order of their times; CannotRecord when one cannot be read."""
    found = Decisions()
    for path in bags:
        try:
            with rosbag.Bag(str(path)) as bag:
                for topic, message, _ in bag.read_messages(topics=DECIDED):
                    _take(found, topic, message)
        except (rosbag.ROSBagException, OSError) as error:
            raise CannotRecord(f"{path} cannot be read: {error}.") from None
    return found


def _take(found: Decisions, topic: str, message: Any) -> None:
    if topic == names.LOCALIZED_POSE:
        found.add_mode(message.mode, message.valid)
    else:
        found.add_car(CarSeen(CarState(message.state), message.revision,
                              Pose2(message.x, message.y, message.heading), message.length, message.width))
