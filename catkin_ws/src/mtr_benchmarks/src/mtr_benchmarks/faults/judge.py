"""Evaluates what a robot did during a fault against its cell of the matrix. No ROS inside."""
# SPDX-License-Identifier: Apache-2.0
import itertools
from dataclasses import dataclass
from typing import Any, Dict, Iterator, List, NamedTuple, Optional, Sequence, Set, Tuple

from mtr_operator.domain.actions.line_watch import INTERVENTIONS
from mtr_operator.domain.actions.trouble import LINK_GAP_S, trouble_between
from mtr_operator.domain.ports import LockState
from mtr_operator.domain.robot_status import RobotStatus

from .matrix import ANY_REASON, DRIVING, FAULT, HELD, MAPPING, OR, STATES, UNHEARD, Cell, Expected

STANDS_MPS = 0.02
# Standstill threshold of the lift: its height is published every 40 ms with a resolution of 0.1 mm.
LIFT_STANDS_MPS = 0.01
# A robot that drives on may be stopped for less than this while it turns or waits for its next path, s.
MIN_STOP_S = 0.5
# A Status sent this shortly before a fault of the link ends arrives after its end, s.
UNDER_WAY_S = 0.05


class CarSeen(NamedTuple):
    """State of the Car as far as the application needs it for a line."""

    problem: str
    lock_state: LockState


# State of the Car in cells that do not evaluate it.
WELL = CarSeen("", LockState.LOCKED)


class Seen(NamedTuple):
    """One Status, the robot's steady clock when it was sent, and the Car when it arrived."""

    time_s: float
    status: RobotStatus
    car: CarSeen = WELL


@dataclass(frozen=True)
class Outcome:
    """Observations of one cell.

    Attributes:
        speed_mps: true speed when the fault began.
        stood_s: time from the fault to a standstill that lasts until the end of the fault, s; None: no standstill.
        lift_stood_s: the same for the lift.
        end_mps: speed of the robot's fastest point when the fault ended; None: not observed.
        pressed: a press that was ordered during the fault was reported as done.
        told_s: codes that were new to the Operator, with the time from the fault to the Status, s.
        modes: states during the fault in order, the last one at its end; `unheard` during a gap without Statuses.
        then: behaviour after the fault.
        record: reason for which the current line is invalid; empty: the line is valid.
    """

    speed_mps: float
    stood_s: Optional[float]
    told_s: Dict[str, float]
    modes: List[str]
    then: str
    record: str
    lift_stood_s: Optional[float] = None
    end_mps: Optional[float] = None
    pressed: bool = False


def standstill_s(speeds: Sequence[Tuple[float, float]], begin_s: float, end_s: float,
                 stands_mps: float = STANDS_MPS) -> Optional[float]:
    """Return the time from a fault to a standstill until its end, from (time, speed) of the true robot; None: it moved
    at the end."""
    moving = [time_s for time_s, speed in speeds if begin_s <= time_s <= end_s and abs(speed) > stands_mps]
    seen = [time_s for time_s, _ in speeds if begin_s <= time_s <= end_s]
    if not seen or (moving and moving[-1] == seen[-1]):
        return None
    return max(moving[-1] - begin_s, 0.0) if moving else 0.0


def end_speed_mps(speeds: Sequence[Tuple[float, float]], begin_s: float, end_s: float) -> Optional[float]:
    """Return the last observed speed during a fault; None: there was none."""
    return next((abs(mps) for time_s, mps in reversed(speeds) if begin_s <= time_s <= end_s), None)


def has_stood(speeds: Sequence[Tuple[float, float]], for_s: float) -> bool:
    """Return True if the newest speeds show a standstill for the given time."""
    newest = list(itertools.takewhile(lambda each: each[0] >= speeds[-1][0] - for_s, reversed(speeds)))
    return bool(newest) and len(newest) < len(speeds) and all(abs(mps) <= STANDS_MPS for _, mps in newest)


def codes(status: RobotStatus) -> Set[str]:
    """Return the codes of all problems shown to the Operator."""
    return {problem.code for notice in status.notifications for problem in notice.problems}


def told_since(seen: Sequence[Seen], begin_s: float) -> Dict[str, float]:
    """Return the codes that are new since the fault, with the time until the first Status that has them."""
    before: Set[str] = set()
    found: Dict[str, float] = {}
    for each in seen:
        if each.time_s <= begin_s:
            before = codes(each.status)
            continue
        for code in codes(each.status) - before - found.keys():
            found[code] = each.time_s - begin_s
    return found


