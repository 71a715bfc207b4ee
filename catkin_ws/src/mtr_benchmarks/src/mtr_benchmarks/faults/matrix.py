"""The matrix of states and faults: its files, its cells, and the table for docs/faults.md. No ROS inside.

A row of a file in cells/ names one or more faults (`part kind`), how long they last (`for_s`), the robot on which they
are tried (`robot`, else that of the file, else lock-step), what must be seen (`expect`, see Expected) and in which
states (`in`), with what differs there. `short: true` is part of `make test`.
"""
# SPDX-License-Identifier: Apache-2.0
import pathlib
import re
from dataclasses import dataclass
from typing import Any, Dict, Iterator, List, Optional, Tuple

import yaml

from mtr_fault_injection.parts import PARTS, USUAL_AMOUNTS, Kind, Place

FOLDER = pathlib.Path(__file__).with_name("cells")
FILES = ("sensors", "hardware", "nodes", "link", "guards", "computer")
MAPPING, DRIVING = "mapping", "driving"
# In the order in which a robot can come into them, with the mode that the Operator reads in each.
STATES = {"ready": "ready_to_map_car", MAPPING: "mapping_car", DRIVING: "following_waypoint",
          "waiting": "following_waypoint", "lifting": "following_waypoint"}
OWN_MODE, OR = "own", " or "
FAULT = "fault"
ANY_REASON = "any"
GOES_ON, HELD, LOST = "goes on", "held", "lost"
UNHEARD = "unheard"
# Robots that a cell may be run on; robots.py says what they are.
LOCKSTEP, PACED, CAR_BUS, MACHINE_CLOCK = "lockstep", "paced", "car_bus", "machine_clock"
SMALL_DISK, GUARDED, SATELLITES = "small_disk", "guarded", "satellites"
# What an amount is of a kind whose amount is no time.
AMOUNTS = {"lose": " of all", "sector": " deg", "tilt": " deg"}
BEGIN, END = "<!-- fault matrix: begin -->", "<!-- fault matrix: end -->"
HEAD = ("| fault | while | wheels stand in | lift stands in | the Operator reads | within | state then | afterwards | "
        "a line at hand |",
        "|---|---|---|---|---|---|---|---|---|")


@dataclass(frozen=True)
class Expected:
    """What a cell must do.

    Attributes:
        stands_s: longest time from the fault to standstill of the true robot, s; None: it drives on.
        told: code of the problem that the Operator reads, of several one; empty: no code that is new.
        told_s: longest time until then, s.
        mode: the robot's state from then on, until the fault ends; `unheard` while no Status comes. In a file `own` is
            that of the state. Of several, with `or` between them, one.
        then: `goes on` by itself, `held` until the Operator has it go on, or `lost`: it needs to be put back; of
            several one.
        lift_s: longest time from the fault to standstill of the true lift, s; None: it may move on, or does not move.
        back_s: longest time from the end of the fault until it is no fault of the robot any more, s.
        record: what makes a line at hand invalid, words of the reason, of several one; `any`: whatever comes first;
            empty: the line counts; None: there is no line.
        limit_s: how long the fault can last before it is one, s: so long a silence, or the same content; both times
            count from there.
        may_tell: where nothing is told, codes that may be new nevertheless; `any`: whatever the robot stands for.
        may_stand: where it drives on, it may as well stand and say why.
        presses: a press is ordered when the fault begins, and reported as done.
    """

    stands_s: Optional[float]
    told: str
    told_s: float
    mode: str
    then: str
    record: Optional[str] = None
    limit_s: float = 0.0
    lift_s: Optional[float] = None
    back_s: float = 3.0
    may_tell: str = ""
    may_stand: bool = False
    presses: bool = False


@dataclass(frozen=True)
class Cell:
    """One fault in one state. robot: on which robot it is run, see robots.py."""

    state: str
    part: str
    kind: str
    for_s: float
    amount: float
    is_short: bool
    expected: Expected
    robot: str = LOCKSTEP

    @property
    def fault(self) -> str:
        """The fault alone, for a person."""
        amount = f" by {self.amount:g}{AMOUNTS.get(self.kind, ' s')}" if self.amount else ""
        return f"{self.part} {self.kind}{amount}"

    @property
    def name(self) -> str:
        """For a person."""
        return f"{self.fault} while {self.state}"


