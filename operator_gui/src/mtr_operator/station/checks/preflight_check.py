"""Check of the robot's last preflight before a test."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from mtr_operator.domain.clocks.simulated_time import is_simulated_robot
from mtr_operator.domain.robot_status import PREFLIGHT_VALID_S as OLD_AFTER_S

from ..events import RobotSnapshot
from .finding import Check, Finding, Item, State


def preflight(robot: RobotSnapshot) -> Item:
    """Return the state: good, old, bad, only at rest, or missing. A simulation needs none, a real robot one in
    motion."""
    report, steady_s = robot.preflight, robot.status.steady_s
    is_real = not is_simulated_robot(robot.status)
    lacking = State.BAD if is_real else State.UNKNOWN
    if report is None:
        return Item(Check.PREFLIGHT, lacking, Finding.PREFLIGHT_UNTOLD)
    if not report.was_made_before(steady_s):
        return Item(Check.PREFLIGHT, lacking, Finding.PREFLIGHT_NEVER)
    age_s = max(steady_s - report.made_s, 0.0)
    parts = tuple((State.BAD if item.is_bad else State.GOOD, item.text) for item in report.items)
    if report.bad:
        return Item(Check.PREFLIGHT, State.BAD, Finding.PREFLIGHT_BAD, report.first_bad,
                    (report.bad, report.checks, age_s), parts)
    if is_real and not report.was_in_motion(steady_s):
        return Item(Check.PREFLIGHT, State.BAD, Finding.PREFLIGHT_AT_REST, parts=parts)
    if is_real:
        age_s = max(steady_s - report.oldest_s, 0.0)
    state, finding = ((State.BAD if is_real else State.NOTE, Finding.PREFLIGHT_OLD) if not age_s <= OLD_AFTER_S
                      else (State.GOOD, Finding.PREFLIGHT_FINE))
    return Item(Check.PREFLIGHT, state, finding, numbers=(report.checks, report.checks, age_s), parts=parts)
