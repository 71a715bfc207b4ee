"""Evaluates poses of a robot that a person carried elsewhere while it drove, and that drove on."""
# SPDX-License-Identifier: Apache-2.0
import math
from dataclasses import dataclass
from typing import Any, Dict, List, Optional, Sequence

import numpy as np

from mtr_core.arrays import BoolArray

from ...harness.rows import Requirement, Row
from ..drives.pattern import ABDUCT
from ..methods.errors import SILENT_S, percentile
from ..methods.key_track import KeyTrack
from .kidnapping import DETECTION_LIMIT_S, RECOVERED_M

# A pose is wrong if its error exceeds both RECOVERED_M and this number of its own sigmas.
WRONG_SIGMAS = 4.0
SETTLED_S = 10.0
# Least time of right poses after which a robot counts as found, because a wrong pose may cross the right one while
# driving.
FOUND_S = 1.0
RIGHT, LOST, UNSURE, WRONG_STATE = "right", "lost", "unsure", "wrong"
WRONG = Requirement("kidnapped while driving: robots that were wrong and valid 2 s after it", "(count)", must=0.0)
SETTLED = Requirement("kidnapped while driving: right again or lost within 10 s", "(share)", must=0.9, at_least=True)
NOTICED = Requirement("kidnapped while driving: noticed within 2 s", "(share)", at_least=True)
VAGUE = Requirement("kidnapped while driving: valid and more than 0.1 m off after 10 s, whatever its sigma", "(count)")
FOUND = Requirement("kidnapped while driving: found themselves again within 25 s", "(share)", at_least=True)
FOUND_TIME = Requirement("kidnapped while driving: until they found themselves again, in the middle", "s")


@dataclass(frozen=True)
class WrongPose:
    """Wrong pose that was reported as valid; the names are those in the file. at_s: time since the robot was carried
    away."""

    at_s: float
    error_m: float
    sigma_m: float
    mode: int


@dataclass(frozen=True)
class Fate:
    """Result of one robot; the names are those in the file, and times count from when it was carried away.

    Attributes:
        knew_before: its last pose before was valid and right.
        noticed_s: time of the first invalid pose; None: never.
        found_s: time from which it was right for a second; None: never.
        after_10_s: right, lost (not valid), wrong, or unsure: valid and within its sigmas but not right, or silent.
        wrong_s: total time of wrong valid poses from 2 s on.
        first_wrong, worst_wrong: first and worst of these poses; None: there were none.
    """

    jump_m: float
    turn_deg: float
    knew_before: bool
    noticed_s: Optional[float]
    found_s: Optional[float]
    after_10_s: str
    wrong_s: float
    first_wrong: Optional[WrongPose]
    worst_wrong: Optional[WrongPose]


@dataclass(frozen=True)
class AbductionFigures:
    """Figures over all robots; the names are those in the file.

    Attributes:
        knew_before: robots that were right and valid before; a robot that was already lost proves nothing.
        noticed: robots with an invalid pose within 2 s.
        vague_at_10_s: robots that were valid and off by more than RECOVERED_M, whatever their sigma, or silent.
        repeated: drives that touched something or gave no map, and were repeated with another seed.
    """

    robots: int
    knew_before: int
    wrong: int
    settled: int
    noticed: int
    slowest_notice_s: Optional[float]
    found: int
    found_median_s: Optional[float]
    found_p90_s: Optional[float]
    lost_at_10_s: int
    right_at_10_s: int
    vague_at_10_s: int
    repeated: int


def fate(track: KeyTrack, segments: Sequence[Dict[str, Any]]) -> Fate:
    """Return the result of the drive of this track."""
    carried = next(each for each in segments if each["kind"] == ABDUCT)
    after = track.stamps_s > carried["begin_s"]
    elapsed = track.stamps_s - carried["begin_s"]
    right = track.valid & (track.error_m <= RECOVERED_M)
    wrong = track.valid & (track.error_m > np.maximum(RECOVERED_M, WRONG_SIGMAS * track.sigma_m))
    late = np.flatnonzero(wrong & (elapsed > DETECTION_LIMIT_S))
    unknown = np.flatnonzero(after & ~track.valid)
    then = int(np.argmin(np.abs(elapsed - SETTLED_S)))
    state = LOST if not track.valid[then] else RIGHT if right[then] else WRONG_STATE if wrong[then] else UNSURE
    if abs(elapsed[then] - SETTLED_S) > SILENT_S:
        state = UNSURE
    return Fate(
        carried["distance_m"], math.degrees(carried["turn_rad"]), bool(right[~after][-1:].any()),
        float(elapsed[unknown[0]]) if len(unknown) else None, _found(track, right & after, carried["begin_s"]), state,
        len(late) * float(np.median(np.diff(track.stamps_s))),
        _pose(track, int(late[0]), elapsed[late[0]]) if len(late) else None,
        _worst(track, late, elapsed))


