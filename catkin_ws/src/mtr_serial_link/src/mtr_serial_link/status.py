"""How the line is, for a person, and when that is to be reported."""
# SPDX-License-Identifier: Apache-2.0
import enum
import math
from typing import NamedTuple, Optional, Sequence

from .health import LineProblem

LINKED = "linked"
REPORT_PERIOD_S = 1.0


class Severity(enum.IntEnum):
    """How bad a status is; the numbers are those of diagnostic_msgs/DiagnosticStatus."""

    OK = 0
    WARN = 1
    ERROR = 2


class SerialLineStatus(NamedTuple):
    """How the line is, in a word or a sentence."""

    severity: Severity
    sentence: str


def line_status(path: str, trouble: str, problem: LineProblem, has_refused: bool,
                missing: Sequence[str] = ()) -> SerialLineStatus:
    """Status of a port.

    Arguments:
        trouble: why it is not open.
        has_refused: something of the device could not be served.
        missing: topics of the device whose description has not come.
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
    """Says when the status of a line is to be reported: in the turn in which it changes, and then once a period.

    Reports in a fixed period alone would only sample the line. A device that speaks in that same period would then be
    seen silent for ever, although it answers each time.
    """

    def __init__(self, period_s: float = REPORT_PERIOD_S):
        self._period_s = period_s
        self._reported: Optional[SerialLineStatus] = None
        self._reported_s = -math.inf

    def is_due(self, status: SerialLineStatus, now_s: float) -> bool:
        """True when the status is to be reported now; it then counts as reported."""
        if status == self._reported and now_s - self._reported_s < self._period_s:
            return False
        self._reported, self._reported_s = status, now_s
        return True
