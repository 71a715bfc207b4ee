"""One test from parameter file to protocol."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import argparse
import contextlib

from mtr_operator.domain.actions.control_loop import ControlLoop
from mtr_operator.domain.actions.event_observer import EventObserver, run_told
from mtr_operator.domain.actions.trouble import Cancelled
from mtr_operator.domain.clocks.simulated_time import is_simulated_robot
from mtr_operator.domain.errors import OperatorError
from mtr_operator.domain.eventlog.event_log import EventLog
from mtr_operator.domain.exchange.run_context import Assistance, RunContext
from mtr_operator.domain.interfaces.part import part
from mtr_operator.domain.interfaces.scenario_parts import Concluding
from mtr_operator.domain.ports import RobotLink
from mtr_operator.domain.results.document import shown_text
from mtr_operator.domain.results.progress import Progress
from mtr_operator.domain.results.session_record import CAR_PROFILE, ROBOT_SOFTWARE, SUBSTITUTE, now, session_record
from mtr_operator.domain.robot_status import RobotStatus
from mtr_operator.domain.runner import Runner
from mtr_operator.domain.scenarios import SCENARIOS
from mtr_operator.domain.supervision.area import set_area
from mtr_operator.domain.supervision.conditions import CONDITIONS
from mtr_operator.domain.supervision.supervision import Supervision
from mtr_operator.domain.verdict.assessment import Assessment
from mtr_operator.domain.verdict.suitability import check_before_start
from mtr_operator.domain.verdict.verdict import Verdict
from mtr_operator.report.files import FILE_NAMES, write_report
from mtr_operator.report.side_summary import side_summaries
from mtr_operator.report.side_table import side_table
from mtr_operator.report.table import results_table
from mtr_operator.report.verdict_text import verdict_lines
from mtr_operator.storage import progress_file
from mtr_operator.storage.atomic import output_folder
from mtr_operator.storage.given_files import Given, calibration_of
from mtr_operator.storage.journal.beside import JournalBeside
from mtr_operator.storage.means import Means
from mtr_operator.storage.parameter_file import load_parameters
from mtr_operator.storage.recorded.kept_car import digest_text, profile_content
from mtr_operator.storage.recorded.recording import Recording
from mtr_operator.storage.store import Store
from mtr_operator.terminal import show

from .display import Display
from .enter import Enter
from .handle import HandleQuestion
from .identity import RunIdentity
from .interrupt import Interrupt
from .links import car_link, lives_in_real_time, phone_feed, robot_link
from .planning import RunForecast
from .records.evidence import write_for
from .release import PresenceQuestion, Release


class CommandLineRun:
    """Test of the command line. Its constructor checks options and files, and changes nothing."""

    def __init__(self, options: argparse.Namespace):
        self._options = options
        self._scenario = SCENARIOS[options.scenario]
        kind = self._scenario.parameters_type
        # The demo needs no parameter file.
        self._parameters = kind.from_mapping(kind.proposed()) if options.params is None else \
            load_parameters(options.params, kind)
        self._path = options.out / progress_file.FILE_NAME
        self._given = Given(options.limits, options.calibration)
        if self._given.limits is not None:
            check_before_start(self._given.limits, self._scenario, self._parameters)
        self._identity = RunIdentity(options)
        self._progress = self._begin()
        self._recording = Recording(self._path, options.can_log_format)
        self._car = car_link(options)
        self._phone = phone_feed(options)
        self._robot = robot_link(options, is_real_time=lives_in_real_time(options))

    def run(self) -> Verdict:
        """Measure the remaining lines and write the report; OperatorError or Cancelled if the test does not finish."""
        with contextlib.closing(self._display()) as display, Interrupt() as interrupt:
            with output_folder(self._options.out), Store(self._path, self._progress) as store:
                try:
                    self._identity.keep(store, self._progress)
                    self._measure(display, interrupt, store)
                    display.close()
                    store.save()
                    assessment = write_report(self._options.out, self._scenario, self._parameters, self._progress,
                                              display.say)
                except BaseException:
                    display.close()
                    self._keep(display, store)
                    raise
            try:
                if self._options.bundle:
                    display.say(write_for(self._path, self._scenario, self._progress, assessment))
            finally:
                self._say_results(assessment)
            if interrupt.requested:
                raise Cancelled("Interrupted when all lines were measured; the results are complete.")
        return Verdict.NOT_SET if assessment.judgement is None else assessment.judgement.verdict

    def _display(self) -> Display:
        return Display(self._scenario, parameters=self._parameters)

    def _begin(self) -> Progress:
        continued, path = self._options.continued, self._path
        if continued is None or not progress_file.is_same_test(continued, path):
            progress_file.refuse_to_overwrite(path, FILE_NAMES)
        parameters = self._parameters.to_mapping()
        if continued is None:
            progress = Progress(self._scenario.name, parameters, session_record(now(), *_means(self._options)))
            self._given.give(progress)
            self._identity.give(progress)
            return progress
        progress = progress_file.load_progress(continued, self._scenario, parameters)
        self._given.compare(progress)
        self._identity.compare(progress)
        _means(self._options).go_on(progress)
        return progress

    def _measure(self, display: Display, interrupt: Interrupt, store: Store) -> None:
        today = now().date()
        outdated = [] if self._progress.identity is None else self._progress.identity.warnings(today)
        cautions = calibration_of(self._progress).cautions(self._parameters, today)
        for notice in (self._progress.notice, *cautions, *outdated):
            if notice:
                display.say(shown_text(notice))
        enter = Enter()
        with contextlib.closing(self._car) as car, contextlib.closing(self._robot) as robot, self._phone_closing():
            for link in (car, robot, self._phone):
                if link is not None:
                    link.connect()
                if interrupt.requested:
                    raise Cancelled("Interrupted; the robot was not moved.")
            events = EventLog()
            observer = EventObserver(display, events, self._scenario.line_word)
            course = self._recording.begin(car, self._progress.session.get(CAR_PROFILE, ""))
            person = HandleQuestion(display.say, enter).person
            loop = ControlLoop(robot, car, observer, interrupt.is_requested, Release(display.say, enter),
                               context=RunContext(course=course, event_log=events),
                               assistance=Assistance(person, person, self._phone))
            if self._options.test_area is not None:
                set_area(loop, self._options.test_area)
            loop.supervision = self._supervision(display, enter, loop.status)
            rejected_before = loop.status.rejected_messages
            self._progress.note_used(ROBOT_SOFTWARE, loop.status.software_version)
            display.forecast = RunForecast(self._scenario, self._parameters, car.facts, self._progress)
            display.say(display.forecast.before(loop.status))
            try:
                with events.told_to(self._recording.event), run_told(events, self._progress.has_findings), \
                        JournalBeside(store) as journal:
                    Runner(self._scenario, self._parameters, loop, self._progress, lambda _: journal.save(),
                           journal=journal).run()
            finally:
                for problem in filter(None, self._recording.end()):
                    display.say(shown_text(problem))
                _say_statistics(display, robot, loop.status.rejected_messages - rejected_before)

    def _supervision(self, display: Display, enter: Enter, status: RobotStatus) -> Supervision:
        """Return the supervision: for a real robot a person at the command line, or the declared rated stop."""
        stop = self._identity.unattended_stop
        if is_simulated_robot(status) or stop:
            return Supervision(unattended_stop=stop)
        presence = PresenceQuestion(display.say, enter, self._scenario.announcement).presence
        presence.ask()
        return Supervision(presence, confirmed=tuple(CONDITIONS))

    def _phone_closing(self) -> contextlib.AbstractContextManager[object]:
        return contextlib.nullcontext() if self._phone is None else contextlib.closing(self._phone)

    def _keep(self, display: Display, store: Store) -> None:
        """Keep the results of a test that did not finish."""
        store.discard_if_empty()
        if not store.has_findings:
            self._recording.discard()
            self._identity.discard_photos(self._path)
            return
        try:
            if store.has_changed:
                store.save()
        except OperatorError as error:
            display.say(shown_text(str(error)))
        else:
            progress = self._progress
            half = f" and a part of {self._scenario.line_word} {progress.line_at_hand}" if progress.points else ""
            display.say(f"{len(progress.results)} measured lines{half} are kept; go on with --continue {self._path}")

    def _say_results(self, assessment: Assessment) -> None:
        results = self._progress.results
        for line in results_table(self._scenario, results, self._parameters):
            show(line)
        judgement = assessment.judgement
        summaries = side_summaries(self._scenario, self._parameters, self._progress, judgement)
        for line in side_table(summaries, judgement is not None):
            show(line)
        for name, text in part(self._scenario, Concluding).summary(results):
            show(f"{name}: {text}")
        for line in verdict_lines(self._scenario, results, assessment.judgement):
            show(line)
        invalid = sum(1 for result in results if result.invalid_count)
        tail = f", {invalid} of them invalid" if invalid else ""
        show(f"{len(results)} lines measured{tail}; results are in {self._options.out}.")


def _means(options: argparse.Namespace) -> Means:
    profile = SUBSTITUTE if options.simulated_car else options.car_profile
    return Means(SUBSTITUTE if options.simulated_robot else options.robot, profile,
                 digest_text(profile_content(profile)))


def _say_statistics(display: Display, robot: RobotLink, rejected: int) -> None:
    ignored = robot.statistics.ignored
    if ignored:
        display.say(f"{ignored} messages from the robot were ignored: {robot.statistics.last_error}")
    if rejected > 0:
        display.say(f"The robot rejected {rejected} messages during the test.")