@dataclass(frozen=True)
class Matrix:
    """All of it."""

    cells: Tuple[Cell, ...]

    def of(self, state: str, only_short: bool = False) -> List[Cell]:
        """Cells of a state; those from which the robot does not come back are last."""
        cells = [cell for cell in self.cells if cell.state == state and (cell.is_short or not only_short)]
        return sorted(cells, key=lambda cell: cell.expected.then == LOST)

    def courses(self, only_short: bool = False, only: str = "") -> List[List[Cell]]:
        """Cells in the order in which they are run, a list for each kind of robot. only: pattern of their names."""
        cells = [cell for state in STATES for cell in self.of(state, only_short) if re.search(only, cell.name)]
        robots = dict.fromkeys(cell.robot for cell in cells)
        return [[cell for cell in cells if cell.robot == robot] for robot in robots]


def left_out(folder: pathlib.Path = FOLDER) -> Dict[str, str]:
    """Faults of the catalogue that are in no cell, by part or by part and kind, with the reason."""
    return dict(yaml.safe_load((folder / "left_out.yaml").read_text(encoding="utf-8")))


def read_matrix(folder: pathlib.Path = FOLDER) -> Matrix:
    """The matrix in a folder; KeyError or TypeError where it does not say all that a cell needs."""
    cells: List[Cell] = []
    for name in FILES:
        document = yaml.safe_load((folder / f"{name}.yaml").read_text(encoding="utf-8"))
        for row in document["faults"]:
            cells += _cells(row, row.get("robot", document.get("robot", LOCKSTEP)))
    return Matrix(tuple(cells))


def _cells(row: Dict[str, Any], robot: str) -> Iterator[Cell]:
    for fault in row["faults"]:
        part, kind = fault.split()
        for state, own in row["in"].items():
            expected = {**row["expect"], **own}
            is_short = expected.pop("short", False)
            modes = expected["mode"].split(OR)
            expected["mode"] = OR.join(STATES[state] if mode == OWN_MODE else mode for mode in modes)
            yield Cell(state, part, kind, float(row["for_s"]), row.get("amount", _usual_amount(part, kind)), is_short,
                       Expected(**expected), robot)


def _usual_amount(part: str, kind: str) -> float:
    """What a fault takes that does not say how much; a slow process takes nothing."""
    is_process = PARTS[part].place in (Place.NODE, Place.MACHINE)
    return 0.0 if is_process else USUAL_AMOUNTS.get(Kind(kind), 0.0)


def table(matrix: Matrix) -> List[str]:
    """Rows for docs/faults.md."""
    return [*HEAD, *(_row(cell) for cell in matrix.cells)]


def _row(cell: Cell) -> str:
    must = cell.expected
    limit = f"{must.limit_s:g} + " if must.limit_s else ""
    stands = ("may" if must.may_stand else "-") if must.stands_s is None else f"{limit}{must.stands_s:g} s"
    lift = "-" if must.lift_s is None else f"{limit}{must.lift_s:g} s"
    quiet = "any" if must.may_tell == ANY_REASON else f"at most {_codes(must.may_tell)}" if must.may_tell else "-"
    told = (_codes(must.told), f"{limit}{must.told_s:g} s") if must.told else (quiet, "-")
    reason = "" if must.record == ANY_REASON else f": {must.record}"
    record = "-" if must.record is None else f"invalid{reason}" if must.record else "counts"
    press = ", and a press" if must.presses else ""
    return (f"| {cell.fault}, {cell.for_s:g} s{press} | {cell.state} | {stands} | {lift} | {told[0]} | {told[1]} | "
            f"{must.mode} | {must.then} | {record} |")


def _codes(words: str) -> str:
    return OR.join(f"`{code}`" for code in words.split(OR))
