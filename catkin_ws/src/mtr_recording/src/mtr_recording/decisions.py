"""Decisions of localization and Car locator in a recording, and their differences in a replay.

Both nodes run on their own clocks, so a replay is not bit-identical. The decisions are equal if states, modes and
revisions have the same order, and the Car has the same position and size.
"""
# SPDX-License-Identifier: Apache-2.0
import math
from dataclasses import dataclass, field
from typing import Iterable, List, Optional, Tuple

from mtr_core.se2 import Pose2
from mtr_core.states import CarState

# The Car's fit has a sigma of some mm; a larger shift has another cause than this noise.
POSITION_LIMIT_M, HEADING_LIMIT_RAD, SIZE_LIMIT_M = 0.01, math.radians(0.3), 0.01


@dataclass(frozen=True)
class CarSeen:
    """One estimate of the Car: state, revision of its frame, pose in map, size in m."""

    state: CarState
    revision: int
    pose: Pose2
    length_m: float
    width_m: float


@dataclass
class Decisions:
    """Decisions in their order, each once while it lasts.

    Attributes:
        cars: (state, revision) of the Car.
        modes: of localization, with its validity.
        located: the first estimate of each revision.
    """

    cars: List[Tuple[CarState, int]] = field(default_factory=list)
    modes: List[Tuple[int, bool]] = field(default_factory=list)
    located: List[CarSeen] = field(default_factory=list)

    def add_car(self, car: CarSeen) -> None:
        """Add an estimate."""
        decided = (car.state, car.revision)
        if self.cars[-1:] != [decided]:
            self.cars.append(decided)
            if car.state == CarState.LOCATED:
                self.located.append(car)

    def add_mode(self, mode: int, valid: bool) -> None:
        """Add the mode of localization's pose."""
        if self.modes[-1:] != [(mode, valid)]:
            self.modes.append((mode, valid))


def differences(recorded: Decisions, replayed: Decisions) -> List[str]:
    """Return a sentence for each difference; empty if all decisions are equal."""
    if not recorded.cars or not recorded.modes:
        return ["The recording holds neither the Car nor localization's modes; record with the profile full."]
    found = [_sequence("the Car's states", [f"{state.name} {revision}" for state, revision in recorded.cars],
                       [f"{state.name} {revision}" for state, revision in replayed.cars]),
             _sequence("localization's modes", list(map(str, recorded.modes)), list(map(str, replayed.modes)))]
    found += [_car(before, after) for before, after in zip(recorded.located, replayed.located)]
    return [sentence for sentence in found if sentence is not None]


def _sequence(what: str, recorded: List[str], replayed: List[str]) -> Optional[str]:
    # A recording may start after the robot, but a replay starts from the initial state.
    if recorded[0] in replayed:
        replayed = replayed[replayed.index(recorded[0]):]
    if recorded == replayed:
        return None
    return f"{what} were {_listed(recorded)} when recorded, and {_listed(replayed)} when replayed."


def _listed(items: Iterable[str]) -> str:
    return ", ".join(items) or "none"


def _car(before: CarSeen, after: CarSeen) -> Optional[str]:
    off_m = before.pose.distance_to(after.pose)
    turned_rad = abs(math.remainder(before.pose.heading - after.pose.heading, 2.0 * math.pi))
    size_m = max(abs(before.length_m - after.length_m), abs(before.width_m - after.width_m))
    if off_m <= POSITION_LIMIT_M and turned_rad <= HEADING_LIMIT_RAD and size_m <= SIZE_LIMIT_M:
        return None
    return (f"the Car of revision {before.revision} is {100.0 * off_m:.1f} cm and {math.degrees(turned_rad):.2f} "
            f"degrees away and differs in size by {100.0 * size_m:.1f} cm; allowed are {100.0 * POSITION_LIMIT_M:.0f} "
            f"cm, {math.degrees(HEADING_LIMIT_RAD):.1f} degrees and {100.0 * SIZE_LIMIT_M:.0f} cm.")
