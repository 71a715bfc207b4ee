"""What one check found: a line for a person, and values for a program."""
# SPDX-License-Identifier: Apache-2.0
from dataclasses import dataclass
from typing import Any, Dict, Iterable, Optional

# Check of a finding that says what more is needed before something can be told.
NEEDS_MORE = "motion.needs_more"


@dataclass(frozen=True)
class Finding:
    """Result of one check.

    Attributes:
        check: stable word "group.what", a promise to whoever reads the JSON.
        subject: what was looked at: a topic, a frame, a sensor.
        is_bad: the robot shall not be used like that.
        text: one sentence for a person; of a bad one with value, limit and what to do.
        value: what was measured; None where it is no number.
        limit: what it had to keep; None where there is none.
        unit: of both.
    """

    check: str
    subject: str
    is_bad: bool
    text: str
    value: Optional[float] = None
    limit: Optional[float] = None
    unit: str = ""

    def line(self) -> str:
        """For the terminal: ok or BAD, what was looked at, the sentence."""
        return f"{'BAD' if self.is_bad else 'ok '} {self.subject}: {self.text}"

    def fields(self) -> Dict[str, Any]:
        """For JSON; names of keys are a promise."""
        return {"check": self.check, "subject": self.subject, "bad": self.is_bad, "text": self.text,
                "value": self.value, "limit": self.limit, "unit": self.unit}


def good(check: str, subject: str, text: str, value: Optional[float] = None, limit: Optional[float] = None,
         *, unit: str = "") -> Finding:
    """Nothing is wrong."""
    return Finding(check, subject, False, text, value, limit, unit)


def bad(check: str, subject: str, text: str, value: Optional[float] = None, limit: Optional[float] = None,
        *, unit: str = "") -> Finding:
    """Something is wrong; the text ends with what to do."""
    return Finding(check, subject, True, text, value, limit, unit)


def needs_more(subject: str, text: str, value: Optional[float] = None, limit: Optional[float] = None, *,
               unit: str = "") -> Finding:
    """Nothing can be told yet; bad, because what was not checked is not good."""
    return Finding(NEEDS_MORE, subject, True, text, value, limit, unit)


def exit_code(findings: Iterable[Finding]) -> int:
    """0 when nothing is bad, else 1."""
    return int(any(finding.is_bad for finding in findings))
