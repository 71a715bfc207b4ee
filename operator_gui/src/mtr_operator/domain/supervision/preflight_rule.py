"""Preflight required for a test: no bad one, and on a real robot a recent one in motion."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import math

from ..clocks.clock_offset import span_text
from ..clocks.simulated_time import is_simulated_robot
from ..robot_status import PREFLIGHT_VALID_S, PreflightReport, RobotStatus

COMMAND = "rosrun mtr_commissioning preflight --drive"


def preflight_hindrance(report: PreflightReport | None, status: RobotStatus) -> str:
    """Return a sentence with the remedy if the newest preflight prevents a test; empty if it permits one.

    A report expires with the run of the robot in which it was made, so it always applies to the current release and
    description.
    """
    if report is not None and report.hinders(status.steady_s):
        return (f"No test begins, because the robot's preflight found: {report.first_bad} Mend it, then run "
                "`rosrun mtr_commissioning preflight` on the robot again.")
    return "" if is_simulated_robot(status) else _missing(report, status.steady_s)


def _missing(report: PreflightReport | None, steady_s: float) -> str:
    """Return the sentence for a real robot."""
    if report is None or math.isnan(steady_s):
        return ("No test begins on a real robot that does not report its preflight; update its software, then run "
                f"`{COMMAND}` on it.")
    if not report.was_made_before(steady_s):
        return ("No test begins on a real robot before a preflight in motion, since its start or its last update: run "
                f"`{COMMAND}` on it.")
    if not report.was_in_motion(steady_s):
        return ("No test begins on a real robot before a preflight in motion; the last one was made at rest: run "
                f"`{COMMAND}` on it.")
    age_s = steady_s - report.oldest_s
    if not age_s <= PREFLIGHT_VALID_S:
        return (f"No test begins on a real robot whose preflight in motion was made {span_text(age_s)} ago; allowed "
                f"are {span_text(PREFLIGHT_VALID_S)}: run `{COMMAND}` on it.")
    return ""
