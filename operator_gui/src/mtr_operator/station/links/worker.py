"""Thread that owns both links: it answers the robot, runs tests and calibration, and fills the mailbox."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import contextlib
import logging
import queue
import threading
from dataclasses import replace
from typing import Callable, Sequence

from mtr_operator.domain.actions.skipping import Skipping
from mtr_operator.domain.actions.standstill import Standstill
from mtr_operator.domain.errors import OperatorError
from mtr_operator.domain.eventlog.entry import ERROR, INFO, WARNING, EventKind
from mtr_operator.domain.eventlog.event_log import EventLog
from mtr_operator.domain.exchange.exchange import SILENCE_LIMIT_S
from mtr_operator.domain.geometry.pose import Point
from mtr_operator.domain.interfaces.car_bus import BusMonitor
from mtr_operator.domain.interfaces.part import part
from mtr_operator.domain.results.session_record import now
from mtr_operator.domain.supervision.presence import Presence, PresenceParameters
from mtr_operator.domain.supervision.supervision import Supervision

from ..bus.bus_view import BusView
from ..connection import CanChoice, Connection, LinkOpener
from ..events import (
    CarLinkOpened,
    EventLogged,
    LinksOpened,
    Outcome,
    PersonWanted,
    PresenceWanted,
    ProgressSaved,
    RobotSilent,
    StandstillSeen,
)
from ..handle_prompt import AskedPerson, Prompt
from ..mailbox import Mailbox
from ..test import Test
from .attention import Attention
from .idle_loop import CalibrationRequest, CarRequest, IdleLoop
from .links import Links
from .measurement_run import Answers, MeasurementRun
from .stop_order import StopOrder

# Wall time between two attempts to reopen the robot's link.
RETRY_S = 1.0
# Silence of the robot after which the view shows it.
SILENCE_SHOWN_S = 1.0


class Worker:
    """Worker whose thread contains all waiting for robot and Car; it takes requests between two Statuses."""

    def __init__(self, connection: Connection, opener: LinkOpener, mailbox: Mailbox,
                 new_standstill: Callable[[], Standstill] = lambda: Standstill(SILENCE_LIMIT_S),
                 attention: Attention | None = None, *, presence: PresenceParameters | None = None):
        """new_standstill: creates the detector of a sleeping laptop, for each run and for the time between them.
        attention: detects that the view hangs; None for the mailbox's own. presence: conditions of prompts to a
        person."""
        self._new_standstill = new_standstill
        self._standstill = new_standstill()
        self._attention = attention or Attention(lambda: mailbox.taken)
        self._mailbox = mailbox
        self._event_log = EventLog()
        self._event_log.listen(lambda entry: mailbox.put(EventLogged(entry)))
        self._requests: queue.Queue[Callable[[], None]] = queue.Queue()
        # Short requests, which a running test does not delay.
        self._short_requests: queue.Queue[Callable[[], None]] = queue.Queue()
        self._closing = threading.Event()
        self._stop = StopOrder()
        self._released_hold = 0
        self._skipping = Skipping()
        self._presence = Presence(lambda is_wanted: mailbox.put(PresenceWanted(is_wanted)), presence)
        self._person = AskedPerson(lambda prompt: self._mailbox.put(PersonWanted(prompt)))
        self._thread = threading.Thread(target=self._run, name="links", daemon=True)
        self._links = Links(connection, opener, self._stop, self._event_log, self._released)

    def start(self) -> None:
        """Open the links and run until close(); Connected or Refused is put into the mailbox."""
        self._thread.start()

    def close(self, timeout_s: float | None = None) -> bool:
        """Stop the robot, end a running test, disconnect; return True when that is done."""
        self._closing.set()
        self._stop.give()
        if self._thread.is_alive():
            self._thread.join(timeout_s)
        return not self._thread.is_alive()

    def run_test(self, test: Test, confirmed: Sequence[str] = ()) -> None:
        """Measure the rest of a test; Ended is put into the mailbox. The person who orders it is present. confirmed:
        operating conditions."""
        ticket = self._stop.ticket
        self._requests.put(lambda: self._measure(test, ticket, tuple(confirmed)))

    def lay_aside(self) -> None:
        """Release the robot to other applications unless another order is active, because the current test was
        closed."""
        self._requests.put(self._free_robot)

    def stop(self) -> None:
        """Stop the robot in any state: the stop has been sent when this returns. A running test ends, and its results
        are kept; earlier orders that have not started are discarded."""
        self._give_stop()
        self.note("Stop.")

    def enter_service(self) -> None:
        """Stop the robot as stop() does, and disable its wheels, lift and servos until both sides release them."""
        self._give_stop(enters_service=True)
        self.note("Enter service mode.")

    def leave_service(self, agreement_id: int) -> None:
        """Release service mode for the Operator; the robot must also be released on its own side. A stop stays in
        force."""
        self._requests.put(lambda: self._links.idle.leave_service(agreement_id) if self._links.idle else None)
        self.note("Release service mode.")

    def _give_stop(self, *, enters_service: bool = False) -> None:
        self._stop.give(enters_service=enters_service)
        self._requests.put(lambda: self._links.idle.request_car(CarRequest.STOP) if self._links.idle else None)

    def release_hold(self, hold_id: int) -> None:
        """Resume the robot from the hold with this id."""
        self._released_hold = hold_id
        self._presence.confirm()
        self.note("Go on.")

    def skip_line(self, number: int) -> None:
        """Let a running test skip this line, if it is the current one, and continue with the next one."""
        self._skipping.skip(number)
        self._presence.confirm()
        self.note(f"Skip line {number}.")

    def answer(self, prompt: Prompt) -> None:
        """Confirm that a person has done what this prompt requests."""
        self._person.answer(prompt.number)
        self._presence.confirm()
        self.note(prompt.done)

    def confirm_presence(self) -> None:
        """Confirm that the Operator is present."""
        self._presence.confirm()
        self.note("Presence confirmed.")

    def save(self, test: Test) -> None:
        """Write a test's progress; Saved is put into the mailbox."""
        self._short_requests.put(lambda: self._save(test))

    def calibrate(self, request: CalibrationRequest) -> None:
        """Request a calibration action."""
        self._order(lambda idle: idle.calibrate(request))

    def request_car(self, request: CarRequest) -> None:
        """Request a check or mapping of the Car, or its end."""
        if request is CarRequest.STOP:
            self.stop()
        else:
            self._order(lambda idle: idle.request_car(request))
            self.note("Map the Car." if request is CarRequest.MAP else "Check where the Car stands.")

    def set_area(self, corners: tuple[Point, ...], origin_id: int) -> None:
        """Request that the robot stays in this test area, without corners in none. A stop stays in force."""
        self._requests.put(lambda: self._links.idle.set_area(corners, origin_id) if self._links.idle else None)
        self.note("Set the test area." if corners else "Remove the test area.")

    def note(self, text: str, kind: EventKind = EventKind.OPERATOR) -> None:
        """Add an action of the Operator, or a fault of the application, to the event list."""
        time, severity = now(), INFO if kind is EventKind.OPERATOR else ERROR
        self._short_requests.put(lambda: self._event_log.add(kind, text, severity, time))

    def bus_view(self) -> BusView:
        """Return the current traffic of the Car's bus, and the history of its locks."""
        car = self._links.car
        bus = part(car, BusMonitor)
        return BusView(bus.messages, bus.traffic, car.problem, *self._links.time_line.recent())

    def use_can(self, choice: CanChoice | None) -> None:
        """Change the CAN adapter; CarLinkOpened or Refused is put into the mailbox."""
        self._requests.put(lambda: self._change_car(choice))

    def _order(self, carry_out: Callable[[IdleLoop], None]) -> None:
        ticket = self._stop.ticket
        self._requests.put(lambda: self._carry_out(carry_out, ticket))

    def _carry_out(self, order: Callable[[IdleLoop], None], ticket: int) -> None:
        if self._links.idle is not None and self._stop.lift(ticket):
            order(self._links.idle)

    def _run(self) -> None:
        refused = self._links.open()
        self._mailbox.put(refused or LinksOpened())
        while refused is None and not self._closing.is_set():
            self._try_turn()
        self._links.close()

    def _try_turn(self) -> None:
        try:
            self._turn()
        # After any defect a new session may restore the links; without this thread nothing would work.
        except Exception:
            logging.exception("The link to the robot is opened anew after a defect.")
            self._links.close_robot()
            self._closing.wait(RETRY_S)

    def _run_short_requests(self) -> None:
        with contextlib.suppress(queue.Empty):
            while True:
                self._short_requests.get_nowait()()

    def _turn(self) -> None:
        self._look_for_standstill()
        self._look_for_attention()
        self._run_short_requests()
        with contextlib.suppress(queue.Empty):
            self._requests.get_nowait()()
            return
        idle = self._links.idle or self._open_robot()
        if idle is None:
            self._closing.wait(RETRY_S)
            return
        snapshot = idle.step()
        # Final: a test that was paused before another one took the robot does not claim it again.
        self._links.has_paused = self._links.has_paused and idle.claims
        self._look_for_standstill()
        if snapshot is not None:
            self._mailbox.put_robot(snapshot)
        elif idle.silent_s >= SILENCE_SHOWN_S:
            self._mailbox.put(RobotSilent(idle.silent_s))
            self._event_log.silent()

    def _free_robot(self) -> None:
        had_paused, self._links.has_paused = self._links.has_paused, False
        if had_paused and self._links.idle is not None and not self._links.idle.has_order:
            self._links.close_robot()
            self._stop.withdraw()

    def _open_robot(self) -> IdleLoop | None:
        try:
            self._links.open_robot()
        except OperatorError:
            self._mailbox.put(RobotSilent(SILENCE_SHOWN_S))
        return self._links.idle

    def _change_car(self, choice: CanChoice | None) -> None:
        refused = self._links.change_car(choice)
        if refused is not None:
            self._event_log.add(EventKind.FAULT, refused.text, ERROR)
        self._mailbox.put(refused or CarLinkOpened())

    def _look_for_standstill(self) -> None:
        """Prevent that the robot resumes orders from before the laptop slept."""
        said = self._standstill.look()
        if said:
            self._stop_unattended(said)

    def _look_for_attention(self) -> None:
        """Prevent that the robot continues orders of a window that hangs."""
        said = self._attention.look()
        if said and self._links.idle is not None and self._links.idle.has_order:
            self._stop_unattended(said)

    def _stop_unattended(self, said: str) -> None:
        if self._links.idle is not None and self._links.idle.claims:
            self._links.idle.request_car(CarRequest.STOP)
        self._event_log.add(EventKind.FAULT, said, WARNING)
        self._mailbox.put(StandstillSeen(said))

    def _save(self, test: Test) -> None:
        try:
            test.save()
        except OperatorError as error:
            self._mailbox.put(ProgressSaved(test, str(error)))
        else:
            self._mailbox.put(ProgressSaved(test, ""))

    def _measure(self, test: Test, ticket: int, confirmed: tuple[str, ...]) -> None:
        self._links.close_robot()
        # A stop that came meanwhile stays in force, and ends the run at its first Status.
        self._stop.lift(ticket)
        unattended: list[str] = []
        self._presence.confirm()
        answers = Answers(self._released, self._person, self._person, self._skipping,
                          Supervision(self._presence, confirmed=confirmed))
        run = MeasurementRun(test, self._links.new_robot, self._links.car, self._mailbox, answers,
                             event_log=self._event_log, standstill=self._new_standstill(),
                             time_line=self._links.time_line)
        ended = run.run(lambda: self._is_stopped(unattended), self._run_short_requests)
        self._presence.end()
        self._links.has_paused = ended.outcome is not Outcome.COMPLETE
        self._mailbox.put(replace(ended, text=ended.text or "".join(unattended)))
        # The run itself reported events during it.
        self._standstill = self._new_standstill()

    def _is_stopped(self, unattended: list[str]) -> bool:
        """Return True if the Operator has stopped the robot, or is unable to; the reason is added to the list."""
        said = self._attention.look()
        if said and not self._stop.is_in_force:
            unattended.append(said)
            self._event_log.add(EventKind.FAULT, said, WARNING)
            self._stop.give()
        return self._stop.is_in_force

    def _released(self, _hold_id: int) -> int:
        return self._released_hold
