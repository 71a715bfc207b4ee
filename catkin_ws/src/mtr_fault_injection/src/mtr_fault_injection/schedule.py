"""Which faults are there now, and until when. No ROS inside."""
# SPDX-License-Identifier: Apache-2.0
from typing import Dict, List, NamedTuple, Optional

from mtr_core.errors import range_problem

from .parts import MAX_AMOUNTS, USUAL_AMOUNTS, FaultError, Kind, Part, kind_of, part_of

MIN_DURATION_S, MAX_DURATION_S = 0.02, 3600.0


class Fault(NamedTuple):
    """One fault of one part. amount: what its kind takes, s or a share, 0 for nothing. until_s: when it is over."""

    part: Part
    kind: Kind
    amount: float
    until_s: float

    def __str__(self) -> str:
        return f"{self.part.name} {self.kind.value}"


def fault_of(part: str, kind: str, duration_s: float, amount: float, now_s: float) -> Fault:
    """The fault that somebody asks for by its names, from now on; amount 0: the usual. FaultError: it cannot be."""
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
    """Faults at a time of a clock that nobody sets; each part has one at most."""

    def __init__(self) -> None:
        self._faults: Dict[str, Fault] = {}

    @property
    def active(self) -> List[Fault]:
        """What is there, oldest first."""
        return list(self._faults.values())

    def of(self, part: str) -> Optional[Fault]:
        """The fault of a part."""
        return self._faults.get(part)

    def begin(self, fault: Fault) -> None:
        """Let a part have a fault, or FaultError while it has another."""
        there = self._faults.get(fault.part.name)
        if there is not None:
            raise FaultError(f"The part {there} already; end that first: inject {there.part.name} none.")
        self._faults[fault.part.name] = fault

    def end(self, part: str) -> List[Fault]:
        """End what a part has; nothing when it has nothing."""
        fault = self._faults.pop(part_of(part).name, None)
        return [] if fault is None else [fault]

    def ended(self, now_s: float) -> List[Fault]:
        """Faults whose time is over by now; they are there no more."""
        over = [fault for fault in self._faults.values() if now_s >= fault.until_s]
        for fault in over:
            del self._faults[fault.part.name]
        return over
