"""Findings in motion, which remain valid until the next drive: a check of the stationary robot does not clear them."""
# SPDX-License-Identifier: Apache-2.0
from typing import List, Optional

from mtr_dispatcher.preflight_report import PreflightReport
from mtr_motion_check.finding import Finding, good

MOTION = "motion.last"


def findings_kept(report: Optional[PreflightReport], now_s: float) -> List[Finding]:
    """Return the findings of the last preflight with --drive, each with its age, or one that states there are none.

    Args:
        report: of the motion alone; None without one since the robot's start.
        now_s: on the robot's steady clock.
    """
    # A simulated clock restarts while the master may remain.
    if report is None or report.made_s > now_s:
        return [good(MOTION, "motion", "Nothing was compared in motion yet; preflight --drive does it.")]
    ago = age_text(now_s - report.made_s)
    return [Finding(MOTION, item.name, item.is_bad, f"{item.sentence} (In motion, {ago} ago.)")
            for item in report.items]


def age_text(age_s: float) -> str:
    """Return the age in minutes, or in hours if it is large."""
    minutes = round(age_s / 60.0)
    return f"{minutes} min" if minutes < 120 else f"{minutes // 60} h"
