"""Active faults and their ends. No ROS inside."""
# SPDX-License-Identifier: Apache-2.0
from typing import Dict, List, NamedTuple, Optional

from mtr_core.errors import range_problem

from .parts import MAX_AMOUNTS, USUAL_AMOUNTS, FaultError, Kind, Part, kind_of, part_of

MIN_DURATION_S, MAX_DURATION_S = 0.02, 3600.0


class Fault(NamedTuple):
    """Fault of one part. amount: parameter of its kind, s, share or degrees; 0: none. until_s: end of the fault."""

    part: Part
    kind: Kind
    amount: float
    until_s: float

    def __str__(self) -> str:
        return f"{self.part.name} {self.kind.value}"


def fault_of(part: str, kind: str, duration_s: float, amount: float, now_s: float) -> Fault:
    """Return the requested fault, starting now. amount 0: default.

    Raises:
        FaultError: the fault is not possible.
    """
    found = part_of(part)
    wanted = kind_of(found, kind)
    problem = range_problem("The duration", duration_s, MIN_DURATION_S, MAX_DURATION_S, "s")
    if not problem and amount and wanted not in USUAL_AMOUNTS:
        problem = f"The fault {kind} takes no amount; leave it out."
    if not problem and amount:
        problem = range_problem(f"The amount of {kind}", amount, 0.0, MAX_AMOUNTS[wanted])
    if problem:
        raise FaultError(problem)
    return Fault(found, wanted, amount or USUAL_AMOUNTS.get(wanted, 0.0), now_s + duration_s)


class Schedule:
    """Active faults by a clock that is never set; each part has at most one."""

    def __init__(self) -> None:
        self._faults: Dict[str, Fault] = {}

    @property
    def active(self) -> List[Fault]:
        """Active faults, oldest first."""
        return list(self._faults.values())

    def of(self, part: str) -> Optional[Fault]:
        """Return the active fault of a part."""
        return self._faults.get(part)

    def begin(self, fault: Fault) -> None:
        """Activate a fault.

        Raises:
            FaultError: the part has another fault.
        """
        there = self._faults.get(fault.part.name)
        if there is not None:
            raise FaultError(f"The part {there} already; end that first: inject {there.part.name} none.")
        self._faults[fault.part.name] = fault

    def end(self, part: str) -> List[Fault]:
        """End the fault of a part; return it, or an empty list."""
        fault = self._faults.pop(part_of(part).name, None)
        return [] if fault is None else [fault]

    def ended(self, now_s: float) -> List[Fault]:
        """Remove and return the expired faults."""
        over = [fault for fault in self._faults.values() if now_s >= fault.until_s]
        for fault in over:
            del self._faults[fault.part.name]
        return over
