"""Status of the line for a person, and timing of its reports."""
# SPDX-License-Identifier: Apache-2.0
import enum
import math
from typing import NamedTuple, Optional, Sequence

from .health import LineProblem

LINKED = "linked"
REPORT_PERIOD_S = 1.0


class Severity(enum.IntEnum):
    """Severity of a status; values of diagnostic_msgs/DiagnosticStatus."""

    OK = 0
    WARN = 1
    ERROR = 2


class SerialLineStatus(NamedTuple):
    """Status of the line as a severity and a sentence."""

    severity: Severity
    sentence: str


def line_status(path: str, trouble: str, problem: LineProblem, has_refused: bool,
                missing: Sequence[str] = ()) -> SerialLineStatus:
    """Return the status of a port.

    Arguments:
        trouble: reason why it is not open.
        has_refused: an item of the device was rejected.
        missing: topics of the device without a description.
    """
    if trouble:
        return SerialLineStatus(Severity.ERROR, trouble)
    if problem is LineProblem.NONE and missing:
        return SerialLineStatus(Severity.WARN, f"{LINKED}, but the board has not described {', '.join(missing)}; it is "
                                "asked again")
    if problem is LineProblem.NONE:
        return SerialLineStatus(Severity.WARN if has_refused else Severity.OK, LINKED)
    severity = Severity.WARN if problem is LineProblem.WAITING else Severity.ERROR
    return SerialLineStatus(severity, f"The port {path} {problem.value}.")


class StatusReports:
    """Schedules status reports: in the iteration of a change, and then once per period.

    Purely periodic reports would only sample the line. A device that sends with the same period could then always
    appear silent, although it answers each time.
    """

    def __init__(self, period_s: float = REPORT_PERIOD_S):
        self._period_s = period_s
        self._reported: Optional[SerialLineStatus] = None
        self._reported_s = -math.inf

    def is_due(self, status: SerialLineStatus, now_s: float) -> bool:
        """Return True if the status must be reported now; it then counts as reported."""
        if status == self._reported and now_s - self._reported_s < self._period_s:
            return False
        self._reported, self._reported_s = status, now_s
        return True
