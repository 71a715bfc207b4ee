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

from ..assistance import ExtenderPort, HandlePort
from ..battery.watch import BatteryWatch
from ..clocks.clock_offset import ClockOffset
from ..clocks.clock_step import counts_clock_step
from ..clocks.waiting_time import WaitingTime
from ..distance_feed import DistanceFeed, Reported
from ..errors import CarActive, LinkLost, RobotFailed, StoodStill
from ..eventlog.event_log import EventLog
from ..interfaces.car_bus import BusMonitor, BusRecorder, CarEquipment
from ..interfaces.part import part
from ..kept_orders import KeptOrders, is_kept
from ..ports import CarEvent, CarLink, RobotLink
from ..requests import DesiredState
from ..results.course import Course
from ..results.frame_history import FrameHistory
from ..results.journal import EVENT, Journal, plain_fields
from ..results.refusals import NOTHING, Refusals
from ..robot_status import CarDimensions, PreflightReport, RobotStatus
from ..supervision.car_guard import CarGuard
from ..supervision.supervision import Supervision
from .kept_preflight import KeptPreflight
from .observer import RunObserver
from .pose_history import STANDING_MPS, PoseHistory
from .skipping import Skipping
from .standstill import Standstill
from .trouble import Cancelled, LineInvalid, LineStopped, trouble_between

# Wall time of one look for a Status, after which a stop leaves, and another one as long as no Status comes.
POLL_PERIOD_S = 0.05
# So many looks after which the desired state is sent again when no Status comes.
RESEND_POLLS = 4
# Wall time of silence after which nothing that moves is sent: the robot has stopped by itself, and shall not be moved
# by an order that nobody sees the effect of.
MAX_BLIND_S = 1.0
# Wall time of silence at which a test ends; an interruption of the Wi-Fi is shorter.
SILENCE_LIMIT_S = 30.0
# Wall time within which the first Status has to come.
FIRST_STATUS_LIMIT_S = 10.0
# Silence that is reported to a view.
_SILENCE_SHOWN_S = 1.0
# Robot time that stopping may take, and until the robot has taken the stop: a busy laptop reads older Statuses first.
_STOP_LIMIT_S, _TAKEN_LIMIT_S = 3.0, 10.0
_KEPT_EVENTS = 1000
# Of a minute at a hundred a second.
_KEPT_REPORTS = 6000
HELD = "the robot stands until you have it go on"


