"""Matrix of states and faults: its files, its cells, and the table for docs/fault-matrix.md. No ROS inside.

A row of a file in cells/ names one or more faults (`part kind`) and their duration (`for_s`). `robot` is the kind of
robot; its default is the `robot` of the file, else lock-step. `expect` has the expected behaviour, see Expected.
`in` lists the states with the differences from `expect`. Cells with `short: true` are part of `make test`.
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
# States in the order in which a robot can reach them, with the mode that the Operator is shown.
STATES = {"ready": "ready_to_map_car", MAPPING: "mapping_car", DRIVING: "following_waypoint",
          "waiting": "following_waypoint", "lifting": "following_waypoint"}
OWN_MODE, OR = "own", " or "
FAULT = "fault"
ANY_REASON = "any"
GOES_ON, HELD, LOST = "resumes", "held", "lost"
UNHEARD = "unheard"
# Kinds of robots on which a cell can run; robots.py defines them.
LOCKSTEP, PACED, CAR_BUS, MACHINE_CLOCK = "lockstep", "paced", "car_bus", "machine_clock"
SMALL_DISK, GUARDED, SATELLITES = "small_disk", "guarded", "satellites"
# Units of amounts that are not a time.
AMOUNTS = {"lose": " of all", "sector": " deg", "tilt": " deg"}
BEGIN, END = "<!-- fault matrix: begin -->", "<!-- fault matrix: end -->"
HEAD = ("| fault | while | wheels stop in | lift stops in | reported problem | within | state then | afterwards | "
        "current line |",
        "|---|---|---|---|---|---|---|---|---|")


@dataclass(frozen=True)
class Expected:
    """Expected behaviour in a cell.

    Attributes:
        stands_s: longest time from the fault to standstill of the true robot, s; None: it drives on.
        told: code of the problem reported to the Operator, or alternatives; empty: no new code.
        told_s: longest time until this report, s.
        mode: the robot's state until the fault ends, or alternatives separated by `or`; `unheard` while no Status
            arrives. `own` in a file is the mode of the state.
        then: `resumes` by itself, `held` until the Operator resumes, or `lost`: the robot must be put back; or
            alternatives.
        lift_s: longest time from the fault to standstill of the true lift, s; None: it may move on, or is not moving.
        back_s: longest time from the end of the fault until the robot no longer reports it, s.
        record: words of the reason that invalidates the current line, or alternatives; `any`: any reason; empty: the
            line is valid; None: there is no line.
        limit_s: tolerated duration of a silence or of constant content, s; both times count from its end.
        may_tell: if `told` is empty, codes that may be new nevertheless; `any`: every reason for a stop.
        may_stand: a robot that may drive on may also stop and report why.
        presses: a press is ordered when the fault begins, and must be reported as done.
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
    """One fault in one state. robot: kind of robot, see robots.py."""

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
        """Name of the fault alone, for a person."""
        amount = f" by {self.amount:g}{AMOUNTS.get(self.kind, ' s')}" if self.amount else ""
        return f"{self.part} {self.kind}{amount}"

    @property
    def name(self) -> str:
        """Name of the cell, for a person."""
        return f"{self.fault} while {self.state}"


@dataclass(frozen=True)
class Matrix:
    """All cells."""

    cells: Tuple[Cell, ...]

    def of(self, state: str, only_short: bool = False) -> List[Cell]:
        """Return the cells of a state; those after which the robot is lost are last."""
        cells = [cell for cell in self.cells if cell.state == state and (cell.is_short or not only_short)]
        return sorted(cells, key=lambda cell: cell.expected.then == LOST)

    def courses(self, only_short: bool = False, only: str = "") -> List[List[Cell]]:
        """Return the cells in the order in which they are run, one list per kind of robot. only: pattern of their
        names."""
        cells = [cell for state in STATES for cell in self.of(state, only_short) if re.search(only, cell.name)]
        robots = dict.fromkeys(cell.robot for cell in cells)
        return [[cell for cell in cells if cell.robot == robot] for robot in robots]


def left_out(folder: pathlib.Path = FOLDER) -> Dict[str, str]:
    """Return the faults of the catalogue that no cell has, by part or by part and kind, with the reason."""
    return dict(yaml.safe_load((folder / "left_out.yaml").read_text(encoding="utf-8")))


def read_matrix(folder: pathlib.Path = FOLDER) -> Matrix:
    """Return the matrix in a folder.

    Raises:
        KeyError, TypeError: a cell is incomplete.
    """
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
    """Return the default amount of a fault; a slow process has none."""
    is_process = PARTS[part].place in (Place.NODE, Place.MACHINE)
    return 0.0 if is_process else USUAL_AMOUNTS.get(Kind(kind), 0.0)


def table(matrix: Matrix) -> List[str]:
    """Return the rows for docs/fault-matrix.md."""
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