def figures(fates: Sequence[Fate], repeated: int = 0) -> AbductionFigures:
    """Return the figures over all robots."""
    noticed = [each.noticed_s for each in fates if each.noticed_s is not None]
    found = np.array([each.found_s for each in fates if each.found_s is not None])
    lost, right = (sum(each.after_10_s == state for each in fates) for state in (LOST, RIGHT))
    return AbductionFigures(
        len(fates), sum(each.knew_before for each in fates), sum(each.first_wrong is not None for each in fates),
        lost + right,
        sum(each <= DETECTION_LIMIT_S for each in noticed), max(noticed, default=None), len(found),
        percentile(found, 50.0), percentile(found, 90.0), lost, right,
        sum(each.after_10_s in (UNSURE, WRONG_STATE) for each in fates), repeated)


def rows(found: AbductionFigures, failed_drives: int = 0) -> List[Row]:
    """Return the rows. No row is met if a drive failed, if a robot was lost before, or without robots."""
    lost_before = found.robots - found.knew_before
    details: Dict[str, Optional[float]] = {"failed_drives": failed_drives, "repeated_drives": found.repeated,
                                           "lost_before": lost_before}
    is_complete = found.robots > 0 and not failed_drives and not lost_before
    told = f"{found.robots} robots" + (f", {failed_drives} drives failed" if failed_drives else "") + (
        f", {found.repeated} drives repeated" if found.repeated else "") + (
        f", lost before: {lost_before}" if lost_before else "")
    states = f"{found.right_at_10_s} right, {found.lost_at_10_s} lost"
    return [Row(WRONG, found.wrong if found.robots else None, is_complete, details, told),
            Row(SETTLED, _share(found.settled, found.robots), is_complete, details, states),
            Row(VAGUE, found.vague_at_10_s if found.robots else None, is_complete, details),
            Row(NOTICED, _share(found.noticed, found.robots), is_complete, details),
            Row(FOUND, _share(found.found, found.robots), is_complete, details),
            Row(FOUND_TIME, found.found_median_s, is_complete, details,
                f"90 % within {found.found_p90_s:.1f} s" if found.found_p90_s is not None else "")]


def sentence(found: Fate) -> str:
    """Describe a robot with wrong valid poses for a person."""
    first, worst = found.first_wrong, found.worst_wrong
    if not first or not worst:
        return "It was never wrong and valid."
    return (f"Carried {found.jump_m:.2f} m and turned by {found.turn_deg:.0f} deg; wrong and valid for "
            f"{found.wrong_s:.2f} s, first {first.at_s:.2f} s after it by {first.error_m:.2f} m with a sigma of "
            f"{first.sigma_m:.3f} m in mode {first.mode}, at worst {worst.at_s:.2f} s after it by "
            f"{worst.error_m:.2f} m with {worst.sigma_m:.3f} m in mode {worst.mode}.")


def _share(count: int, robots: int) -> Optional[float]:
    return count / robots if robots else None


def _pose(track: KeyTrack, row: int, at_s: float) -> WrongPose:
    return WrongPose(float(at_s), float(track.error_m[row]), float(track.sigma_m[row]), int(track.mode[row]))


def _worst(track: KeyTrack, late: Any, elapsed: Any) -> Optional[WrongPose]:
    if not len(late):
        return None
    row = int(late[np.argmax(track.error_m[late])])
    return _pose(track, row, elapsed[row])


def _found(track: KeyTrack, right: BoolArray, begin_s: float) -> Optional[float]:
    """Return the time from which the robot was right for FOUND_S, since it was carried away; None: never."""
    since: Optional[float] = None
    for stamp_s, is_right in zip(track.stamps_s, right):
        since = (stamp_s if since is None else since) if is_right else None
        if since is not None and stamp_s - since >= FOUND_S:
            return float(since - begin_s)
    return None
