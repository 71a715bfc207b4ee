"""Command that examines a robot without sending anything to it."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import contextlib
import math

from mtr_operator.domain.errors import ConnectionFailed
from mtr_operator.robot_link.address import RobotAddress
from mtr_operator.station.checks.checklist import hindrances
from mtr_operator.station.checks.finding import State
from mtr_operator.station.connection import SIMULATED, LinkOpener, RobotChoice

from .finding import Finding
from .robot import LISTEN_S, listen, robot_items, robot_sentences

# Wall time limit for opening a connection.
_TIMEOUT_S = 2.0


def look_at(choice: RobotChoice) -> bool:
    """Print a line for each reported part of a robot. Return True if a test could start.

    InvalidParameter for an invalid address.
    """
    link = LinkOpener().robot(choice)
    try:
        with contextlib.closing(link):
            link.connect()
            heard = listen(link, LISTEN_S)
            said = list(robot_sentences(heard, _round_trip_s(choice)))
    except ConnectionFailed as error:
        print(Finding("Link", State.BAD, str(error)).line())
        print("No test could begin: the robot is not connected.")
        return False
    for each in said:
        print(each.line())
    is_hindered = bool(hindrances(robot_items(heard)))
    print("No test could begin before what is bad is mended; nothing was sent to the robot." if is_hindered else
          "A test could begin, as far as the robot is concerned; nothing was sent to it.")
    return not is_hindered


def _round_trip_s(choice: RobotChoice) -> float:
    """Return the round trip time; NaN for a robot within the application."""
    if choice.host == SIMULATED:
        return math.nan
    from mtr_operator.robot_link.probe import round_trip_s
    return round_trip_s(RobotAddress(choice.host, choice.subscriber_port, choice.publisher_port), _TIMEOUT_S)
