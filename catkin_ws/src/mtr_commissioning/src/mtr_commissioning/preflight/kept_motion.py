"""What was found in motion counts until somebody drives again: a look at the robot that stands does not clear it."""
# SPDX-License-Identifier: Apache-2.0
from typing import List, Optional

from mtr_dispatcher.preflight_report import PreflightReport
from mtr_motion_check.finding import Finding, good

MOTION = "motion.last"


def findings_kept(report: Optional[PreflightReport], now_s: float) -> List[Finding]:
    """Findings of the last preflight with --drive, each with its age; one that says so where there is none.

    Args:
        report: of the motion alone; None when none was made in this run of the robot.
        now_s: on the robot's steady clock.
    """
    # A simulated clock begins anew, the master may stay.
    if report is None or report.made_s > now_s:
        return [good(MOTION, "motion", "Nothing was compared in motion yet; preflight --drive does it.")]
    ago = age_text(now_s - report.made_s)
    return [Finding(MOTION, item.name, item.is_bad, f"{item.sentence} (In motion, {ago} ago.)")
            for item in report.items]


def age_text(age_s: float) -> str:
    """In minutes, or in hours where it is many."""
    minutes = round(age_s / 60.0)
    return f"{minutes} min" if minutes < 120 else f"{minutes // 60} h"
