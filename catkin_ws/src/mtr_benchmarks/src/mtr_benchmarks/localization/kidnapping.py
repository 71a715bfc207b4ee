"""What the system says after somebody has lifted the robot and put it down 2 m aside."""
# SPDX-License-Identifier: Apache-2.0
from typing import Any, Dict, List, NamedTuple, Optional, Sequence

import numpy as np

from .errors import Errors
from .pattern import KIDNAP

DETECTION_LIMIT_S = 2.0
# A pose that is valid again has to be this near to the truth.
RECOVERED_M = 0.1


class Kidnapping(NamedTuple):
    """One robot's fate.

    Attributes:
        detected_s: from the lift to the first pose that is not valid; None: never.
        recovered_s: from the lift to the first valid pose after that; None: it stood until the end.
        wrong_share: of the time from DETECTION_LIMIT_S on, in which a wrong pose was called valid.
    """

    detected_s: Optional[float]
    recovered_s: Optional[float]
    wrong_share: float


def kidnapping(errors: Errors, segments: Sequence[Dict[str, Any]]) -> Kidnapping:
    """What happened in the drive of these errors."""
    lifted_s = next(each["begin_s"] for each in segments if each["kind"] == KIDNAP)
    after = errors.stamps_s > lifted_s
    elapsed, unknown = errors.stamps_s[after] - lifted_s, np.isnan(errors.key_m[after])
    wrong = ~unknown & (np.nan_to_num(errors.key_m[after]) > RECOVERED_M)
    detected = float(elapsed[np.argmax(unknown)]) if unknown.any() else None
    again = ~unknown & (elapsed > detected) if detected is not None else np.zeros(0, bool)
    return Kidnapping(detected, float(elapsed[np.argmax(again)]) if again.any() else None,
                      float(np.mean(wrong[elapsed > DETECTION_LIMIT_S])))


def figures(all_of_them: List[Kidnapping]) -> Dict[str, Any]:
    """Over all robots."""
    detected = [each.detected_s for each in all_of_them if each.detected_s is not None]
    recovered = [each.recovered_s for each in all_of_them if each.recovered_s is not None]
    good = [each for each in all_of_them if each.detected_s is not None and each.detected_s <= DETECTION_LIMIT_S
            and each.wrong_share == 0.0]
    return {"robots": len(all_of_them), "detected": len(detected), "slowest_detection_s": max(detected, default=None),
            "recovered": len(recovered), "slowest_recovery_s": max(recovered, default=None),
            "longest_wrong_share": max((each.wrong_share for each in all_of_them), default=None),
            "limit_s": DETECTION_LIMIT_S, "met": len(good) == len(all_of_them) > 0}


def sentence(found: Dict[str, Any]) -> str:
    """The figures for a person."""
    slowest = found["slowest_detection_s"]
    return (f"Kidnapped: {found['detected']} of {found['robots']} noticed"
            f"{'' if slowest is None else f', the slowest after {slowest:.2f} s'}; {found['recovered']} recovered, the "
            f"others stood; wrong poses called valid for {100.0 * found['longest_wrong_share']:.1f} % of the time at "
            f"most: {'met' if found['met'] else 'NOT MET'}")
