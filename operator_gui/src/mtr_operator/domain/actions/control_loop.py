"""The loop between the links and a scenario: one Status, one decision, one answer.

step() answers the Status taken before with the desired state as it is now, and takes the next one. So whatever a
scenario decides after a step is the answer to that very Status, and each Status gets exactly one. Only while something
that was found is not on disk yet, as on a slow one, the answer is the one of before, unless it is a stop.
"""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import contextlib
from dataclasses import replace
from typing import Any, Callable, Iterator

from ..battery.watch import BatteryWatch
from ..clocks.clock_offset import ClockOffset
from ..clocks.clock_step import counts_clock_step
from ..clocks.waiting_time import WaitingTime
from ..distance_feed import Reported
from ..errors import CarActive, LinkLost, RobotFailed, StoodStill
from ..exchange.exchange import SILENCE_LIMIT_S, STOP_LIMIT_S, Exchange
from ..exchange.run_context import Assistance, RunContext
from ..interfaces.car_bus import BusMonitor, BusRecorder, CarEquipment
from ..interfaces.part import part
from ..kept_orders import KeptOrders, is_kept
from ..ports import CarEvent, CarLink, RobotLink
from ..requests import DesiredState
from ..results.frame_history import FrameHistory
from ..results.journal import EVENT, plain_fields
from ..results.refusals import NOTHING
from ..robot_status import CarDimensions, PreflightReport, RobotStatus
from ..supervision.car_guard import CarGuard
from ..supervision.supervision import Supervision
from .kept_preflight import KeptPreflight
from .observer import RunObserver
from .pose_history import STANDING_MPS, PoseHistory
from .skipping import Skipping
from .trouble import Cancelled, LineInvalid, LineStopped, trouble_between

# Robot time until the robot has taken the stop: a busy laptop reads older Statuses first.
_TAKEN_LIMIT_S = 10.0
_KEPT_EVENTS = 1000
# Of a minute at a hundred a second.
_KEPT_REPORTS = 6000
NO_ASSISTANCE = Assistance()
HELD = "the robot stands until you have it go on"


