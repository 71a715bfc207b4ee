"""What the Operator does, from connection to protocol: turns clicks into requests, and events into screens."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import dataclasses
import enum
import pathlib
from typing import Sequence

from PyQt5.QtCore import QObject, pyqtSignal

from mtr_operator.domain.errors import OperatorError
from mtr_operator.domain.eventlog.entry import EventKind
from mtr_operator.domain.geometry.pose import Point
from mtr_operator.domain.scenario import AnyScenario, ScenarioParameters
from mtr_operator.domain.supervision.conditions import CONDITIONS
from mtr_operator.station.begun.starting import begun_test
from mtr_operator.station.begun.unfinished import UnfinishedTest
from mtr_operator.station.bus.bus_view import BusView
from mtr_operator.station.connection import LinkOpener
from mtr_operator.station.disk_watch import DiskWatch
from mtr_operator.station.events import (
    LineMeasured,
    LinesPlanned,
    LinksOpened,
    Outcome,
    ProgressSaved,
    RunEnded,
    StandstillSeen,
    StationEvent,
)
from mtr_operator.station.links.idle_loop import CalibrationRequest, CarRequest
from mtr_operator.station.readiness import RUNNING, Phase, is_held_by_stop
from mtr_operator.station.settings_file import SettingsStore
from mtr_operator.station.test import NOTHING_SAID, Test, go_on, open_test
from mtr_operator.storage.given_files import GivenPaths
from mtr_operator.storage.identity_file import GivenIdentity

from .bridge import Bridge
from .links.connecting import Connecting

NO_PATHS = GivenPaths()


class Step(enum.Enum):
    """The steps of the header bar."""

    WELCOME = 0
    TYPE = 1
    MEASUREMENT = 2
    PROTOCOL = 3


class Flow(QObject):
    """Knows no widget.

    Attributes:
        model: what is known of robot, Car and test. store: settings. connecting: has the links.
        unfinished: the test that can be gone on with.
    Signals:
        step_changed(Step): another screen is due.
        failed(text): the Operator has to know this sentence.
        saved(text): the progress was written there.
        stopped: the Operator has stopped the robot.
        language_changed(code): the Operator wants another language, see settings.LANGUAGES.
        folder_wanted(test, text): its folder cannot be written, for this reason; see use_progress_folder.
    """

    step_changed = pyqtSignal(object)
    failed = pyqtSignal(str)
    saved = pyqtSignal(str)
    folder_wanted = pyqtSignal(object, str)
    language_changed = pyqtSignal(str)
    stopped = pyqtSignal()

    def __init__(self, bridge: Bridge, store: SettingsStore, opener: LinkOpener):
        super().__init__()
        self.bridge = bridge
        self.model = bridge.model
        self.store = store
        self.unfinished = UnfinishedTest(store)
        self.connecting = Connecting(bridge, store, opener)
        self.step = Step.WELCOME
        self._disk = DiskWatch(lambda: self.store.settings.progress_folder)
        bridge.happened.connect(self._learn)
        bridge.changed.connect(self._learn_room)

    def close(self) -> bool:
        """Stop the robot and disconnect; True when that has succeeded in time."""
        self._disk.stop()
        return self.connecting.close()

    def keep_after_defect(self, text: str) -> None:
        """The application has a defect: write what is measured, and say it."""
        worker = self.connecting.worker
        if worker is not None:
            worker.note(text, EventKind.FAULT)
            if self.model.test is not None and self.model.test.progress.has_findings:
                worker.save(self.model.test)
        self.failed.emit(text)

    # Screens

    def show(self, step: Step) -> None:
        """Go to a step."""
        self.step = step
        self.step_changed.emit(step)

    def to_welcome(self) -> None:
        """Back to the beginning; an unfinished test stays on disk. Back to the measurement while a test is measured."""
        if self.model.phase in RUNNING:
            self.show(Step.MEASUREMENT)
            return
        self.model.lay_aside()
        if self.connecting.worker is not None:
            self.connecting.worker.lay_aside()
        self.show(Step.WELCOME)

    def use_language(self, code: str) -> None:
        """Speak another language from now on, and after the next start."""
        self.store.change(dataclasses.replace(self.store.settings, language=code))
        self.language_changed.emit(code)

    # Test

    def start(self, scenario: AnyScenario, parameters: ScenarioParameters, paths: GivenPaths = NO_PATHS,
              who: GivenIdentity = NOTHING_SAID, confirmed: Sequence[str] = ()) -> None:
        """Begin a test; failed follows when a file that is given does not suit it any more, or the laboratory requires
        more. confirmed: operating conditions."""
        if self.is_measuring():
            return
        try:
            self.model.take_up(begun_test(self.store, self.connecting.connection, scenario, parameters,
                                          paths=paths, who=who))
        except OperatorError as error:
            self.failed.emit(str(error))
            return
        self._goes_on(confirmed)
        self.show(Step.MEASUREMENT)

    def resume(self) -> None:
        """Measure what is left of the test at hand; failed follows when it was begun with other means. Who resumes
        confirms the operating conditions, as the screen says."""
        self._goes_on(tuple(CONDITIONS))

    def is_measuring(self) -> bool:
        """True, and failed follows, while a test is measured, which keeps the window: a dialog or a thread may be
        answered late."""
        if self.model.phase in RUNNING:
            self.failed.emit("A test is being measured: stop it first, then open or begin another one.")
        return self.model.phase in RUNNING

    def _goes_on(self, confirmed: Sequence[str]) -> bool:
        if self.is_measuring():
            return False
        test = self.model.current_test
        try:
            go_on(test, self.connecting.connection)
        except OperatorError as error:
            test.again = ()
            self.failed.emit(str(error))
            return False
        self._release_stop()
        self.model.begin()
        self.connecting.links.run_test(test, confirmed)
        return True

    def measure_again(self, numbers: Sequence[int]) -> None:
        """Measure lines of the test at hand once more; their former results stay in its journal."""
        if self.is_measuring():
            return
        self.model.current_test.again = tuple(numbers)
        # On a real robot the next screen asks for the conditions.
        if self._goes_on(()):
            self.show(Step.MEASUREMENT)

    def stop(self) -> None:
        """Stop the robot, whatever it does: the stop has left when this returns. The line that is being measured is
        measured anew later."""
        if self.connecting.worker is not None:
            self.connecting.worker.stop()
            self.model.order_stop()
            self.stopped.emit()
            self.bridge.changed.emit()

    def enter_service(self) -> None:
        """Stop the robot, whatever it does, and disable its wheels, lift and servos."""
        if self.connecting.worker is not None:
            self.connecting.worker.enter_service()
            self.model.order_stop()
            self.stopped.emit()
            self.bridge.changed.emit()

    def leave_service(self, agreement_id: int) -> None:
        """Release service mode for the Operator."""
        if self.connecting.worker is not None:
            self.connecting.worker.leave_service(agreement_id)

    def skip_line(self) -> None:
        """Leave the line that is being measured, and go on with the next one; it can be measured again later."""
        if self.model.line:
            self.connecting.links.skip_line(self.model.line)

    def bus_view(self) -> BusView:
        """What comes over the Car's bus now, and what its locks did; nothing before a connection."""
        worker = self.connecting.worker
        return BusView() if worker is None else worker.bus_view()

    def release_hold(self) -> None:
        """Have a robot go on that is held."""
        if self.model.robot is not None:
            self.connecting.links.release_hold(self.model.robot.status.hold_id)

    def _release_stop(self) -> None:
        """Start, Resume, Check and Map are buttons that are held, by the Operator who has stopped the robot. Any other
        cause of a hold is resumed on its own."""
        if self.model.robot is not None and is_held_by_stop(self.model.robot.status):
            self.release_hold()

    def answer_prompt(self) -> None:
        """The Operator has taken the Car's handle, or switched the extender."""
        if self.model.prompt is not None:
            self.connecting.links.answer(self.model.prompt)

    def confirm_presence(self) -> None:
        """The Operator is present."""
        if self.connecting.worker is not None:
            self.connecting.worker.confirm_presence()

    def save_progress(self) -> None:
        """Write the progress now; saved or folder_wanted follows."""
        self.connecting.links.save(self.model.current_test)

    def use_progress_folder(self, test: Test, folder: pathlib.Path) -> None:
        """Write the progress of a test, which need not be at hand any more, and of later ones there."""
        self.store.change(dataclasses.replace(self.store.settings, progress_folder=folder))
        test.path = folder / test.path.name
        self.connecting.links.save(test)

    def open(self, path: pathlib.Path) -> None:
        """Take up the test in a progress file; failed follows when it is none."""
        if self.is_measuring():
            return
        try:
            test = open_test(path)
            self.model.take_up(test)
        except OperatorError as error:
            self.failed.emit(str(error))
            return
        if test.progress.notice:
            self.failed.emit(test.progress.notice)
        if test.is_complete:
            self.model.phase = Phase.FINISHED
            self.unfinished.forget()
            self.show(Step.PROTOCOL)
        else:
            self.show(Step.MEASUREMENT)

    def open_unfinished(self) -> None:
        """Take up the test that was not finished."""
        if self.unfinished.path is not None:
            self.open(self.unfinished.path)

    def calibrate(self, request: CalibrationRequest) -> None:
        """Have the robot try something."""
        self.model.order_motion()
        self.connecting.links.calibrate(request)

    def set_area(self, corners: tuple[Point, ...], origin_id: int) -> None:
        """Have the robot keep inside this test area, without corners in none."""
        if self.connecting.worker is not None:
            self.connecting.worker.set_area(corners, origin_id)

    def request_car(self, request: CarRequest) -> None:
        """Have the robot check or map the Car, or stop doing so."""
        if request is CarRequest.STOP:
            self.stop()
            return
        self._release_stop()
        self.model.order_motion()
        self.connecting.links.request_car(request)

    # Events

    def _learn(self, event: StationEvent) -> None:
        if isinstance(event, LinksOpened):
            self._disk.start()
        elif isinstance(event, StandstillSeen):
            self.failed.emit(event.text)
        elif isinstance(event, (LinesPlanned, LineMeasured)):
            self.unfinished.remember(self.model.current_test.path)
        elif isinstance(event, RunEnded):
            self._learn_end(event)
        elif isinstance(event, ProgressSaved):
            self._learn_saved(event)

    def _learn_room(self) -> None:
        self.model.free_bytes = self._disk.free

    def _learn_end(self, event: RunEnded) -> None:
        if not self.model.current_test.progress.has_findings:
            self.unfinished.forget()
        if event.outcome is Outcome.COMPLETE:
            self.unfinished.forget()
            self.show(Step.PROTOCOL)
        elif event.outcome is Outcome.NOT_SAVED:
            self.folder_wanted.emit(self.model.current_test, event.text)

    def _learn_saved(self, event: ProgressSaved) -> None:
        if event.text:
            self.folder_wanted.emit(event.test, event.text)
        else:
            self.unfinished.move(event.test)
            self.saved.emit(str(event.test.path))
