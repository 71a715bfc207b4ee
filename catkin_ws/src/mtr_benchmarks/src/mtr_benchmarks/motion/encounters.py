"""Encounters with persons who approach the robot, and drives without persons: contacts while moving, and false
stops."""
# SPDX-License-Identifier: Apache-2.0
import multiprocessing
from dataclasses import dataclass
from multiprocessing.pool import Pool
from typing import Dict, List, Sequence, Tuple

from ..harness.rows import Requirement, Row
from . import beside_car
from .beside_car import DriveEnd, StraightDrive
from .encounter import Encounter, EncounterEnd, draw, simulate
from .options import MotionOptions

# Number of watched encounters; unwatched ones are counted separately.
WATCHED_ENCOUNTERS, AT_ONCE = 1000, 200
ENCOUNTERS = Requirement("persons who step into the way", "(count)", must=1000.0, at_least=True)
CONTACTS = Requirement("of these touched by the moving robot", "(count)", must=0.0)
FALSE_STOPS = Requirement("false stops with nobody about", "(count)", must=0.0)
Ended = Tuple[Encounter, EncounterEnd]


@dataclass(frozen=True)
class EncounterFigures:
    """Figures of all encounters and drives; the names are those in the file.

    A contact counts as moving if any point of the robot was faster than 0.02 m/s just before it. Persons behind a robot
    without a rear LiDAR are not guarded against; these encounters are counted separately.
    """

    encounters: int
    contacts_while_moving: int
    false_stops: int
    touched_while_standing: int
    stopped_for_the_person: int
    touched_at_mps: List[float]
    by_motion_and_approach: Dict[str, str]
    unwatched_encounters: int
    unwatched_contacts_while_moving: int
    drives_with_nobody_about: int
    slowed_s_median: float
    failed_encounters: List[int]
    failed_drives: List[str]

    def rows(self) -> List[Row]:
        """Return the rows of encounters, contacts and false stops."""
        return [Row(ENCOUNTERS, self.encounters), Row(CONTACTS, self.contacts_while_moving),
                Row(FALSE_STOPS, self.false_stops, remark=f"in {self.drives_with_nobody_about} drives")]


def measure(options: MotionOptions) -> EncounterFigures:
    """Simulate encounters until enough persons were watched, and all drives without persons."""
    drives = beside_car.drives(beside_car.SITE.car)
    with multiprocessing.Pool(options.jobs) as pool:
        ended = _simulated(pool, options.seed)
        stops = pool.map(beside_car.simulate, drives, chunksize=2)
    return figures(ended, list(zip(drives, stops)))


def figures(ended: Sequence[Ended], drives: Sequence[Tuple[StraightDrive, DriveEnd]]) -> EncounterFigures:
    """Return the figures of these encounters and drives."""
    watched = [(encounter, end) for encounter, end in ended if end.watched]
    unwatched = [end for _, end in ended if not end.watched]
    moving = [(encounter, end) for encounter, end in watched if end.moving]
    false = [(drive, end) for drive, end in drives if end.stops or end.ends < 2]
    return EncounterFigures(
        encounters=len(watched), contacts_while_moving=len(moving),
        false_stops=sum(max(1, len(end.stops)) for _, end in false),
        touched_while_standing=sum(end.touched and not end.moving for _, end in watched),
        stopped_for_the_person=sum(end.stopped for _, end in watched),
        touched_at_mps=[round(end.speed_mps, 3) for _, end in moving],
        by_motion_and_approach=_by_kind(watched), unwatched_encounters=len(unwatched),
        unwatched_contacts_while_moving=sum(end.moving for end in unwatched), drives_with_nobody_about=len(drives),
        slowed_s_median=sorted(end.slowed_s for _, end in drives)[len(drives) // 2],
        failed_encounters=[encounter.seed for encounter, _ in moving],
        failed_drives=[f"{drive.name} {drive.seed} rain {drive.rain:g} rear LiDAR {drive.rear_lidar}: {end._asdict()}"
                       for drive, end in false])


def _simulated(pool: Pool, seed: int) -> List[Ended]:
    """Simulate encounters until enough of them were watched; return them with their results."""
    ended: List[Ended] = []
    while sum(end.watched for _, end in ended) < WATCHED_ENCOUNTERS:
        encounters = [draw(seed * 1_000_000 + len(ended) + number) for number in range(AT_ONCE)]
        ended += zip(encounters, pool.map(simulate, encounters, chunksize=8))
    return ended


def _by_kind(watched: Sequence[Ended]) -> Dict[str, str]:
    """Return the number of contacts while moving by motion and approach."""
    kinds: Dict[str, List[bool]] = {}
    for encounter, end in watched:
        kinds.setdefault(f"{encounter.motion}, {encounter.approach}", []).append(end.moving)
    return {kind: f"{sum(moving)} of {len(moving)}" for kind, moving in sorted(kinds.items())}
