"""The matrix of states and faults: its file, its cells, and the table for docs/faults.md. No ROS inside."""
# SPDX-License-Identifier: Apache-2.0
import pathlib
import re
from dataclasses import dataclass
from typing import Any, Dict, Iterator, List, Mapping, Optional, Tuple

import yaml

FILE = pathlib.Path(__file__).with_name("matrix.yaml")
ANY_REASON = "any"
GOES_ON, HELD, LOST = "goes on", "held", "lost"
UNHEARD = "unheard"
# Robots that a cell may be run on; robots.py says what they are.
LOCKSTEP, PACED, CAR_BUS, MACHINE_CLOCK, SMALL_DISK = "lockstep", "paced", "car_bus", "machine_clock", "small_disk"
# What an amount is of a kind whose amount is no time.
AMOUNTS = {"lose": " of all"}
BEGIN, END = "<!-- fault matrix: begin -->", "<!-- fault matrix: end -->"
HEAD = ("| fault | while | wheels stand in | lift stands in | the Operator reads | within | state then | afterwards | "
        "a line at hand |",
        "|---|---|---|---|---|---|---|---|---|")


@dataclass(frozen=True)
class Expected:
    """What a cell must do.

    Attributes:
        stands_s: longest time from the fault to standstill of the true robot, s; None: it may drive on.
        told: code of the problem that the Operator reads; empty: none.
        told_s: longest time until then, s.
        mode: the robot's state from then on, while the fault lasts; `unheard` while no Status comes.
        then: `goes on` by itself, `held` until the Operator has it go on, or `lost`: it needs to be put back.
        lift_s: longest time from the fault to standstill of the true lift, s; None: it may move on, or does not move.
        back_s: longest time from the end of the fault until it is no fault of the robot any more, s.
        record: what makes a line at hand invalid, words of the reason; `any`: whatever of several comes first;
            empty: the line counts; None: there is no line.
        limit_s: how long the fault can last before it is one, s: so long a silence, or the same content; both times
            count from there.
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
    """states: words for a person, in the order in which the robot goes through them."""

    states: Mapping[str, str]
    cells: Tuple[Cell, ...]

    def of(self, state: str, only_short: bool = False) -> List[Cell]:
        """Cells of a state; those from which the robot does not come back are last."""
        cells = [cell for cell in self.cells if cell.state == state and (cell.is_short or not only_short)]
        return sorted(cells, key=lambda cell: cell.expected.then == LOST)

    def courses(self, only_short: bool = False, only: str = "") -> List[List[Cell]]:
        """Cells in the order in which they are run, a list for each kind of robot. only: pattern of their names."""
        cells = [cell for state in self.states for cell in self.of(state, only_short) if re.search(only, cell.name)]
        robots = dict.fromkeys(cell.robot for cell in cells)
        return [[cell for cell in cells if cell.robot == robot] for robot in robots]


def read_matrix(path: pathlib.Path = FILE) -> Matrix:
    """The matrix in a file; KeyError or TypeError where it does not say all that a cell needs."""
    document = yaml.safe_load(path.read_text(encoding="utf-8"))
    return Matrix(document["states"], tuple(cell for row in document["faults"] for cell in _cells(row)))


def _cells(row: Dict[str, Any]) -> Iterator[Cell]:
    part, kind = row["fault"].split()
    for state, own in row["in"].items():
        expected = {**row["expect"], **own}
        is_short = expected.pop("short", False)
        amount = float(row.get("amount", 0.0))
        yield Cell(state, part, kind, float(row["for_s"]), amount, is_short, Expected(**expected),
                   row.get("robot", LOCKSTEP))


def table(matrix: Matrix) -> List[str]:
    """Rows for docs/faults.md."""
    return [*HEAD, *(_row(cell) for cell in matrix.cells)]


def _row(cell: Cell) -> str:
    must = cell.expected
    limit = f"{must.limit_s:g} + " if must.limit_s else ""
    stands = "-" if must.stands_s is None else f"{limit}{must.stands_s:g} s"
    lift = "-" if must.lift_s is None else f"{limit}{must.lift_s:g} s"
    told = (f"`{must.told}`", f"{limit}{must.told_s:g} s") if must.told else ("-", "-")
    reason = "" if must.record == ANY_REASON else f": {must.record}"
    record = "-" if must.record is None else f"invalid{reason}" if must.record else "counts"
    return (f"| {cell.fault}, {cell.for_s:g} s | {cell.state} | {stands} | {lift} | {told[0]} | {told[1]} | "
            f"{must.mode} | {must.then} | {record} |")
