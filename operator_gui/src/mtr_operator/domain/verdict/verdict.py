"""The verdicts and their order: a parent takes the worst of its children, as in OpenTAP."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import enum
from typing import Iterable


class Verdict(enum.IntEnum):
    """From good to bad; the numbers only order them."""

    NOT_SET = 0
    PASS = 1
    INCONCLUSIVE = 2
    FAIL = 3
    ABORTED = 4
    ERROR = 5

    @property
    def word(self) -> str:
        """As it stands in files and sentences."""
        return self.name.lower()


def worst(verdicts: Iterable[Verdict]) -> Verdict:
    """The worst one; NOT_SET when there is none."""
    return max(verdicts, default=Verdict.NOT_SET)
