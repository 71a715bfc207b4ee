"""What the last preflight found, as the ROS master keeps it between the preflight and the dispatcher. No ROS inside.

A topic would end with the preflight, which lasts some seconds; a parameter lasts until the robot is started
anew: robot.launch removes it, for the master may be the one of before.
"""
# SPDX-License-Identifier: Apache-2.0
import math
from typing import Any, Dict, NamedTuple, Optional, Tuple

# So many findings are kept, the bad ones first; a preflight with --drive makes some 40.
MAX_ITEMS = 64
# Of a count in the Status.
MAX_COUNT = 2 ** 31


class PreflightItem(NamedTuple):
    """One finding: what was looked at, whether the robot shall not be used like that, and a sentence."""

    name: str
    is_bad: bool
    sentence: str


class PreflightReport(NamedTuple):
    """All findings of one preflight.

    Attributes:
        made_s: when it ended, on the robot's steady clock, s.
        items: the bad ones first, at most MAX_ITEMS of them.
        checks: how many there were.
        bad: how many of them were bad.
        motion_made_s: when sensors were compared in motion last, on the same clock; None: not in this run of the robot.
    """

    made_s: float
    items: Tuple[PreflightItem, ...]
    checks: int
    bad: int
    motion_made_s: Optional[float] = None


def report_of(made_s: float, items: Tuple[PreflightItem, ...]) -> PreflightReport:
    """The report of these findings."""
    ordered = sorted(items, key=lambda item: not item.is_bad)
    return PreflightReport(made_s, tuple(ordered[:MAX_ITEMS]), len(items), sum(item.is_bad for item in items))


def with_motion(report: Optional[PreflightReport], motion: Optional[PreflightReport]) -> Optional[PreflightReport]:
    """The report with the time of the findings in motion; None for what was not made."""
    return report if report is None or motion is None else report._replace(motion_made_s=motion.made_s)


def parameter_of(report: PreflightReport) -> Dict[str, Any]:
    """For the master; report_in reads it."""
    return {"made_s": report.made_s, "checks": report.checks, "bad": report.bad,
            "items": [list(item) for item in report.items]}


def report_in(parameter: Any) -> Optional[PreflightReport]:
    """What the master has, None when it is no report: it holds what anybody has set."""
    try:
        items = tuple(PreflightItem(str(name), bool(is_bad), str(sentence))
                      for name, is_bad, sentence in parameter["items"][:MAX_ITEMS])
        report = PreflightReport(float(parameter["made_s"]), items, int(parameter["checks"]), int(parameter["bad"]))
    except (KeyError, TypeError, ValueError, OverflowError):
        return None
    bad = sum(item.is_bad for item in items)
    counts_hold = bad <= report.bad <= report.checks < MAX_COUNT and len(items) <= report.checks
    return report if counts_hold and math.isfinite(report.made_s) else None