class ControlLoop:
    """State of one run.

    Attributes:
        desired: what the next answer asks for.
        poses: poses of the last while.
        events: changes of the Car's locks, in order of time.
        car_dimensions: the Car as the robot measured it last, None before.
        frames: the Car coordinate systems that the robot has had in this run.
        exchange: one Status, one answer. context: where the run records what happens.
        assistance: who acts at the Car.
        clock_offset: how far the robot's clock is ahead of the laptop's.
        skipping: the line at hand, which the Operator may skip.
        reported: distances that were told, in their order.
        supervision: who is present, and what was confirmed; looked at on a real robot only.
        car_guard: stops the test on the Car's ignition, gear, speed and doors.
    """

    def __init__(self, robot_link: RobotLink, car_link: CarLink, observer: RunObserver | None = None,
                 is_cancelled: Callable[[], bool] = lambda: False, resumed_hold: Callable[[int], int] = lambda _: 0,
                 *, context: RunContext | None = None, assistance: Assistance = NO_ASSISTANCE):
        """resumed_hold: takes the hold in force, 0 for none; gives the newest one that the Operator has released."""
        self.desired = DesiredState()
        self.poses = PoseHistory()
        self.events: list[CarEvent] = []
        self.car_dimensions: CarDimensions | None = None
        self.frames = FrameHistory()
        self.clock_offset = ClockOffset()
        self._waiting_time = WaitingTime()
        self.skipping = Skipping()
        self.reported: list[Reported] = []
        self.car_guard = CarGuard()
        self.supervision = Supervision()
        self.observer = observer or RunObserver()
        self.exchange = Exchange(robot_link, self._answer, self.observer, is_cancelled)
        self.context = context or RunContext()
        self.assistance = replace(assistance, equipment=part(car_link, CarEquipment))
        self._car_link, self._bus, self._log = car_link, part(car_link, BusMonitor), part(car_link, BusRecorder)
        self._is_cancelled = is_cancelled
        self._resumed_hold = resumed_hold
        self._watched = False
        self._check_line: Callable[[RobotStatus], None] = lambda status: None
        self._preflight = KeptPreflight()
        self._orders = KeptOrders()
        self._battery = BatteryWatch()

    @property
    def preflight(self) -> PreflightReport | None:
        """The robot's newest preflight; None while it has told nothing of it."""
        return self._preflight.report

    @property
    def status(self) -> RobotStatus:
        """The newest Status; the first access waits for it."""
        return self.exchange.status or self.step()

    @property
    def now_s(self) -> float:
        """Robot time."""
        return self.status.stamp_s

    @property
    def waited_s(self) -> float:
        """Robot time for how long is waited: a clock that is set makes no wait shorter or longer."""
        return self._waiting_time.at(self.status.stamp_s)

    @property
    def car_link(self) -> CarLink:
        """Locks of the Car as of the newest Status."""
        return self._car_link

    def change(self, **changes: Any) -> None:
        """Change the desired state; it leaves with the next answer."""
        self.desired = replace(self.desired, **changes)

    def step(self) -> RobotStatus:
        """Answer the newest Status and take the next one; Cancelled when the Operator wants to end, LineSkipped when
        the line at hand is to be left.

        While the robot is held it stands, and so does the test, until the Operator has both go on. BatteryCritical
        once, when the charge does not suffice to measure.
        """
        status = self._step()
        if status.hold_id:
            self.observer.on_action(HELD)
        while status.hold_id:
            status = self._step()
        self._battery.check(status, self.waited_s)
        return status

    def _step(self) -> RobotStatus:
        hold_id = self._resumed_hold(self.exchange.status.hold_id if self.exchange.status else 0)
        if hold_id != self.desired.resume_hold_id:
            self.change(resume_hold_id=hold_id)
        status = self._exchange()
        if status.service is not None and status.is_in_service:
            raise RobotFailed(status.service.text)
        self.check_car_guard()
        self.supervision.look(status)
        self.context.journal.check()
        if self._is_cancelled():
            raise Cancelled("The test was interrupted.")
        self.skipping.look()
        return status

    def check_car_guard(self) -> None:
        """Raise CarActive when a signal of the Car has ended the test."""
        if self.car_guard.reason:
            raise CarActive(f"The robot was stopped. {self.car_guard.reason} Secure the Car, then continue the test.")

    def settle(self) -> None:
        """Answer the robot, but order nothing new, until all that was found is on disk; OutputError when it cannot."""
        while not is_kept(self.context.journal, self.exchange.status):
            self._step()
        self.context.journal.check()

    @contextlib.contextmanager
    def watched(self, check: Callable[[RobotStatus], None] = lambda status: None) -> Iterator[None]:
        """Within the context anything that makes a measurement doubtful raises LineInvalid, as check does."""
        self._watched, self._check_line = True, check
        try:
            yield
        finally:
            self._watched = False

    def trouble(self) -> str:
        """Why nothing can be measured now; empty when it can."""
        return trouble_between(None, self.status, self._car_link)

    def halt(self) -> bool | None:
        """Stop the robot and wait a while; True when it says that it stands, None when it is not ours to stop.

        A run that ends by itself withdraws its orders. One that the Operator has ended does not: the robot is then on
        hold until the Operator resumes. Never raises for want of an answer.
        """
        self.change(stop=True, press=None)
        if not self._is_cancelled():
            self.change(waypoint=None, map_car_id=0, check_car_id=0)
        if self.exchange.status is None or self.exchange.status.controlled_by_other:
            return None
        until_s = self.waited_s + _TAKEN_LIMIT_S
        is_taken = stands = False
        with contextlib.suppress(LinkLost, RobotFailed, StoodStill, Cancelled):
            while not stands and self.waited_s < until_s:
                self._exchange(patience_s=STOP_LIMIT_S)
                if not is_taken and self.exchange.is_answered:
                    is_taken, until_s = True, self.waited_s + STOP_LIMIT_S
                stands = is_taken and abs(self.status.speed_mps) < STANDING_MPS
            self.exchange.answer()
        return stands

    def _exchange(self, patience_s: float = SILENCE_LIMIT_S) -> RobotStatus:
        before = self.exchange.status
        status = self.exchange.take(patience_s)
        restarted = before is not None and status.robot_session_id != before.robot_session_id
        if self.frames.add(status) or restarted or counts_clock_step(before, status):
            self.poses.clear()
            self.reported = []
        self.poses.add(status)
        self._preflight.learn(status)
        self.clock_offset.learn(status)
        self._waiting_time.learn(status)
        self.car_dimensions = status.car or self.car_dimensions
        events = self._car_link.observe(status)
        self.observer.on_car(status, events, self._car_link.lock_state)
        feed = self.assistance.distance_feed
        if feed is not None:
            self.reported = (self.reported + feed.observe(status))[-_KEPT_REPORTS:]
        self._look_at_signals(status)
        self.context.course.status(status, self._log.mark)
        self.context.event_log.learn(status, events, self._car_link.problem)
        self._learn_events(events)
        self.context.refusals.look(status, self.exchange.statistics, self._bus.refused,
                                   NOTHING if feed is None else feed.refused)
        self.observer.on_status(status)
        if restarted:
            raise RobotFailed("The robot started anew during the test; the measured lines are kept, go on with a "
                              "continued test.")
        self.exchange.check_control(status)
        self._check(before, status)
        return status

    def _look_at_signals(self, status: RobotStatus) -> None:
        """A stop by a signal of the Car leaves at once, before anything is written."""
        if self.car_guard.learn(self._bus.signals, status.stamp_s):
            self.exchange.answer()

    def _answer(self) -> DesiredState:
        desired = replace(self.desired, stop=True, press=None) if self.car_guard.reason else self.desired
        return self._orders.newest(desired, self.context.journal, self.exchange.status)

    def _learn_events(self, events: list[CarEvent]) -> None:
        for event in events:
            self.context.journal.add(EVENT, plain_fields(event))
        self.events = (self.events + events)[-_KEPT_EVENTS:]

    def _check(self, before: RobotStatus | None, status: RobotStatus) -> None:
        if self.car_guard.reason and self.skipping.is_measuring:
            raise LineStopped(f"The robot was stopped. {self.car_guard.reason}")
        if self._watched:
            # First: it knows more of an unknown lock state than that it is unknown.
            self._check_line(status)
            trouble = trouble_between(before, status, self._car_link)
            if trouble:
                raise LineInvalid(trouble)
