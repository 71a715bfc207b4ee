"""One test from its parameters to its protocol, with its progress file."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import contextlib
import dataclasses
import itertools
import os
import pathlib
from dataclasses import dataclass, field
from typing import Iterator

from mtr_operator.domain.identity.file_name import to_file_name
from mtr_operator.domain.identity.identity import Identity, Photo
from mtr_operator.domain.results.journal import IDENTITY
from mtr_operator.domain.results.progress import Progress
from mtr_operator.domain.results.session_record import ANNOTATED, STARTED, SUBSTITUTE, now, session_record, written
from mtr_operator.domain.robot_status import CarDimensions
from mtr_operator.domain.scenario import AnyScenario, ScenarioParameters
from mtr_operator.domain.scenarios import SCENARIOS
from mtr_operator.storage.atomic import output_folder
from mtr_operator.storage.given_files import Given
from mtr_operator.storage.identity_file import GivenIdentity
from mtr_operator.storage.journal.beside import JournalBeside
from mtr_operator.storage.journal.journal_file import journal_path
from mtr_operator.storage.means import Means
from mtr_operator.storage.photos import copy_photos, discard_photos, keep_photos, photo_folder
from mtr_operator.storage.progress_file import FILE_NAME, free_path, holds_no_other, open_progress
from mtr_operator.storage.recorded.kept_car import digest_text, profile_content
from mtr_operator.storage.recovery import progress_path
from mtr_operator.storage.store import Store

from .connection import SIMULATED, CanChoice, Connection
from .estimate import USUAL_CAR
from .identity_entry import Annotation

NOTHING_SAID = GivenIdentity()
_MOMENT = "%Y-%m-%d_%H-%M-%S"
_SECOND = len("2026-11-22T15:36:05")


@dataclass
class Test:
    """Test and the location of its progress. While it runs, progress belongs to the links' thread.

    again: measured lines that are to be measured once more. photos: files to be stored with the test.
    """

    # Otherwise pytest would collect it because of its name.
    __test__ = False

    scenario: AnyScenario
    parameters: ScenarioParameters
    progress: Progress
    path: pathlib.Path
    again: tuple[int, ...] = ()
    photos: tuple[pathlib.Path, ...] = ()
    _store: Store | None = field(default=None, init=False, compare=False)
    _beside: JournalBeside | None = field(default=None, init=False, compare=False)
    _sources: tuple[pathlib.Path, ...] = field(default=(), init=False, compare=False)

    @property
    def name(self) -> str:
        """Name of the files and the folder of this test."""
        return self.path.stem

    @property
    def car(self) -> CarDimensions:
        """The measured Car, or a usual one before."""
        return self.progress.car or USUAL_CAR

    @property
    def line_count(self) -> int:
        """Lines of the whole test, by the Car as far as it is known."""
        return len(self.scenario.lines(self.parameters, self.car))

    @property
    def is_complete(self) -> bool:
        """True if all lines are measured."""
        progress = self.progress
        return (progress.car is not None and len(progress.results) == self.line_count
                and not progress.to_retry() and not self.again)

    @contextlib.contextmanager
    def opened(self) -> Iterator[Store]:
        """Context with exclusive write access to the files; OperatorError states why it is denied."""
        with output_folder(self.path.parent), Store(self.path, self.progress) as store:
            self._store = store
            try:
                yield store
            finally:
                self._store = None

    @contextlib.contextmanager
    def written_beside(self, store: Store) -> Iterator[JournalBeside]:
        """Context within `opened` in which a thread writes; JournalBeside reports failures."""
        with JournalBeside(store) as journal:
            self._beside = journal
            try:
                yield journal
            finally:
                self._beside = None

    @property
    def has_moved(self) -> bool:
        """True while it runs and its files have not been moved to their new location."""
        return self._store is not None and self._store.path != self.path

    def save(self) -> None:
        """Write the progress, and create its folder if needed; OperatorError states a failure."""
        if self._beside is not None:
            # A progress file contains the position of the journal, so all entries must be written.
            self._beside.wait()
        if self._store is None:
            with self.opened() as store:
                store.save()
            return
        if self.has_moved:
            with output_folder(self.path.parent):
                former = photo_folder(self._store.path)
                self._store.move(self.path)
                copy_photos(self._kept_photos, former, photo_folder(self.path))
        self._store.save()

    @property
    def _kept_photos(self) -> tuple[Photo, ...]:
        return () if self.progress.identity is None else self.progress.identity.photos

    def keep_photos(self) -> None:
        """Copy the waiting photos next to the progress file; OperatorError states a failure."""
        if self.photos:
            identity = self.progress.identity or Identity()
            photos = keep_photos(self.photos, photo_folder(self.path))
            self.progress.identity = dataclasses.replace(identity, photos=photos)
            self._sources, self.photos = self.photos, ()

    def annotate(self, annotation: Annotation) -> None:
        """Store notes and further photos of a test that does not run, with the date; OperatorError states a failure."""
        identity = self.progress.identity or Identity()
        annotation.check(identity)
        with self.opened() as store:
            photos = keep_photos(annotation.photos, photo_folder(self.path), identity.photos)
            self.progress.identity = dataclasses.replace(identity, notes=annotation.notes.strip(), photos=photos)
            self.progress.session[ANNOTATED] = written(now())
            store.add(IDENTITY, self.progress.identity.to_document())
            store.save()

    def discard_photos(self) -> None:
        """Remove copies of photos if nothing was measured; the photos wait for the next run."""
        if self._sources and self.progress.identity is not None:
            discard_photos(photo_folder(self.path))
            self.progress.identity = dataclasses.replace(self.progress.identity, photos=())
            self._sources, self.photos = (), self._sources


def new_test(scenario: AnyScenario, parameters: ScenarioParameters, folder: pathlib.Path,
             connection: Connection, given: Given | None = None, *, who: GivenIdentity = NOTHING_SAID) -> Test:
    """Return a new test without measurements; by default without limits and with the design's calibration."""
    started = now()
    session = session_record(started, *_means(connection))
    path = free_path(folder / f"{scenario.name}_{started.strftime(_MOMENT)}.json")
    progress = Progress(scenario.name, parameters.to_mapping(), session)
    (given or Given()).give(progress)
    progress.identity = None if who.identity.is_empty else who.identity
    return Test(scenario, parameters, progress, path, photos=who.photos)


