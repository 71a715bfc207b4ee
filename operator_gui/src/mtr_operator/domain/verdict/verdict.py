"""Verdicts and their order: a parent has the worst verdict of its children, as in OpenTAP."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import enum
from typing import Iterable


class Verdict(enum.IntEnum):
    """Verdicts from good to bad; the numbers only define the order."""

    NOT_SET = 0
    PASS = 1
    INCONCLUSIVE = 2
    FAIL = 3
    ABORTED = 4
    ERROR = 5

    @property
    def word(self) -> str:
        """Verdict in files and sentences."""
        return self.name.lower()


def worst(verdicts: Iterable[Verdict]) -> Verdict:
    """Return the worst verdict; NOT_SET without any."""
    return max(verdicts, default=Verdict.NOT_SET)
