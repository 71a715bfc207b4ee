"""Mailbox from the thread of the links to the view: all events in order, and the relevant part of the Statuses.

The view gets one batch per request, at any rate of Statuses: it is neither flooded nor late.
"""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import threading
import time
from dataclasses import dataclass, replace
from typing import Callable

from mtr_operator.domain.actions.kept_preflight import KeptPreflight
from mtr_operator.domain.clocks.clock_offset import ClockOffset
from mtr_operator.domain.geometry.pose import Point
from mtr_operator.domain.robot_status import Problem, RobotStatus

from .events import RobotSnapshot, StationEvent
from .trail import Passing, Places, thinned

# Maximum points of the trail between two batches; more are thinned out.
MAX_TRAIL = 512


@dataclass(frozen=True)
class Batch:
    """Events since the previous batch.

    robot: newest, None without a Status. sight: the newest with the robot's view, None without one.
    trail: positions passed. said: sentences of the robot, each with its causes.
    trail_begins: earlier positions are in another frame of the Car.
    """

    events: tuple[StationEvent, ...]
    robot: RobotSnapshot | None
    trail: tuple[Point | None, ...]
    said: tuple[tuple[Problem, ...], ...] = ()
    trail_begins: bool = False
    sight: RobotStatus | None = None


class Mailbox:
    """Mailbox, thread-safe. wake is called, in the putting thread, when an item is put into an empty mailbox.
    wall_clock: the laptop's time of day, s since 1970.

    Attributes: taken: number of times it was emptied.
    """

    def __init__(self, wake: Callable[[], None] = lambda: None, wall_clock: Callable[[], float] = time.time):
        self._wake = wake
        self._lock = threading.Lock()
        self._events: list[StationEvent] = []
        self._robot: RobotSnapshot | None = None
        self._sight: RobotStatus | None = None
        self._trail: Places = []
        self._passing = Passing()
        self._trail_begins = False
        self._preflight = KeptPreflight()
        self._clock_offset = ClockOffset(wall_clock)
        self._said: dict[str, tuple[Problem, ...]] = {}
        self.taken = 0

    def put(self, event: StationEvent) -> None:
        """Add an event; none is lost."""
        with self._lock:
            first = self._is_empty()
            self._events.append(event)
        if first:
            self._wake()

    def put_robot(self, snapshot: RobotSnapshot) -> None:
        """Add a Status; it replaces the previous one."""
        status = snapshot.status
        with self._lock:
            first = self._is_empty()
            self._preflight.learn(status)
            self._clock_offset.learn(status)
            self._robot = replace(snapshot, preflight=self._preflight.report,
                                  clock_ahead_s=self._clock_offset.ahead_s)
            self._sight = self._sight if status.surroundings is None else status
            self._said.update((problems[0].text, problems) for problems in status.problems() if problems)
            if self._passing.begins_anew(status):
                self._trail, self._trail_begins = [], True
            self._trail += self._passing.places(status)
            if len(self._trail) > MAX_TRAIL:
                self._trail = thinned(self._trail)
        if first:
            self._wake()

    def take(self) -> Batch:
        """Empty the mailbox."""
        with self._lock:
            batch = Batch(tuple(self._events), self._robot, tuple(self._trail), tuple(self._said.values()),
                          self._trail_begins, self._sight)
            self._events, self._robot, self._trail, self._said = [], None, [], {}
            self._sight = None
            self._trail_begins = False
            self.taken += 1
        return batch

    def _is_empty(self) -> bool:
        return not self._events and self._robot is None
