"""One thing that was looked at."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import enum
from dataclasses import dataclass


class State(enum.Enum):
    """How it is."""

    GOOD = "ok"
    # May be missing; what it is for then is said.
    NOTE = "note"
    MISSING = "missing"


@dataclass(frozen=True)
class Finding:
    """what: a word or two. sentence: what is there, or what is missing and what to do."""

    what: str
    state: State
    sentence: str
