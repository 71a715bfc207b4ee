"""Both links of a connection: opened, changed and closed by the thread that owns them."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import logging
from typing import Callable

from mtr_operator.domain.absent_car import AbsentCarLink
from mtr_operator.domain.errors import BusRefused, InvalidParameter, OperatorError
from mtr_operator.domain.eventlog.event_log import EventLog
from mtr_operator.domain.ports import CarLink

from ..bus.time_line import TimeLine
from ..connection import CanChoice, Connection, LinkOpener
from ..events import LinkRefused
from .idle_loop import IdleLoop
from .stop_order import StopOrder
from .watched_link import WatchedRobotLink


class Links:
    """Links. Attributes: car: the Car's link, or the link of an absent Car. idle: answers the robot while no test runs,
    None without a session. time_line: history of the Car's locks. has_paused: an interrupted test claims the robot."""

    def __init__(self, connection: Connection, opener: LinkOpener, stop: StopOrder, event_log: EventLog,
                 released: Callable[[int], int]):
        """stop: is sent on the robot's link. released: newest hold that the Operator has ended."""
        self._connection, self._opener = connection, opener
        self._stop, self._event_log, self._released = stop, event_log, released
        self._robot: WatchedRobotLink | None = None
        self.time_line = TimeLine()
        self.car: CarLink = AbsentCarLink()
        self.idle: IdleLoop | None = None
        self.has_paused = False

    def open(self) -> LinkRefused | None:
        """Open both; return a refusal."""
        part = "car"
        try:
            self.car = self._opener.car(self._connection.can)
            part = "robot"
            self._robot = self.new_robot()
            self._robot.connect()
            part = "car"
            self.car.connect()
        except InvalidParameter as error:
            return LinkRefused("address" if part == "robot" else part, str(error))
        except OperatorError as error:
            return LinkRefused(part, str(error), _bus_of(error))
        # An adapter's driver may raise any exception, and the view waits for an answer.
        except Exception as error:
            logging.exception("The links were not opened because of a defect.")
            return LinkRefused(part, f"The application has a defect: {type(error).__name__}: {error}")
        self.idle = IdleLoop(self._robot, self.car, self._released, self._event_log, self.time_line)
        return None

    def new_robot(self) -> WatchedRobotLink:
        """Return a link to the robot that is not open yet."""
        return WatchedRobotLink(self._opener.robot(self._connection.robot), self._stop)

    def open_robot(self) -> None:
        """Open a separate session for each purpose, because ids of requests restart; OperatorError."""
        robot = self.new_robot()
        robot.connect()
        self._robot = robot
        self.idle = IdleLoop(robot, self.car, self._released, self._event_log, self.time_line, claims=self.has_paused)

    def change_car(self, choice: CanChoice | None) -> LinkRefused | None:
        """Use another adapter for the Car; return a refusal, after which the Car is absent."""
        # The new one may be the same adapter.
        self.car.close()
        self.car = self._opener.car(None)
        refused = None
        try:
            car = self._opener.car(choice)
            car.connect()
            self.car = car
        except OperatorError as error:
            refused = LinkRefused("car", str(error), _bus_of(error))
        if self.idle is not None:
            self.idle.use_car(self.car)
        return refused

    def close_robot(self) -> None:
        """End the session."""
        robot, self._robot, self.idle = self._robot, None, None
        if robot is not None:
            robot.close()

    def close(self) -> None:
        """Close both."""
        self.close_robot()
        self.car.close()


def _bus_of(error: OperatorError) -> str:
    return error.bus if isinstance(error, BusRefused) else ""
