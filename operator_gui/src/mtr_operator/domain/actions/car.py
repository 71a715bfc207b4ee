"""The Car as a scenario sees it."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import contextlib
from dataclasses import dataclass
from typing import Iterator, Mapping, Sequence

from ..distance_feed import Reported
from ..errors import ConnectionFailed, LinkLost, RobotFailed
from ..interfaces.car_bus import BusMonitor
from ..interfaces.part import part
from ..ports import CarEvent, LockFacts, LockState
from ..results.session_record import PHONE_FEED
from ..robot_status import CarDimensions
from .control_loop import ControlLoop

# Robot time that the bus may take to be understood before the robot moves, and to recover during a test.
_START_LIMIT_S = 10.0
_RECOVERY_LIMIT_S = 30.0


_NOBODY = ("Nobody takes the Car's handle: its profile declares no handle_request, and there is no Operator to ask; "
           "add one to the profile, or start the test where a person can answer.")
_NO_SWITCH = ("Nobody switches the extender: the Car's profile declares no extender_switch, and there is no Operator "
              "to ask; add one to the profile, or start the test where a person can answer.")
_NO_PHONE = ("Nothing tells the phone's distance: the Car's profile declares no phone_distance; add one to the "
             "profile, or name a feed (--phone-feed).")


@dataclass(frozen=True)
class HandleTaken:
    """Robot times between which the handle was taken. by: see HandlePort."""

    asked_s: float
    taken_s: float
    by: str


class Car:
    """Locks and dimensions of the Car."""

    def __init__(self, loop: ControlLoop):
        self._loop = loop

    @property
    def lock_state(self) -> LockState:
        """State of the locks now."""
        return self._loop.car_link.lock_state

    def is_locked(self) -> bool:
        """True when the Car is locked now."""
        return self.lock_state is LockState.LOCKED

    def change_to(self, state: LockState, since_s: float) -> CarEvent | None:
        """First change of the locks to this state after an instant of robot time, None when there was none."""
        for event in self._loop.events:
            if event.lock_state is state and event.time_s > since_s:
                return event
        return None

    @contextlib.contextmanager
    def handle_taken(self, distance_m: float, patience_s: float) -> Iterator[HandleTaken]:
        """Context in which the handle is taken; RobotFailed when nobody takes it within patience_s of robot time.

        A Car that unlocks while a person is asked has been asked by the handle: nobody has to say so.
        """
        handle, asked_s, until_s = self._loop.assistance.handle, self._loop.now_s, self._loop.waited_s + patience_s
        if handle is None:
            raise RobotFailed(_NOBODY)
        handle.request(distance_m)
        try:
            with self._loop.car_guard.handle_pulled():
                while not handle.is_taken() and self.change_to(LockState.UNLOCKED, asked_s) is None:
                    if self._loop.waited_s >= until_s:
                        raise RobotFailed(f"Nobody has taken the Car's handle within {patience_s:g} s; continue the "
                                          "test when somebody is there to do it, or increase handle_timeout_s.")
                    self._loop.step()
                yield HandleTaken(asked_s, self._loop.now_s, handle.by)
        finally:
            handle.release()

    def require_extender(self) -> None:
        """ConnectionFailed when nothing and nobody switches an extender."""
        if self._loop.assistance.extender is None:
            raise ConnectionFailed(_NO_SWITCH)

    def switch_extender(self, is_on: bool, patience_s: float) -> str:
        """Have the extender switched; returns by whom when it is done, see ExtenderPort.

        RobotFailed when nobody does it within patience_s of robot time.
        """
        extender, until_s = self._loop.assistance.extender, self._loop.waited_s + patience_s
        if extender is None:
            raise RobotFailed(_NO_SWITCH)
        extender.switch(is_on)
        try:
            while not extender.is_switched():
                if self._loop.waited_s >= until_s:
                    raise RobotFailed(f"Nobody has switched the extender within {patience_s:g} s; continue the test "
                                      "when somebody is there to do it, or increase switch_timeout_s.")
                self._loop.step()
        finally:
            extender.release()
        return extender.by

    def require_phone(self) -> None:
        """ConnectionFailed when nothing tells the distance of a phone."""
        if self._loop.assistance.distance_feed is None:
            raise ConnectionFailed(_NO_PHONE)

    @property
    def reported(self) -> Sequence[Reported]:
        """Distances of the phone that were told of late, in their order."""
        return self._loop.reported

    @property
    def phone_problem(self) -> str:
        """Why the phone's distance cannot be told now; empty when it can."""
        feed = self._loop.assistance.distance_feed
        return _NO_PHONE if feed is None else feed.problem

    def wait_for_phone(self) -> None:
        """Wait until a trouble of what tells the phone's distance is over; LinkLost when it lasts."""
        until_s = self._loop.waited_s + _RECOVERY_LIMIT_S
        while self.phone_problem:
            if self._loop.waited_s >= until_s:
                raise LinkLost(f"Nothing tells the phone's distance any more: {self.phone_problem}")
            self._loop.step()

    @property
    def relocks(self) -> bool:
        """True when the Car locks by itself some time after it was unlocked."""
        return self.facts.relock_after_s is not None

    @property
    def facts(self) -> LockFacts:
        """What is known of it beforehand."""
        return self._loop.car_link.facts

    @property
    def notices(self) -> Sequence[str]:
        """What the Operator has to know of its bus before a test."""
        return part(self._loop.car_link, BusMonitor).notices

    @property
    def record(self) -> Mapping[str, str]:
        """How it is watched, for the record of the test."""
        feed = self._loop.assistance.distance_feed
        return {**part(self._loop.car_link, BusMonitor).record, **({} if feed is None else {PHONE_FEED: feed.name})}

    def dimensions(self) -> CarDimensions:
        """Length and width as the robot measured them; Robot.prepare has waited for them."""
        dimensions = self._loop.car_dimensions
        if dimensions is None:
            raise ValueError("Robot.prepare was not awaited")
        return dimensions

    def prepare(self) -> None:
        """Wait until the bus says whether the Car is locked; ConnectionFailed when it does not."""
        if not self._receives_locks(_START_LIMIT_S):
            raise ConnectionFailed(f"The Car's lock state is unknown: {self._reason()}")

    def wait_for_bus(self) -> None:
        """Wait until a trouble on the bus is over; LinkLost when it lasts."""
        if not self._receives_locks(_RECOVERY_LIMIT_S):
            raise LinkLost(f"The Car fell silent: {self._reason()}")

    def _receives_locks(self, limit_s: float) -> bool:
        until_s = self._loop.waited_s + limit_s
        while self._reason():
            if self._loop.waited_s >= until_s:
                return False
            self._loop.step()
        return True

    def _reason(self) -> str:
        if self._loop.car_link.problem:
            return self._loop.car_link.problem
        return "The bus does not carry it." if self.lock_state is LockState.UNKNOWN else ""
