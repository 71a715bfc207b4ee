"""Result of one check: a line for a person, and values for a program."""
# SPDX-License-Identifier: Apache-2.0
from dataclasses import dataclass
from typing import Any, Dict, Iterable, Optional

# Check of a finding that states which data is missing for a result.
NEEDS_MORE = "motion.needs_more"


@dataclass(frozen=True)
class Finding:
    """Result of one check.

    Attributes:
        check: stable word "group.what", a promise to readers of the JSON.
        subject: checked topic, frame or sensor.
        is_bad: the robot must not be used in this state.
        text: one sentence for a person; for a bad finding with value, limit and remedy.
        value: measured number; None without one.
        limit: of the value; None without one.
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
        """Return a line for the terminal: ok or BAD, the subject, the sentence."""
        return f"{'BAD' if self.is_bad else 'ok '} {self.subject}: {self.text}"

    def fields(self) -> Dict[str, Any]:
        """Return the fields for JSON; names of keys are a promise."""
        return {"check": self.check, "subject": self.subject, "bad": self.is_bad, "text": self.text,
                "value": self.value, "limit": self.limit, "unit": self.unit}


def good(check: str, subject: str, text: str, value: Optional[float] = None, limit: Optional[float] = None,
         *, unit: str = "") -> Finding:
    """Return a good finding."""
    return Finding(check, subject, False, text, value, limit, unit)


def bad(check: str, subject: str, text: str, value: Optional[float] = None, limit: Optional[float] = None,
        *, unit: str = "") -> Finding:
    """Return a bad finding; the text ends with the remedy."""
    return Finding(check, subject, True, text, value, limit, unit)


def needs_more(subject: str, text: str, value: Optional[float] = None, limit: Optional[float] = None, *,
               unit: str = "") -> Finding:
    """Return a finding without a result yet; it is bad, because an unchecked part is not good."""
    return Finding(NEEDS_MORE, subject, True, text, value, limit, unit)


def exit_code(findings: Iterable[Finding]) -> int:
    """Return 0 if nothing is bad, else 1."""
    return int(any(finding.is_bad for finding in findings))
