"""Outcome of a line for tools that only distinguish good, bad and nothing."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from typing import Any, Mapping, Sequence

PASS, FAIL, NOTHING = "pass", "fail", "nothing"
NOT_MEASURED = "The line was not measured."


def line_outcome(line: Mapping[str, Any]) -> str:
    """Return PASS for a measured line, with or without a reaction of the Car; FAIL for an invalid one; NOTHING without
    a distance."""
    states = {distance["status"] for distance in line["distances"]}
    if "invalid" in states or line["reason"]:
        return FAIL
    return PASS if states else NOTHING


def unmeasured_lines(record: Mapping[str, Any]) -> Sequence[Mapping[str, Any]]:
    """Return the planned lines without a result; older records do not contain the plan."""
    measured = {line["number"] for line in record["lines"]}
    return [line for line in record.get("planned_lines", ()) if line["number"] not in measured]
