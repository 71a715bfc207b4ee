"""What the robot's last preflight says before a test."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from ..events import RobotSnapshot
from .finding import Check, Finding, Item, State

# Longer than a working day: cables, mounts and clocks were touched since.
OLD_AFTER_S = 12.0 * 3600.0


def preflight(robot: RobotSnapshot) -> Item:
    """Good, old, bad, or not made, which nobody needs who simulates."""
    report, steady_s = robot.preflight, robot.status.steady_s
    if report is None:
        return Item(Check.PREFLIGHT, State.UNKNOWN, Finding.PREFLIGHT_UNTOLD)
    if not report.was_made_before(steady_s):
        return Item(Check.PREFLIGHT, State.UNKNOWN, Finding.PREFLIGHT_NEVER)
    age_s = max(steady_s - report.made_s, 0.0)
    parts = tuple((State.BAD if item.is_bad else State.GOOD, item.text) for item in report.items)
    if report.bad:
        return Item(Check.PREFLIGHT, State.BAD, Finding.PREFLIGHT_BAD, report.first_bad,
                    (report.bad, report.checks, age_s), parts)
    state, finding = ((State.NOTE, Finding.PREFLIGHT_OLD) if age_s > OLD_AFTER_S
                      else (State.GOOD, Finding.PREFLIGHT_FINE))
    return Item(Check.PREFLIGHT, state, finding, numbers=(report.checks, report.checks, age_s), parts=parts)

