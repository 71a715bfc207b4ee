"""Persons who walk up to the robot, and drives with nobody about: touches while it moves, and false stops."""
# SPDX-License-Identifier: Apache-2.0
import multiprocessing
from typing import Any, Dict, List, Tuple

from . import beside_car
from .encounter import Encounter, draw, simulate

# Watched ones; others are drawn as they come and counted apart.
WATCHED_ENCOUNTERS, AT_ONCE = 1000, 200


def run(options: Any) -> Dict[str, object]:
    """Figures of all encounters and drives; options: seed and jobs.

    A touch counts as while moving when any point of the robot moved by more than 0.02 m/s just before it. Where nobody
    watches (behind a robot without rear LiDAR) persons are not guarded against; these encounters stand apart.
    """
    drives = beside_car.drives(beside_car.SITE.car)
    with multiprocessing.Pool(options.jobs) as pool:
        ends = _simulated(pool, options.seed)
        stops = pool.map(beside_car.simulate, drives, chunksize=2)
    watched = [(encounter, end) for encounter, end in ends if end["watched"]]
    unwatched = [end for _, end in ends if not end["watched"]]
    moving = [encounter for encounter, end in watched if end["moving"]]
    false = [(drive, end) for drive, end in zip(drives, stops) if end["stops"] or end["ends"] < 2]
    return {
        "encounters": len(watched),
        "contacts_while_moving": len(moving),
        "false_stops": sum(max(1, len(end["stops"])) for _, end in false),
        "touched_while_standing": sum(end["touched"] and not end["moving"] for _, end in watched),
        "stopped_for_the_person": sum(end["stopped"] for _, end in watched),
        "touched_at_mps": [round(end["speed_mps"], 3) for _, end in watched if end["moving"]],
        "by_motion_and_approach": _table(watched),
        "unwatched_encounters": len(unwatched),
        "unwatched_contacts_while_moving": sum(end["moving"] for end in unwatched),
        "drives_with_nobody_about": len(drives),
        "slowed_s_median": sorted(end["slowed_s"] for end in stops)[len(stops) // 2],
        "failed_encounters": [encounter.seed for encounter in moving],
        "failed_drives": [f"{drive.name} {drive.seed} rain {drive.rain:g} rear LiDAR {drive.rear_lidar}: {end}"
                          for drive, end in false],
    }


def _simulated(pool: Any, seed: int) -> List[Tuple[Encounter, Dict[str, Any]]]:
    """Encounters and their ends until enough of them were watched."""
    ends: List[Tuple[Encounter, Dict[str, Any]]] = []
    while sum(end["watched"] for _, end in ends) < WATCHED_ENCOUNTERS:
        encounters = [draw(seed * 1_000_000 + len(ends) + number) for number in range(AT_ONCE)]
        ends += zip(encounters, pool.map(simulate, encounters, chunksize=8))
    return ends


def _table(watched: list) -> Dict[str, str]:
    """Touches while moving of all encounters, by motion and approach."""
    table: Dict[str, list] = {}
    for encounter, end in watched:
        table.setdefault(f"{encounter.motion}, {encounter.approach}", []).append(end["moving"])
    return {kind: f"{sum(moving)} of {len(moving)}" for kind, moving in sorted(table.items())}
