"""One run of a test, in its own session on the link, and its end."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import contextlib
import logging
from dataclasses import dataclass, field
from typing import Callable

from mtr_operator.domain.actions.control_loop import ControlLoop
from mtr_operator.domain.actions.event_observer import EventObserver, run_told
from mtr_operator.domain.actions.skipping import Skipping
from mtr_operator.domain.actions.standstill import Standstill
from mtr_operator.domain.actions.trouble import Cancelled
from mtr_operator.domain.assistance import ExtenderPort, HandlePort
from mtr_operator.domain.errors import OperatorError, OutputError
from mtr_operator.domain.eventlog.event_log import EventLog
from mtr_operator.domain.exchange.run_context import Assistance, RunContext
from mtr_operator.domain.ports import CarLink
from mtr_operator.domain.results.session_record import CAR_PROFILE, ROBOT_SOFTWARE
from mtr_operator.domain.runner import Runner
from mtr_operator.domain.supervision.supervision import Supervision
from mtr_operator.storage.journal.beside import JournalBeside
from mtr_operator.storage.recorded.recording import Recording
from mtr_operator.storage.store import Store

from ..bus.time_line import TimeLine
from ..events import Outcome, RunEnded
from ..mailbox import Mailbox
from ..test import Test
from .reporter import Reporter
from .watched_link import WatchedRobotLink


@dataclass(frozen=True)
class Answers:
    """Inputs of the Operator during a test.

    resumed_hold: see ControlLoop. person: pulls the Car's handle, switcher: switches an extender; None without a
    person. skipping, supervision: see ControlLoop.
    """

    resumed_hold: Callable[[int], int] = lambda _: 0
    person: HandlePort | None = None
    switcher: ExtenderPort | None = None
    skipping: Skipping = field(default_factory=Skipping)
    supervision: Supervision = field(default_factory=Supervision)


NO_ANSWERS = Answers()


class MeasurementRun:
    """Run of the rest of a test with the runner of the command line."""

    def __init__(self, test: Test, new_robot: Callable[[], WatchedRobotLink], car: CarLink, mailbox: Mailbox,
                 answers: Answers = NO_ANSWERS, *, event_log: EventLog | None = None,
                 standstill: Standstill | None = None, time_line: TimeLine | None = None):
        """standstill: detects that the laptop slept; None for the loop's own. time_line: history of the Car's locks."""
        self._test = test
        self._new_robot = new_robot
        self._car = car
        self._mailbox = mailbox
        self._answers = answers
        self._event_log = event_log or EventLog()
        self._standstill = standstill
        self._time_line = time_line or TimeLine()

    def run(self, is_cancelled: Callable[[], bool], after_status: Callable[[], None]) -> RunEnded:
        """Measure; never raises, because the results must be reported in any case."""
        test = self._test
        outcome, text = self._outcome(is_cancelled, after_status)
        return RunEnded(outcome, text, tuple(test.progress.results))

    def _outcome(self, is_cancelled: Callable[[], bool], after_status: Callable[[], None]) -> tuple[Outcome, str]:
        try:
            with self._test.opened() as store:
                try:
                    self._test.keep_photos()
                    self._measure(store, is_cancelled, after_status)
                finally:
                    self._keep(store)
        except Cancelled:
            return Outcome.STOPPED, ""
        except OutputError as error:
            return Outcome.NOT_SAVED, str(error)
        except OperatorError as error:
            return Outcome.FAILED, str(error)
        # A defect must not close the window or lose the results.
        except Exception as error:
            logging.exception("The test ended by a defect of the application.")
            return Outcome.FAILED, f"The application has a defect: {type(error).__name__}: {error}"
        return Outcome.COMPLETE, ""

    def _keep(self, store: Store) -> None:
        store.discard_if_empty()
        if not store.has_findings:
            self._test.discard_photos()
        elif store.has_changed:
            store.save()

    def _measure(self, store: Store, is_cancelled: Callable[[], bool], after_status: Callable[[], None]) -> None:
        test = self._test
        recording = Recording(test.path)
        with contextlib.closing(self._new_robot()) as robot:
            robot.connect()
            reporter = Reporter(self._mailbox, robot, self._car, test.progress, after_status,
                                time_line=self._time_line)
            observer = EventObserver(reporter, self._event_log, test.scenario.line_word)
            try:
                course = recording.begin(self._car, test.progress.session.get(CAR_PROFILE, ""))
                loop = ControlLoop(robot, self._car, observer, is_cancelled, self._answers.resumed_hold,
                                   context=RunContext(course=course, event_log=self._event_log),
                                   assistance=Assistance(self._answers.person, self._answers.switcher))
                loop.skipping, loop.supervision = self._answers.skipping, self._answers.supervision
                loop.exchange.standstill = self._standstill or loop.exchange.standstill
                with self._event_log.told_to(recording.event), run_told(self._event_log, test.progress.has_findings), \
                        test.written_beside(store) as journal:
                    test.progress.note_used(ROBOT_SOFTWARE, loop.status.software_version)
                    Runner(test.scenario, test.parameters, loop, test.progress, lambda _: self._save(journal),
                           journal=journal, again=test.again).run()
            finally:
                self._end(recording, store)
            test.again = ()

    def _save(self, journal: JournalBeside) -> None:
        if self._test.has_moved:
            # All results are durable, so no other writer is active.
            self._test.save()
        else:
            journal.save()

    def _end(self, recording: Recording, store: Store) -> None:
        for problem in filter(None, recording.end()):
            logging.warning(problem)
        if not store.has_findings:
            recording.discard()