def report_folder(folder: pathlib.Path, test: Test) -> pathlib.Path:
    """Return the folder for the report of a test: with its name, or with a number if that is occupied.

    Progress files of the command line all have the same name; their reports are named after scenario and start.
    """
    name = test.name
    if test.path.name == FILE_NAME:
        started = test.progress.session.get(STARTED, "")[:_SECOND].replace("T", "_").replace(":", "-")
        name = f"{test.scenario.name}_{started}" if started else test.path.parent.name
    name = to_file_name(name, test.scenario.name)
    others = (folder / f"{name}_{number}" for number in itertools.count(2))
    return next(place for place in itertools.chain([folder / name], others) if _is_free(place, test))


def _is_free(place: pathlib.Path, test: Test) -> bool:
    """Return True for a new or empty folder, and for the one with this test's report, which contains its record."""
    if os.path.lexists(place / FILE_NAME):
        # With a journal it is a test instead of a report.
        return not os.path.lexists(journal_path(place / FILE_NAME)) and holds_no_other(place / FILE_NAME, test.progress)
    return not os.path.lexists(place) or (place.is_dir() and not any(place.iterdir()))


def profile_name(can: CanChoice | None) -> str:
    """Return the name of the Car's profile for the results."""
    if can is None:
        return ""
    return SUBSTITUTE if can.interface == SIMULATED else can.profile


def open_test(path: pathlib.Path) -> Test:
    """Return the test in a progress file, to be resumed; ProgressFileError states a fault of the file."""
    scenario, parameters, progress = open_progress(path, SCENARIOS, to_go_on=True)
    return Test(scenario, parameters, progress, progress_path(path))


def go_on(test: Test, connection: Connection) -> None:
    """Record that the test starts or resumes now; ProgressFileError if it was started with other equipment."""
    _means(connection).go_on(test.progress)


def _means(connection: Connection) -> Means:
    profile = profile_name(connection.can)
    return Means(connection.robot.host, profile, digest_text(profile_content(profile)))
