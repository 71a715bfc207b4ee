"""Whether the system is as sure as it is right: normalised errors squared of each drive; and what a scan costs."""
# SPDX-License-Identifier: Apache-2.0
import math
from typing import Any, Dict, List, NamedTuple, Optional

from ...harness.rows import Requirement, Row
from ..drives.selection import PITCHED, PLAIN, RANGE_BIAS, SCENES, TILT
from .figures import mean, ratio
from .position_rows import Failures, Outcomes, failed, judged

# Variants whose errors the system knows of, at least as possible.
KNOWN_OF = (PLAIN, RANGE_BIAS, TILT)
SUREST = Requirement("normalised error squared, drive that is most too sure", "(ratio)", 1.4, 1.8)
MOST_CAUTIOUS = Requirement("normalised error squared, most cautious drive", "(ratio)", 0.7, 0.5, at_least=True)
CPU = Requirement("CPU of a scan of 720 beams", "ms", 0.4, 0.8)


class DriveRatio(NamedTuple):
    """Mean normalised error squared by its expectation of one drive; 1 is honest."""

    name: str
    value: float


def rows(outcomes: Outcomes, failures: Failures) -> List[Row]:
    """Both ends, for one number cannot say how far drives are off on either side."""
    found = ratios(outcomes)
    missing = sum(failed(failures, scene, variant) for scene in SCENES for variant in KNOWN_OF)
    surest = max(found, key=lambda each: each.value, default=None)
    most_cautious = min(found, key=lambda each: each.value, default=None)
    return [_row(SUREST, surest, missing), _row(MOST_CAUTIOUS, most_cautious, missing),
            judged(CPU, mean([each.cpu_ms_per_scan for scene in SCENES
                              for each in outcomes[scene].get(PLAIN, {}).values()]), 0)]


def ratios(outcomes: Outcomes) -> List[DriveRatio]:
    """Of each drive that has a pose at all."""
    drives = [(f"{scene}_{variant}_{seed}", ratio(each.errors.nees)) for scene in SCENES for variant in KNOWN_OF
              for seed, each in outcomes[scene].get(variant, {}).items()]
    return [DriveRatio(name, value) for name, value in drives if value is not None and math.isfinite(value)]


def figures(outcomes: Outcomes) -> Dict[str, Any]:
    """By scene and variant: the mean of all drives, and each drive's."""
    return {scene: {variant: {str(seed): ratio(each.errors.nees) for seed, each in drives.items()}
                    for variant, drives in outcomes[scene].items() if variant in (*KNOWN_OF, PITCHED)}
            for scene in SCENES}


def _row(requirement: Requirement, drive: Optional[DriveRatio], missing: int) -> Row:
    return judged(requirement, drive.value if drive else None, missing, remark=drive.name if drive else "")
