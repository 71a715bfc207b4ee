"""Runs a test: prepares, measures line after line, keeps each result before the robot goes on."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import contextlib
from dataclasses import replace
from typing import Any, Callable, Iterator, Sequence

from .actions.car import Car
from .actions.car_size import nearness_of, size_cautions
from .actions.control_loop import ControlLoop
from .actions.preparation import check_car, prepare
from .actions.robot import Robot
from .battery.retreat import Retreat
from .clocks.clock_offset import offset_sentence
from .errors import BatteryCritical, OperatorError, OutputError, ProgressFileError, RobotFailed
from .interfaces.part import part
from .interfaces.scenario_parts import Concluding, FurtherAttempts, Resuming, StartChecks
from .results.course import CourseJournal
from .results.frame_record import check_entry
from .results.journal import (
    CAR,
    CHECK,
    FURTHER,
    LINE,
    LINE_BEGUN,
    LINE_RESUMED,
    REVISED,
    SESSION,
    SKIPPED,
    SUPERSEDED,
    Journal,
    plain_fields,
)
from .results.line_result import LineResult
from .results.notebook import Notebook
from .results.progress import Progress, car_document
from .results.refusals import Refusals
from .results.session_record import (
    ENDED_BY,
    MEASURED_AGAIN,
    RECOVERED,
    WIDENED,
    again_text,
    area_record,
    clock_record,
    controller_record,
    preflight_record,
)
from .robot_status import CheckState
from .scenario import AnyScenario, Line, ScenarioParameters
from .supervision.admission import admit
from .verdict.assessment import Assessor
from .verdict.looking import Looking
from .verdict.suitability import check_lines
from .verdict.widening import widened_text


class Runner:
    """One test from its beginning, or from where its progress ends, to its end.

    journal keeps each finding before the robot goes on. save is called with the progress after each line, when all
    entries are safe; the journal waits for it as for an entry. again: numbers of measured lines that the Operator wants
    measured once more.
    """

    def __init__(self, scenario: AnyScenario, parameters: ScenarioParameters, loop: ControlLoop, progress: Progress,
                 save: Callable[[Progress], None], *, journal: Journal | None = None, again: Sequence[int] = ()):
        self._scenario = scenario
        self._parameters = parameters
        self._loop = loop
        self._progress = progress
        self._save = save
        kept = CourseJournal(journal or Journal(), loop.context.course)
        self._notebook = Notebook(progress, scenario.result_type, kept)
        loop.context = replace(loop.context, journal=self._notebook,
                               refusals=Refusals(progress.session, self._notebook))
        self._robot = Robot(loop, progress.results)
        self._retreat = Retreat(self._robot)
        self._car = Car(loop)
        self._looking = Looking(scenario, parameters, progress, self._revise, loop.step)
        self._total = 0
        self._again = list(again)

    def run(self) -> None:
        """Measure all lines, the invalid ones once more at the end; the robot stands still afterwards in any case."""
        try:
            try:
                self._measure_all()
            except BatteryCritical:
                self._retreat.run()
                raise
            finally:
                # Before anything else, for the disk may be slow.
                self._halt()
        except OperatorError as error:
            self._note_end(error)
            raise
        self._conclude()

    def _measure_all(self) -> None:
        parameters = self._parameters
        if self._progress.notice:
            self._notebook.add(SESSION, {RECOVERED: self._progress.notice})
        # Before the robot moves, for mapping too.
        notices = tuple(self._car.notices)
        checks = part(self._scenario, StartChecks)
        checks.check_means(self._car)
        self._warn(*notices, *checks.cautions(parameters, self._car.facts))
        released = admit(self._loop, self._progress.identity)
        prepare(self._loop, self._robot, self._car, parameters.key_height_m, parameters.maximum_speed_mps)
        self._retreat.begin()
        # What bus and clocks have told meanwhile.
        self._warn(*(sentence for sentence in self._car.notices if sentence not in notices))
        ahead_s = self._loop.clock_offset.ahead_s
        self._warn(*filter(None, (offset_sentence(ahead_s),)))
        told = self._loop.status
        record = {**controller_record(told.controller_name), **clock_record(ahead_s),
                  **preflight_record(self._loop.preflight, told.steady_s), **area_record(told.area),
                  **released,
                  **self._progress.with_earlier(self._car.record)}
        if record:
            self._notebook.add(SESSION, record)
        lines = self._lines()
        # Before the robot drives round for the check: the Car and the robot are still as they were.
        half = self._finish_half_line(lines)
        if parameters.self_check:
            self._check_car()
        if half is not None:
            self._notebook.add(LINE, {"result": half.to_document(), "frame": self._frame_of_line()})
        self._measure(lines)
        self._measure_further(lines)
        self._loop.context.refusals.keep()

    def _warn(self, *sentences: str) -> None:
        for sentence in sentences:
            self._robot.say(f"warning: {sentence}")

    def _note_end(self, error: OperatorError) -> None:
        """Why a test ended and what was refused until then stands in its record, if anything can still be kept; what
        was measured before, and is not, is said in its place."""
        self._notebook.wait()
        self._notebook.check()
        with contextlib.suppress(OutputError):
            self._loop.context.refusals.keep()
            self._notebook.add(SESSION, {ENDED_BY: str(error)})

    def _halt(self) -> None:
        stands = self._loop.halt()
        if stands is not None:
            self._robot.say("the robot stands still" if stands else "the robot does not confirm that it stands still; "
                            "without an application it stops by itself")

    def _conclude(self) -> None:
        """The robot stands: what takes long may."""
        revised = part(self._scenario, Concluding).concluded(self._parameters, self._progress.results)
        widened = widened_text(self._scenario.line_word, self._progress.results, revised)
        if widened:
            self._warn(widened)
            self._notebook.add(SESSION, {WIDENED: widened})
        for result in revised:
            self._revise(result)
        self._notebook.wait()
        self._notebook.check()
        if revised:
            self._save(self._progress)

    def _revise(self, result: LineResult) -> None:
        self._notebook.add(REVISED, {"result": result.to_document()})

    def _check_car(self) -> None:
        check = check_car(self._robot)
        if check is None:
            return
        self._notebook.add(CHECK, {"check": plain_fields(check_entry(check, self._robot.now_s)),
                                   "frame": self._frame()})
        if check.state is CheckState.FAILED:
            raise RobotFailed(f"The test does not begin. {check.message}".rstrip())

    def _lines(self) -> Sequence[Line]:
        mapped = self._car.dimensions()
        self._progress.check_car(mapped)
        if self._progress.car is None:
            self._notebook.add(CAR, {name: plain_fields(value) for name, value in car_document(mapped).items()})
        lines: Sequence[Line] = self._scenario.lines(self._parameters, self._progress.measured_car)
        if self._progress.limits is not None:
            check_lines(self._progress.limits, lines, self._scenario.line_word)
        self._check_nearness(lines)
        for sentence in size_cautions([line.ray for line in lines], self._progress.measured_car):
            self._robot.say(f"warning: {sentence}")
        return lines

    def _check_nearness(self, lines: Sequence[Line]) -> None:
        nearest_m, _ = self._parameters.distance_range_m
        nearness = nearness_of([line.ray for line in lines], nearest_m, self._progress.measured_car)
        if nearness is not None:
            raise RobotFailed(f"The test does not begin. {nearness.sentence}")

    def _frame(self) -> Any:
        return None if self._loop.frames.newest is None else plain_fields(self._loop.frames.newest)

    def _frame_of_line(self) -> Any:
        """That in which the line at hand was measured: one that was corrected behind its points says nothing of it."""
        point = next(iter(self._progress.points.values()), None)
        return self._frame() if point is None else point.frame

    def _finish_half_line(self, lines: Sequence[Line]) -> LineResult | None:
        """Result of the line on which the test was interrupted, when it can be finished; it counts when the Car stands
        where it was."""
        progress = self._progress
        line = next((line for line in lines if line.number == progress.line_at_hand), None)
        if line is None or not progress.points:
            return None
        self._robot.take_up(progress.points)
        try:
            if not part(self._scenario, Resuming).can_go_on(line, self._parameters, self._robot, self._car):
                self._notebook.add(SUPERSEDED, {"line": line.number})
                return None
            self._notebook.add(LINE_RESUMED, {"line": line.number})
            with self._at_hand(line):
                result: LineResult = self._scenario.measure(line, self._parameters, self._robot, self._car)
            return result
        finally:
            self._robot.take_up({})

    def _measure(self, lines: Sequence[Line]) -> None:
        by_number = {line.number: line for line in lines}
        self._total = len(lines)
        done = self._progress.measured()
        if not set(done) <= set(by_number):
            raise ProgressFileError(f"The progress file holds {self._scenario.line_word} {max(done)}; this test has "
                                    f"{self._total}.")
        self._again = [number for number in self._again if number in done]
        self._loop.observer.on_plan(len(done) - len(self._again), self._total)
        for number, line in by_number.items():
            if number not in done:
                self._measure_line(line)
        if self._again:
            self._notebook.add(SESSION, {MEASURED_AGAIN: again_text(self._progress.session, self._again)})
        for number in list(self._again):
            self._again.remove(number)
            self._measure_line(by_number[number])
        for number in self._progress.to_retry():
            self._measure_line(by_number[number])

    def _measure_further(self, lines: Sequence[Line]) -> None:
        """More attempts on the lines about whose limits nobody knows, until they are decided or the time is over."""
        progress = self._progress
        if progress.limits is None or progress.calibration is None or progress.limits.further_time_limit_s <= 0.0:
            return
        assessor = Assessor(self._scenario, self._parameters, progress.measured_car, progress.calibration)
        until_s = self._loop.waited_s + progress.limits.further_time_limit_s
        waiting = {line.number: line for line in lines if line.number not in progress.skipped}
        self._looking.look_first(assessor.assess(progress).decided())
        while self._loop.waited_s < until_s:
            undecided = assessor.assess(progress).undecided()
            number = next((number for number in waiting if number in undecided), None)
            if number is None:
                break
            line = waiting.pop(number)
            # To the end of the queue: each line has its turn before one has its second.
            if self._measure_line_further(line):
                waiting[number] = line
        self._looking.look_last()
        self._save(progress)

    def _measure_line_further(self, line: Line) -> bool:
        """True when the line has a new result, and more attempts may tell more; none of another Car frame may."""
        if not self._is_in_its_frame(line):
            return False
        self._car.wait_for_bus()
        self._notebook.add(FURTHER, {"line": line.number})
        so_far = next(result for result in self._progress.results if result.number == line.number)
        with self._at_hand(line):
            result = part(self._scenario, FurtherAttempts).measure_further(line, self._parameters, self._robot,
                                                                           self._car, so_far)
        if result is None or not self._is_in_its_frame(line):
            return False
        self._keep_line(result if result.invalid_count else self._looking.next(so_far, result))
        return not result.invalid_count

    def _is_in_its_frame(self, line: Line) -> bool:
        newest = self._loop.frames.newest
        if newest is not None and self._progress.frame_record.is_of(line.number, newest):
            return True
        self._warn(f"The Car coordinate system is another one than that of {self._scenario.line_word} {line.number}, "
                   "which gets no more attempts.")
        return False

    def _measure_line(self, line: Line) -> None:
        self._car.wait_for_bus()
        self._notebook.add(LINE_BEGUN, {"line": line.number})
        with self._at_hand(line):
            result = self._scenario.measure(line, self._parameters, self._robot, self._car)
        self._keep_line(result)

    @contextlib.contextmanager
    def _at_hand(self, line: Line) -> Iterator[None]:
        """Within the context the Operator may skip this line; with its end it is kept that it was."""
        skipping, observer = self._loop.skipping, self._loop.observer
        skipping.begin(line.number)
        observer.on_line(line.number)
        try:
            yield
        finally:
            skipping.end()
            observer.on_line(0)
        if skipping.is_skipped:
            self._notebook.add(SKIPPED, {"line": line.number})

    def _keep_line(self, result: LineResult) -> None:
        self._notebook.add(LINE, {"result": result.to_document(), "frame": self._frame_of_line()})
        if self._loop.car_guard.reason:
            self._save(self._progress)
            self._loop.check_car_guard()
        self._loop.settle()
        self._save(self._progress)
        self._loop.settle()
        # Shown when it is kept: what a person has read is there after the next start.
        self._loop.observer.on_result(result, len(self._progress.results) - len(self._again), self._total)