def modes_during(seen: Sequence[Seen], begin_s: float, end_s: float) -> List[str]:
    """Return the states shown to the Operator during a fault, in order."""
    found: List[str] = []
    before_s = begin_s
    for each in [each for each in seen if begin_s < each.time_s <= end_s]:
        if each.time_s - before_s > LINK_GAP_S and each.time_s > end_s - UNDER_WAY_S:
            break
        found += [UNHEARD] * (each.time_s - before_s > LINK_GAP_S) + [each.status.mode.name.lower()]
        before_s = each.time_s
    found += [UNHEARD] * (end_s - before_s > LINK_GAP_S)
    return [mode for mode, _ in itertools.groupby(found)]


def invalid_because(seen: Sequence[Seen], begin_s: float) -> str:
    """Return the reason for which the application would invalidate the current line; empty: none."""
    before: Optional[Seen] = None
    for each in seen:
        if before is not None and each.time_s > begin_s:
            # The application checks interventions in this order.
            for name, sentence in INTERVENTIONS.items():
                if getattr(each.status.interventions, name) != getattr(before.status.interventions, name):
                    return sentence
            car: Any = each.car
            trouble = trouble_between(before.status, each.status, car)
            if trouble:
                return trouble
        before = each
    return ""


def first_told_s(must: Expected, seen: Outcome) -> Optional[float]:
    """Return the time from the fault to the first of the required codes, s; None: the Operator received none of
    them."""
    return min((seen.told_s[code] for code in must.told.split(OR) if code in seen.told_s), default=None)


def wrong(cell: Cell, seen: Outcome) -> List[str]:
    """Return the differences from the matrix, one sentence each."""
    return [*_wrong_motion(cell, seen), *_wrong_words(cell, seen), *_wrong_states(cell, seen)]


def _wrong_motion(cell: Cell, seen: Outcome) -> Iterator[str]:
    must = cell.expected
    if must.stands_s is not None and (seen.stood_s is None or seen.stood_s > must.limit_s + must.stands_s):
        yield f"stands after {seen.stood_s} s, must {must.limit_s + must.stands_s:g}"
    if must.lift_s is not None and (seen.lift_stood_s is None or seen.lift_stood_s > must.limit_s + must.lift_s):
        yield f"lift stands after {seen.lift_stood_s} s, must {must.limit_s + must.lift_s:g}"
    if must.stands_s is None and not must.may_stand and _has_stopped(cell, seen):
        yield f"stands after {seen.stood_s} s, must drive on"


def _has_stopped(cell: Cell, seen: Outcome) -> bool:
    """Return True if a robot that had to drive on was not moving until the end of the fault."""
    if seen.speed_mps <= STANDS_MPS or (cell.state == MAPPING and STATES[DRIVING] in seen.modes):
        # It was stopped before, or has finished the map of the Car in the meantime.
        return False
    if seen.end_mps is None:
        return True
    return seen.end_mps <= STANDS_MPS and seen.stood_s is not None and cell.for_s - seen.stood_s >= MIN_STOP_S


def _wrong_words(cell: Cell, seen: Outcome) -> Iterator[str]:
    must = cell.expected
    told_s = first_told_s(must, seen)
    if must.told and (told_s is None or told_s > must.limit_s + must.told_s):
        yield f"{must.told} told after {told_s} s, must {must.limit_s + must.told_s:g}"
    unwanted = seen.told_s.keys() - set(must.may_tell.split(OR))
    if not must.told and must.may_tell != ANY_REASON and unwanted:
        yield f"tells {sorted(unwanted)}, must tell {must.may_tell or 'nothing'}"
    stops = seen.then == HELD or FAULT in seen.modes or (must.stands_s is None and _has_stopped(cell, seen))
    if stops and not must.told and not seen.told_s:
        yield "stands, has a fault or is held, and does not say why"
    if must.presses and not seen.pressed:
        yield "the press is not reported as done"
    words = "" if must.record == ANY_REASON else must.record
    if words is not None and (not any(each in seen.record for each in words.split(OR))
                              or bool(must.record) != bool(seen.record)):
        yield f"a line is invalid because {seen.record!r}, must {must.record!r}"


def _wrong_states(cell: Cell, seen: Outcome) -> Iterator[str]:
    must, modes = cell.expected, set(cell.expected.mode.split(OR))
    # The previous state may last for a while; a robot that has mapped the Car follows waypoints.
    before = {STATES[cell.state], STATES[DRIVING]} if cell.state == MAPPING else {STATES[cell.state]}
    at_end = modes | before if modes & before else modes
    if not seen.modes or seen.modes[-1] not in at_end or not set(seen.modes) <= modes | before:
        yield f"is in {seen.modes}, must be {must.mode}"
    if seen.then not in must.then.split(OR):
        yield f"afterwards {seen.then}, must be {must.then}"
