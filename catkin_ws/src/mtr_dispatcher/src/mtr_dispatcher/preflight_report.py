"""The report of the last preflight, stored in the ROS master for the dispatcher. No ROS inside.

A topic would end with the preflight after some seconds; a parameter persists. At a robot start, robot.launch removes
the parameter, because the master may be older than the robot run.
"""
# SPDX-License-Identifier: Apache-2.0
import math
from typing import Any, Dict, NamedTuple, Optional, Tuple

# Number of stored findings, the bad ones first; a preflight with --drive yields about 40.
MAX_ITEMS = 64
# Upper bound of a count in the Status.
MAX_COUNT = 2 ** 31


class PreflightItem(NamedTuple):
    """One finding: name of the check, True if the robot must not be used, and a sentence."""

    name: str
    is_bad: bool
    sentence: str


class PreflightReport(NamedTuple):
    """All findings of one preflight.

    Attributes:
        made_s: end of the preflight on the robot's steady clock, s.
        items: findings, the bad ones first, at most MAX_ITEMS.
        checks: number of all findings.
        bad: number of all bad findings.
        motion_made_s: time of the last sensor comparison in motion on the same clock; None: not in this robot run.
    """

    made_s: float
    items: Tuple[PreflightItem, ...]
    checks: int
    bad: int
    motion_made_s: Optional[float] = None


def report_of(made_s: float, items: Tuple[PreflightItem, ...]) -> PreflightReport:
    """Return the report of these findings."""
    ordered = sorted(items, key=lambda item: not item.is_bad)
    return PreflightReport(made_s, tuple(ordered[:MAX_ITEMS]), len(items), sum(item.is_bad for item in items))


def with_motion(report: Optional[PreflightReport], motion: Optional[PreflightReport]) -> Optional[PreflightReport]:
    """Return the report with the time of the findings in motion; None without a report."""
    return report if report is None or motion is None else report._replace(motion_made_s=motion.made_s)


def parameter_of(report: PreflightReport) -> Dict[str, Any]:
    """Return the value of the master's parameter; report_in parses it."""
    return {"made_s": report.made_s, "checks": report.checks, "bad": report.bad,
            "items": [list(item) for item in report.items]}


def report_in(parameter: Any) -> Optional[PreflightReport]:
    """Parse the master's parameter; None if it is not a report, because any program may have set it."""
    try:
        items = tuple(PreflightItem(str(name), bool(is_bad), str(sentence))
                      for name, is_bad, sentence in parameter["items"][:MAX_ITEMS])
        report = PreflightReport(float(parameter["made_s"]), items, int(parameter["checks"]), int(parameter["bad"]))
    except (KeyError, TypeError, ValueError, OverflowError):
        return None
    bad = sum(item.is_bad for item in items)
    counts_hold = bad <= report.bad <= report.checks < MAX_COUNT and len(items) <= report.checks
    return report if counts_hold and math.isfinite(report.made_s) else None
