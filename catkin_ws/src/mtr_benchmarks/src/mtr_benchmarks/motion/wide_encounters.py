"""Encounters with wide movers, faster walkers, a running child and a lying person."""
# SPDX-License-Identifier: Apache-2.0
import multiprocessing
from dataclasses import dataclass
from typing import Dict, List, Sequence, Tuple

from ..harness.rows import Requirement, Row
from .encounter import Encounter, EncounterEnd, Mover, draw, simulate
from .options import MotionOptions

# Walking speed of ISO 13855, and speed of a running child.
WALKING_MPS, RUNNING_MPS = 1.6, 3.0
# Least initial distance of wide movers from base_link: the footprint and half of a wheelchair.
WIDE_CLEAR_M = 1.3
# All robots have two LiDARs. Without a map, a robot recognizes wide movers only by their motion.
GROUPS: Dict[str, Sequence[Mover]] = {
    "wide": [Mover(figure, 0.5, 1.5, WIDE_CLEAR_M, rear_lidar=1.0, is_localized=True)
             for figure in ("wheelchair", "pram", "pair")],
    "walker": [Mover("person", 1.5, WALKING_MPS, rear_lidar=1.0)],
    "child": [Mover("child", RUNNING_MPS, RUNNING_MPS, rear_lidar=1.0)],
    "lying": [Mover("lying", 0.0, 0.0, rear_lidar=1.0)],
}
# Number of encounters in each group; the three wide figures share their group's number.
COUNTS = {"wide": 300, "walker": 100, "child": 50, "lying": 20}
SEED_STEP, GROUP_STEP = 10_000_000, 1_000_000
WIDE = Requirement("wide movers who come into the way", "(count)", must=300.0, at_least=True)
WIDE_CONTACTS = Requirement("of these touched by the moving robot: wide movers", "(count)", must=0.0)
WALKER_CONTACTS = Requirement("persons at 1.5 to 1.6 m/s touched by the moving robot", "(count)", must=0.0)
CHILD_CONTACTS = Requirement("running children (3 m/s) touched by the moving robot", "(count)")
LYING_CONTACTS = Requirement("lying persons touched by the moving robot", "(count)")
Ended = Tuple[Encounter, EncounterEnd]


@dataclass(frozen=True)
class WideEncounterFigures:
    """Figures of all groups; the names are those in the file.

    A contact counts as moving if any point of the robot was faster than 0.02 m/s just before it.

    Attributes:
        wide_movers: number of encounters with wide movers.
        encounters_by_group: number of all encounters.
        contacts_at_mps: speed of the fastest point at each moving contact.
        contact_seeds: seeds of these encounters.
    """

    wide_movers: int
    wide_contacts_while_moving: int
    walker_contacts_while_moving: int
    child_contacts_while_moving: int
    lying_contacts_while_moving: int
    encounters_by_group: Dict[str, int]
    contacts_at_mps: Dict[str, List[float]]
    contact_seeds: Dict[str, List[int]]

    def rows(self) -> List[Row]:
        """Return the rows: limits first; child and lying person are for information."""
        counted = ((WALKER_CONTACTS, "walker", self.walker_contacts_while_moving),
                   (CHILD_CONTACTS, "child", self.child_contacts_while_moving),
                   (LYING_CONTACTS, "lying", self.lying_contacts_while_moving))
        return [Row(WIDE, self.wide_movers), Row(WIDE_CONTACTS, self.wide_contacts_while_moving),
                *(Row(requirement, contacts, remark=f"in {self.encounters_by_group[name]} encounters")
                  for requirement, name, contacts in counted)]


def measure(options: MotionOptions) -> WideEncounterFigures:
    """Simulate the encounters of all groups."""
    with multiprocessing.Pool(options.jobs) as pool:
        drawn = {name: drawn_of(name, options.seed) for name in GROUPS}
        return figures({name: list(zip(encounters, pool.map(simulate, encounters, chunksize=4)))
                        for name, encounters in drawn.items()})


def drawn_of(name: str, seed: int) -> List[Encounter]:
    """Return the encounters of a group; its movers alternate."""
    movers = GROUPS[name]
    first = seed * SEED_STEP + list(GROUPS).index(name) * GROUP_STEP
    return [draw(first + number, movers[number % len(movers)]) for number in range(COUNTS[name])]


def figures(ended: Dict[str, Sequence[Ended]]) -> WideEncounterFigures:
    """Return the figures of these encounters."""
    touched = {name: [(encounter, end) for encounter, end in group if end.moving] for name, group in ended.items()}
    return WideEncounterFigures(
        wide_movers=len(ended["wide"]), wide_contacts_while_moving=len(touched["wide"]),
        walker_contacts_while_moving=len(touched["walker"]), child_contacts_while_moving=len(touched["child"]),
        lying_contacts_while_moving=len(touched["lying"]),
        encounters_by_group={name: len(group) for name, group in ended.items()},
        contacts_at_mps={name: [round(end.speed_mps, 3) for _, end in group] for name, group in touched.items()},
        contact_seeds={name: [encounter.seed for encounter, _ in group] for name, group in touched.items()})
