"""What is recorded with each run of a test, beside its progress file: log of the Car's bus, course, scans, events."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import itertools
import pathlib
import shutil
from typing import Iterator, NamedTuple

from mtr_operator.domain.errors import OutputError
from mtr_operator.domain.eventlog.entry import EventEntry
from mtr_operator.domain.interfaces.car_bus import BusRecorder
from mtr_operator.domain.interfaces.part import part
from mtr_operator.domain.ports import CarLink
from mtr_operator.domain.results.course import Course

from ..inside import stays_inside
from .course_file import CourseFile
from .event_file import EventFile
from .folders import car_folder, recording_folder
from .kept_car import keep_car
from .scan_file import ScanFile

__all__ = ["DEFAULT_FORMAT", "NO_LOG", "RecordedRun", "Recording", "recorded_events", "recorded_runs",
           "recording_folder"]

DEFAULT_FORMAT = "blf"
NO_LOG = "none"
_COURSE, _BUS, _EVENTS, _SCANS = "course", "bus", "events", "scans"


class RecordedRun(NamedTuple):
    """Files of one run; log: None where there was no bus to log. scans: None of a robot that sends none."""

    course: pathlib.Path
    log: pathlib.Path | None
    scans: pathlib.Path | None = None


def recorded_runs(folder: pathlib.Path) -> list[RecordedRun]:
    """What a folder holds, run by run in their order."""
    return [RecordedRun(course, next(folder.glob(course.stem.replace(_COURSE, _BUS) + ".*"), None),
                        next(folder.glob(course.name.replace(_COURSE, _SCANS)), None))
            for course in sorted(folder.glob(f"{_COURSE}_*.jsonl"))]


def recorded_events(folder: pathlib.Path) -> list[pathlib.Path]:
    """Event lists that a folder holds, run by run in their order."""
    return sorted(folder.glob(f"{_EVENTS}_*.csv"))


class Recording:
    """Of one run; begins with begin(). log_format: a kind of log, or NO_LOG for the course alone."""

    def __init__(self, path: pathlib.Path, log_format: str = DEFAULT_FORMAT):
        self._path, self._folder = path, recording_folder(path)
        self._format = log_format
        self._bus: BusRecorder | None = None
        self._course: CourseFile | None = None
        self._scans: ScanFile | None = None
        self._events: EventFile | None = None
        self._made: list[pathlib.Path] = []

    def begin(self, car: CarLink, profile: str = "") -> Course:
        """Log the bus of a Car from now on, and keep its profile; where the course is to be kept.

        OutputError when a log cannot be begun.
        """
        if not stays_inside(self._folder.parent, self._folder):
            raise OutputError(f"The folder {self._folder} is a link that leads elsewhere; remove it.")
        self._made += keep_car(self._path, profile)
        number = self._free_number()
        self._course = CourseFile(self._folder / f"{_COURSE}_{number:03d}.jsonl")
        self._scans = ScanFile(self._folder / f"{_SCANS}_{number:03d}.jsonl", self._course)
        self._events = EventFile(self._folder / f"{_EVENTS}_{number:03d}.csv")
        if self._format != NO_LOG:
            log = self._folder / f"{_BUS}_{number:03d}.{self._format}"
            part(car, BusRecorder).log_to(log)
            self._made.append(log)
        self._bus = part(car, BusRecorder)
        self._made += [self._course.path, self._scans.path, self._events.path]
        return self._scans

    def _free_number(self) -> int:
        """Number of a run of which no file is there, also none that was left of a run without a course."""
        numbers = itertools.count(1 + len(recorded_runs(self._folder)))
        return next(number for number in numbers if not any(self._folder.glob(f"*_{number:03d}.*")))

    def event(self, entry: EventEntry) -> None:
        """Keep an entry of the event list."""
        if self._events is not None:
            self._events.add(entry)

    def end(self) -> Iterator[str]:
        """End it; sentences on what is missing."""
        if self._bus is not None:
            yield self._bus.log_problem
            self._bus.log_to(None)
        for file in (self._course, self._scans, self._events):
            if file is not None:
                file.close()
                yield file.problem
        self._bus = self._course = self._scans = self._events = None

    def discard(self) -> None:
        """Of a run of a test that has measured nothing."""
        for path in self._made:
            path.unlink(missing_ok=True)
        for folder in (car_folder(self._path), self._folder):
            if folder.is_dir() and not any(folder.iterdir()):
                shutil.rmtree(folder, ignore_errors=True)
