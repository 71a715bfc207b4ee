"""A Car link whose locks are kept in a time line as they are observed."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import pathlib
from typing import Mapping, Sequence

from mtr_operator.domain.assistance import ExtenderPort, HandlePort
from mtr_operator.domain.distance_feed import DistanceFeed
from mtr_operator.domain.ports import BusMark, BusMessages, BusTraffic, CarEvent, CarLink, LockFacts, LockState
from mtr_operator.domain.results.refused import Refused
from mtr_operator.domain.robot_status import RobotStatus
from mtr_operator.domain.supervision.car_signals import CarSignals

from .time_line import TimeLine


class WatchedCarLink(CarLink):
    """Hands everything on."""

    def __init__(self, link: CarLink, time_line: TimeLine):
        self._link = link
        self._time_line = time_line

    def connect(self) -> None:
        """See CarLink."""
        self._link.connect()

    def observe(self, status: RobotStatus) -> list[CarEvent]:
        """See CarLink."""
        events = self._link.observe(status)
        self._time_line.learn(status, events, self._link.lock_state)
        return events

    @property
    def lock_state(self) -> LockState:
        """See CarLink."""
        return self._link.lock_state

    @property
    def facts(self) -> LockFacts:
        """See CarLink."""
        return self._link.facts

    @property
    def signals(self) -> CarSignals:
        """See CarLink."""
        return self._link.signals

    @property
    def handle(self) -> HandlePort | None:
        """See CarLink."""
        return self._link.handle

    @property
    def extender(self) -> ExtenderPort | None:
        """See CarLink."""
        return self._link.extender

    @property
    def distance_feed(self) -> DistanceFeed | None:
        """See CarLink."""
        return self._link.distance_feed

    @property
    def traffic(self) -> BusTraffic | None:
        """See CarLink."""
        return self._link.traffic

    @property
    def record(self) -> Mapping[str, str]:
        """See CarLink."""
        return self._link.record

    @property
    def notices(self) -> Sequence[str]:
        """See CarLink."""
        return self._link.notices

    def log_to(self, path: pathlib.Path | None) -> None:
        """See CarLink."""
        self._link.log_to(path)

    @property
    def log_problem(self) -> str:
        """See CarLink."""
        return self._link.log_problem

    @property
    def mark(self) -> BusMark | None:
        """See CarLink."""
        return self._link.mark

    @property
    def messages(self) -> BusMessages | None:
        """See CarLink."""
        return self._link.messages

    @property
    def refused(self) -> Refused:
        """See CarLink."""
        return self._link.refused

    @property
    def problem(self) -> str:
        """See CarLink."""
        return self._link.problem

    def close(self) -> None:
        """See CarLink."""
        self._link.close()
