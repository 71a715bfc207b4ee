"""Recomputes a recorded test, and finds the differences from its record."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import pathlib
from dataclasses import dataclass
from typing import Iterator, Sequence

from mtr_operator.car_link.log.log_car import played_log
from mtr_operator.car_link.log.read_log import ReadLog
from mtr_operator.car_link.profile import CarProfile
from mtr_operator.domain.geometry.ray import Ray
from mtr_operator.domain.results.line_result import LineResult, MeasuredDistance
from mtr_operator.domain.results.progress import Progress
from mtr_operator.domain.scenario import AnyScenario, ScenarioParameters
from mtr_operator.storage.recorded.course_file import read_course
from mtr_operator.storage.recorded.recording import RecordedRun, recorded_runs

from .cannot import CannotReplay
from .locks import ReplayedLocks
from .phone import replayed_phone
from .points import Attempt, Point, Points
from .results import counted_attempts, results_anew

# Resolution of results.csv, a tenth of a millimetre.
SAME_M = 0.0001
# The presses of a zone are on many rays; only the Car's reactions are compared, because its field has no distance.
_WITHOUT_RAYS = ("zone_map",)


@dataclass(frozen=True)
class ReplayedTest:
    """Result of a replay.

    Attributes:
        recorded, now: results of the lines, in the same order. attempts: by line, as in the record.
        notices: sentences on missing or replaced data.
        is_whole: the logs contain the lock state, and extend to the end of each run.
    """

    recorded: Sequence[LineResult]
    now: Sequence[LineResult]
    attempts: dict[int, Attempt]
    notices: Sequence[str]
    is_whole: bool = True

    @property
    def points(self) -> list[tuple[int, Point]]:
        """All measurements of the record, with their lines."""
        return [(number, point) for number, attempt in self.attempts.items() for point in attempt.points]

    @property
    def changed_lines(self) -> list[tuple[LineResult, MeasuredDistance, MeasuredDistance]]:
        """Changed distances: the line, as recorded, as recomputed."""
        return [(old, former, new) for old, now in zip(self.recorded, self.now)
                for former, new in zip(old.distances, now.distances) if not is_same(former, new)]

    @property
    def worst_m(self) -> float:
        """Largest difference of a position or distance that both versions have."""
        return max((abs(new - former) for former, new in self._pairs()), default=0.0)

    def _pairs(self) -> Iterator[tuple[float, float]]:
        for _, point in self.points:
            if point.distance is not None and point.new_distance is not None:
                yield point.distance.distance_m, point.new_distance.distance_m
        for old, now in zip(self.recorded, self.now):
            for former, new in zip(old.distances, now.distances):
                if former.distance_m is not None and new.distance_m is not None:
                    yield former.distance_m, new.distance_m


def is_same(former: MeasuredDistance, new: MeasuredDistance) -> bool:
    """Return True if a table would show equal texts."""
    if former.status is not new.status:
        return False
    pairs = ((former.distance_m, new.distance_m), (former.low_m, new.low_m), (former.high_m, new.high_m))
    return all((a is None) == (b is None) and (a is None or b is None or abs(a - b) <= SAME_M) for a, b in pairs)


def replay(scenario: AnyScenario, parameters: ScenarioParameters, progress: Progress, folder: pathlib.Path,
           profile: CarProfile, *, log: pathlib.Path | None = None) -> ReplayedTest:
    """Replay a test with its recording in a folder; log: of its only run, instead of the recorded one.

    CannotReplay if the recording is insufficient, another OperatorError for a damaged file.
    """
    runs = recorded_runs(folder)
    if not runs or progress.car is None:
        raise CannotReplay(f"There is no recording of the test in {folder}; tests of this version and later have one.")
    if log is not None and len(runs) != 1:
        raise CannotReplay(f"The test was measured in {len(runs)} runs, each with a log of its own; another log cannot "
                           "take their place.")
    lines = scenario.lines(parameters, progress.car)
    rays: dict[int, Ray] = {} if scenario.name in _WITHOUT_RAYS else {line.number: line.ray for line in lines}
    points = Points(rays, progress.car, replayed_phone(parameters, progress, profile))
    played = played_log(progress.session)
    found = [_follow(points, run, profile, log, played) for run in runs]
    notices = [notice for each, _ in found for notice in each]
    recorded, now = results_anew(scenario, parameters, progress, points.attempts)
    missing = [result.number for result in progress.results if result.number not in
               {attempt.number for attempt in points.attempts}]
    if missing:
        notices.append(f"Of {len(missing)} lines nothing was recorded ({', '.join(map(str, missing))}).")
    return ReplayedTest(recorded, now, counted_attempts(scenario, points.attempts), notices,
                        all(is_whole for _, is_whole in found))


def _follow(points: Points, run: RecordedRun, profile: CarProfile, log: pathlib.Path | None,
            played: str) -> tuple[list[str], bool]:
    """Replay one run; return notices on its log, and True if the log covers the whole run. played: see played_log."""
    path = log or run.log
    if path is None and played:
        raise CannotReplay(f"The test played the CAN log {played}, which is not kept with it; name that log "
                           "(--can-log).")
    if path is None:
        raise CannotReplay(f"No log of the Car's bus belongs to {run.course}; there was no bus, or none was wanted.")
    read = ReadLog(path, profile.identifiers)
    locks = ReplayedLocks(profile, read, points.phone, is_played=bool(played))
    points.follow(read_course(run.course), locks)
    notices = [*((read.notice,) if read.notice else ()), *locks.watch.notices]
    if not (locks.has_marks or played):
        raise CannotReplay(f"The test has kept no log of the Car's bus, so that nothing says when the frames of {path} "
                           "came: its times cannot be brought together with the test's.")
    if not locks.has_state:
        notices.append(f"The CAN log {path} tells no state of message {profile.message.name} (id "
                       f"0x{profile.message.frame_id:X}): it is of another car or bus, or the profile is.")
    elif locks.is_short and not read.ending:
        notices.append(f"The CAN log {path} ends after {locks.frames} frames, before the test does.")
    return notices, locks.has_state and not locks.is_short
