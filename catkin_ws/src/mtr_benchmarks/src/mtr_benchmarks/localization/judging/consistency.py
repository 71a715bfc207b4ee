"""Compares published uncertainties with errors, by the normalised squared error of each drive; and the cost of a
scan."""
# SPDX-License-Identifier: Apache-2.0
import math
from typing import Any, Dict, List, NamedTuple, Optional

from ...harness.rows import Requirement, Row
from ..drives.selection import PITCHED, PLAIN, RANGE_BIAS, SCENES, TILT
from .figures import mean, ratio
from .honest import Bounds, bounds_of, freedom_of
from .position_rows import Failures, Outcomes, failed, judged

# Variants with errors that the system's covariances account for.
KNOWN_OF = (PLAIN, RANGE_BIAS, TILT)
SUREST = Requirement("normalised error squared, drive that is most too sure", "(ratio)", 1.4, 1.8)
MOST_CAUTIOUS = Requirement("normalised error squared, most cautious drive", "(ratio)", 0.7, 0.5, at_least=True)
CPU = Requirement("CPU of a scan of 720 beams", "ms", 0.4, 0.8)


class DriveRatio(NamedTuple):
    """Mean normalised squared error of one drive divided by its expectation; 1 is consistent."""

    name: str
    value: float


def rows(outcomes: Outcomes, failures: Failures) -> List[Row]:
    """Return rows for both extremes, because drives may be off on either side; a drive without a valid pose has
    failed."""
    found = ratios(outcomes)
    missing = sum(failed(failures, scene, variant) + len(outcomes[scene].get(variant, {})) for scene in SCENES
                  for variant in KNOWN_OF) - len(found)
    surest = max(found, key=lambda each: each.value, default=None)
    most_cautious = min(found, key=lambda each: each.value, default=None)
    honest = honest_bounds(outcomes)
    return [_row(SUREST, surest, missing, honest and honest.high),
            _row(MOST_CAUTIOUS, most_cautious, missing, honest and honest.low),
            judged(CPU, mean([each.cpu_ms_per_scan for scene in SCENES
                              for each in outcomes[scene].get(PLAIN, {}).values()]), 0)]


def ratios(outcomes: Outcomes) -> List[DriveRatio]:
    """Return the ratio of each drive with a pose."""
    drives = [(f"{scene}_{variant}_{seed}", ratio(each.errors.nees)) for scene in SCENES for variant in KNOWN_OF
              for seed, each in outcomes[scene].get(variant, {}).items()]
    return [DriveRatio(name, value) for name, value in drives if value is not None and math.isfinite(value)]


def honest_bounds(outcomes: Outcomes) -> Optional[Bounds]:
    """Return the bounds that contain all of as many consistent drives, with 95 % probability."""
    drives = [each.errors for scene in SCENES for variant in KNOWN_OF
              for each in outcomes[scene].get(variant, {}).values()]
    freedom = freedom_of(drives)
    return None if freedom is None else bounds_of(freedom, len(ratios(outcomes)))


def figures(outcomes: Outcomes) -> Dict[str, Any]:
    """Return the ratio of each drive by scene and variant."""
    return {scene: {variant: {str(seed): ratio(each.errors.nees) for seed, each in drives.items()}
                    for variant, drives in outcomes[scene].items() if variant in (*KNOWN_OF, PITCHED)}
            for scene in SCENES}


def _row(requirement: Requirement, drive: Optional[DriveRatio], missing: int, honest: Optional[float]) -> Row:
    remark = f"{drive.name}; of as many honest ones {honest:.2f}" if drive and honest is not None else ""
    return judged(requirement, drive.value if drive else None, missing, remark=remark)
