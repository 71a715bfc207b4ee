"""What a robot did during a fault, and whether that is what its cell of the matrix says. No ROS inside."""
# SPDX-License-Identifier: Apache-2.0
from dataclasses import dataclass
from types import SimpleNamespace
from typing import Any, Dict, List, Optional, Sequence, Set, Tuple

from mtr_operator.domain.actions.line_watch import INTERVENTIONS
from mtr_operator.domain.actions.trouble import trouble_between
from mtr_operator.domain.ports import LockState
from mtr_operator.domain.robot_status import RobotStatus

from .matrix import ANY_REASON, Cell

STANDS_MPS = 0.02
# A Car that is well: only what the robot says counts.
CAR: Any = SimpleNamespace(problem="", lock_state=LockState.LOCKED)


@dataclass(frozen=True)
class Outcome:
    """What was seen of one cell.

    Attributes:
        speed_mps: true speed when the fault began.
        stood_s: from the fault to standstill that lasts as long as it, s; None: it did not stand.
        told_s: codes that were new to the Operator, with the time from the fault to the Status, s.
        modes: states while the fault lasted, without the one before.
        then: how it went on.
        record: why a line at hand is invalid; empty: it counts.
    """

    speed_mps: float
    stood_s: Optional[float]
    told_s: Dict[str, float]
    modes: List[str]
    then: str
    record: str


def standstill_s(speeds: Sequence[Tuple[float, float]], begin_s: float, end_s: float) -> Optional[float]:
    """Time from a fault to standstill until its end, by (time, speed) of the true robot; None: it moved at the end."""
    moving = [time_s for time_s, speed in speeds if begin_s <= time_s <= end_s and abs(speed) > STANDS_MPS]
    seen = [time_s for time_s, _ in speeds if begin_s <= time_s <= end_s]
    if not seen or (moving and moving[-1] == seen[-1]):
        return None
    return max(moving[-1] - begin_s, 0.0) if moving else 0.0


def codes(status: RobotStatus) -> Set[str]:
    """Codes of all problems that the Operator reads."""
    return {problem.code for notice in status.notifications for problem in notice.problems}


def told_since(statuses: Sequence[RobotStatus], begin_s: float) -> Dict[str, float]:
    """Codes that were not there before the fault, with the time until the first Status that has them."""
    before: Set[str] = set()
    found: Dict[str, float] = {}
    for status in statuses:
        if status.stamp_s <= begin_s:
            before = codes(status)
            continue
        for code in codes(status) - before - found.keys():
            found[code] = status.stamp_s - begin_s
    return found


def invalid_because(statuses: Sequence[RobotStatus], begin_s: float) -> str:
    """Why the application would not let a line count that is measured now."""
    before: Optional[RobotStatus] = None
    for status in statuses:
        if before is not None and status.stamp_s > begin_s:
            trouble = trouble_between(before, status, CAR)
            if trouble:
                return trouble
            for name, sentence in INTERVENTIONS.items():
                if getattr(status.interventions, name) != getattr(before.interventions, name):
                    return sentence
        before = status
    return ""


def wrong(cell: Cell, seen: Outcome) -> List[str]:
    """What is not as the matrix says, a sentence each."""
    must, found = cell.expected, []
    if must.stands_s is not None and (seen.stood_s is None or seen.stood_s > must.limit_s + must.stands_s):
        found.append(f"stands after {seen.stood_s} s, must {must.limit_s + must.stands_s:g}")
    if must.stands_s is None and seen.stood_s == 0.0 and seen.speed_mps > STANDS_MPS:
        found.append("stands, must drive on")
    if must.told and not seen.told_s.get(must.told, 1e9) <= must.limit_s + must.told_s:
        found.append(f"{must.told} told after {seen.told_s.get(must.told)} s, must {must.limit_s + must.told_s:g}")
    if must.mode not in seen.modes:
        found.append(f"is in {seen.modes}, must be {must.mode}")
    if must.then != seen.then:
        found.append(f"afterwards {seen.then}, must be {must.then}")
    words = "" if must.record == ANY_REASON else must.record
    if words is not None and (words not in seen.record or bool(must.record) != bool(seen.record)):
        found.append(f"a line is invalid because {seen.record!r}, must {must.record!r}")
    return found