class ControlLoop:
    """State of one run.

    Attributes:
        desired: what the next answer asks for.
        poses: poses of the last while.
        events: changes of the Car's locks, in order of time.
        car_dimensions: the Car as the robot measured it last, None before.
        frames: the Car coordinate systems that the robot has had in this run.
        journal: where events, presses and measurements are kept before the robot is ordered on.
        course: where each Status is kept, and what is expected of the Car.
        event_log: learns what happens to robot and Car.
        refusals: what is refused meanwhile.
        person: who takes the Car's handle where no output does; None when nobody is there.
        switcher: who switches the extender where no output does; None when nobody is there.
        standstill: notices that nobody looked after the robot for a while.
        clock_offset: how far the robot's clock is ahead of the laptop's.
        skipping: the line at hand, which the Operator may skip.
        phone: tells the distance of a phone in place of the Car's own feed; None for that one.
        reported: distances that were told, in their order.
        supervision: who is present, and what was confirmed; looked at on a real robot only.
        car_guard: stops the test on the Car's ignition, gear, speed and doors.
    """

    def __init__(self, robot_link: RobotLink, car_link: CarLink, observer: RunObserver | None = None,
                 is_cancelled: Callable[[], bool] = lambda: False, resumed_hold: Callable[[int], int] = lambda _: 0):
        """resumed_hold: takes the hold in force, 0 for none; gives the newest one that the Operator has released."""
        self.desired = DesiredState()
        self.poses = PoseHistory()
        self.events: list[CarEvent] = []
        self.car_dimensions: CarDimensions | None = None
        self.frames = FrameHistory()
        self.journal = Journal()
        self.course = Course()
        self.event_log = EventLog()
        self.refusals = Refusals()
        self.person: HandlePort | None = None
        self.switcher: ExtenderPort | None = None
        self.standstill = Standstill(SILENCE_LIMIT_S)
        self.clock_offset = ClockOffset()
        self._waiting_time = WaitingTime()
        self.skipping = Skipping()
        self.phone: DistanceFeed | None = None
        self.reported: list[Reported] = []
        self.car_guard = CarGuard()
        self.supervision = Supervision()
        self.observer = observer or RunObserver()
        self._robot_link = robot_link
        self._car_link, self._bus, self._equipment = car_link, part(car_link, BusMonitor), part(car_link, CarEquipment)
        self._log = part(car_link, BusRecorder)
        self._is_cancelled = is_cancelled
        self._resumed_hold = resumed_hold
        self._status: RobotStatus | None = None
        self._watched = False
        self._check_line: Callable[[RobotStatus], None] = lambda status: None
        self._was_in_control = False
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
        return self._status or self.step()

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

    @property
    def handle(self) -> HandlePort | None:
        """What takes the Car's handle: an output before a person; None when neither is there."""
        return self._equipment.handle or self.person

    @property
    def extender(self) -> ExtenderPort | None:
        """What switches the extender: an output before a person; None when neither is there."""
        return self._equipment.extender or self.switcher

    @property
    def distance_feed(self) -> DistanceFeed | None:
        """What tells the distance of a phone; None when nothing does."""
        return self.phone or self._equipment.distance_feed

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
        hold_id = self._resumed_hold(self._status.hold_id if self._status else 0)
        if hold_id != self.desired.resume_hold_id:
            self.change(resume_hold_id=hold_id)
        status = self._exchange()
        if status.service is not None and status.is_in_service:
            raise RobotFailed(status.service.text)
        self.check_car_guard()
        self.supervision.look(status)
        self.journal.check()
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
        while not is_kept(self.journal, self._status):
            self._step()
        self.journal.check()

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
        if self._status is None or self._status.controlled_by_other:
            return None
        until_s = self.waited_s + _TAKEN_LIMIT_S
        is_taken = stands = False
        with contextlib.suppress(LinkLost, RobotFailed, StoodStill, Cancelled):
            while not stands and self.waited_s < until_s:
                self._exchange(patience_s=_STOP_LIMIT_S)
                if not is_taken and self._robot_link.is_answered(self.status):
                    is_taken, until_s = True, self.waited_s + _STOP_LIMIT_S
                stands = is_taken and abs(self.status.speed_mps) < STANDING_MPS
            self._robot_link.send(self.desired)
        return stands

    def _exchange(self, patience_s: float = SILENCE_LIMIT_S) -> RobotStatus:
        self._check_standstill()
        before = self._status
        if before is not None:
            self._robot_link.send(self._answer())
        status = self._next_status(FIRST_STATUS_LIMIT_S if before is None else patience_s)
        restarted = before is not None and status.robot_session_id != before.robot_session_id
        if self.frames.add(status) or restarted or counts_clock_step(before, status):
            self.poses.clear()
            self.reported = []
        self.poses.add(status)
        self._preflight.learn(status)
        self.clock_offset.learn(status)
        self._waiting_time.learn(status)
        self._status = status
        self.car_dimensions = status.car or self.car_dimensions
        events = self._car_link.observe(status)
        self.observer.on_car(status, events, self._car_link.lock_state)
        feed = self.distance_feed
        if feed is not None:
            self.reported = (self.reported + feed.observe(status))[-_KEPT_REPORTS:]
        self._look_at_signals(status)
        self.course.status(status, self._log.mark)
        self.event_log.learn(status, events, self._car_link.problem)
        self._learn_events(events)
        self.refusals.look(status, self._robot_link.statistics, self._bus.refused,
                           NOTHING if feed is None else feed.refused)
        self.observer.on_status(status)
        if restarted:
            raise RobotFailed("The robot started anew during the test; the measured lines are kept, go on with a "
                              "continued test.")
        self._check_control(status)
        self._check(before, status)
        return status

    def _look_at_signals(self, status: RobotStatus) -> None:
        """A stop by a signal of the Car leaves at once, before anything is written."""
        if self.car_guard.learn(self._bus.signals, status.stamp_s):
            self._robot_link.send(self._answer())

    def _answer(self) -> DesiredState:
        desired = replace(self.desired, stop=True, press=None) if self.car_guard.reason else self.desired
        return self._orders.newest(desired, self.journal, self._status)

    def _learn_events(self, events: list[CarEvent]) -> None:
        for event in events:
            self.journal.add(EVENT, plain_fields(event))
        self.events = (self.events + events)[-_KEPT_EVENTS:]

    def _next_status(self, patience_s: float) -> RobotStatus:
        silent_s = 0.0
        for poll in range(1, round(patience_s / POLL_PERIOD_S) + 1):
            status = self._robot_link.next_status(POLL_PERIOD_S)
            # Before anything is sent again that moves.
            self._check_standstill()
            if status is not None:
                return status
            silent_s = poll * POLL_PERIOD_S
            cancelled = self._is_cancelled()
            if silent_s >= _SILENCE_SHOWN_S and poll % RESEND_POLLS == 0:
                self.observer.on_link_silent(silent_s)
            if cancelled and silent_s >= _STOP_LIMIT_S:
                raise Cancelled("The test was interrupted.")
            if self._status is not None and (cancelled or poll % RESEND_POLLS == 0):
                self._send_blindly(cancelled or silent_s >= MAX_BLIND_S)
        error = self._robot_link.statistics.last_error
        if self._status is None:
            raise LinkLost(f"The robot's ports are open, but no Status has come for {silent_s:.0f} s; check that both "
                           f"ports are the robot's. {error}".rstrip())
        raise LinkLost(f"The robot has been silent for {silent_s:.0f} s; check the Wi-Fi and that its software runs. "
                       f"{error}".rstrip())

    def _check_standstill(self) -> None:
        said = self.standstill.look()
        if said:
            raise StoodStill(f"{said} The line at hand is measured anew when the test goes on.")

    def _send_blindly(self, stop: bool) -> None:
        """Send the desired state again without knowing what the robot does; a stop waits for no Status."""
        self._robot_link.send(replace(self._answer(), stop=True) if stop else self._answer())

    def _check_control(self, status: RobotStatus) -> None:
        if status.controlled_by_other and self._was_in_control:
            raise RobotFailed("Another application has taken over the control of the robot.")
        self._was_in_control = self._was_in_control or (status.session_id != 0 and not status.controlled_by_other)

    def _check(self, before: RobotStatus | None, status: RobotStatus) -> None:
        if self.car_guard.reason and self.skipping.is_measuring:
            raise LineStopped(f"The robot was stopped. {self.car_guard.reason}")
        if self._watched:
            # First: it knows more of an unknown lock state than that it is unknown.
            self._check_line(status)
            trouble = trouble_between(before, status, self._car_link)
            if trouble:
                raise LineInvalid(trouble)
