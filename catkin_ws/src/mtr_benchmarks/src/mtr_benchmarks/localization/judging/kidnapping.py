"""Evaluates the poses after a person has lifted the robot and put it down 2 m aside."""
# SPDX-License-Identifier: Apache-2.0
from dataclasses import dataclass
from typing import Any, Dict, List, NamedTuple, Optional, Sequence

import numpy as np

from ...harness.rows import Requirement, Row
from ..drives.pattern import KIDNAP
from ..methods.errors import PoseErrors

DETECTION_LIMIT_S = 2.0
# Largest error of a pose that is valid again.
RECOVERED_M = 0.1
DETECTION = Requirement("kidnapped: until it says so, slowest", "s", must=DETECTION_LIMIT_S)
WRONG = Requirement("kidnapped: wrong poses called valid 2 s after it", "(share)", must=0.0)


class Kidnapping(NamedTuple):
    """Result of one robot.

    Attributes:
        knew_before: its last pose before was valid and right; a robot that is already lost notices nothing.
        detected_s: time from the lift to the first invalid pose; None: never.
        recovered_s: time from the lift to the first valid pose after that; None: it was stopped until the end.
        wrong_share: share of the time from DETECTION_LIMIT_S on in which a wrong pose was valid.
    """

    knew_before: bool
    detected_s: Optional[float]
    recovered_s: Optional[float]
    wrong_share: float


@dataclass(frozen=True)
class KidnappingFigures:
    """Figures over all robots."""

    robots: int
    knew_before: int
    detected: int
    slowest_detection_s: Optional[float]
    recovered: int
    slowest_recovery_s: Optional[float]
    longest_wrong_share: Optional[float]
    limit_s: float
    met: bool


def kidnapping(errors: PoseErrors, segments: Sequence[Dict[str, Any]]) -> Kidnapping:
    """Return the result of the drive with these errors."""
    lifted_s = next(each["begin_s"] for each in segments if each["kind"] == KIDNAP)
    after = errors.stamps_s > lifted_s
    elapsed, unknown = errors.stamps_s[after] - lifted_s, np.isnan(errors.key_m[after])
    wrong = ~unknown & (np.nan_to_num(errors.key_m[after]) > RECOVERED_M)
    detected = float(elapsed[np.argmax(unknown)]) if unknown.any() else None
    again = ~unknown & (elapsed > detected) if detected is not None else np.zeros(0, bool)
    before_m = errors.key_m[errors.stamps_s < lifted_s][-1:]
    return Kidnapping(bool(np.any(before_m <= RECOVERED_M)), detected,
                      float(elapsed[np.argmax(again)]) if again.any() else None,
                      float(np.mean(wrong[elapsed > DETECTION_LIMIT_S])))


def figures(all_of_them: List[Kidnapping]) -> KidnappingFigures:
    """Return the figures over all robots."""
    detected = [each.detected_s for each in all_of_them if each.detected_s is not None]
    recovered = [each.recovered_s for each in all_of_them if each.recovered_s is not None]
    good = [each for each in all_of_them if each.knew_before and each.detected_s is not None
            and each.detected_s <= DETECTION_LIMIT_S and each.wrong_share == 0.0]
    return KidnappingFigures(
        len(all_of_them), sum(each.knew_before for each in all_of_them), len(detected),
        max(detected, default=None), len(recovered), max(recovered, default=None),
        max((each.wrong_share for each in all_of_them), default=None), DETECTION_LIMIT_S,
        len(good) == len(all_of_them) > 0)


def rows(found: KidnappingFigures, failed_drives: int = 0) -> List[Row]:
    """Return the rows. Without failed drives, both are met exactly if `met` of the figures is true."""
    remark = f"{found.detected} of {found.robots} noticed, {found.recovered} recovered, the others stood"
    if found.knew_before < found.robots:
        remark += f", lost before: {found.robots - found.knew_before}"
    proves = found.knew_before == found.robots and not failed_drives
    details: Dict[str, Optional[float]] = {"failed_drives": failed_drives}
    return [Row(DETECTION, found.slowest_detection_s, proves and found.detected == found.robots, details, remark),
            Row(WRONG, found.longest_wrong_share, proves, details)]
