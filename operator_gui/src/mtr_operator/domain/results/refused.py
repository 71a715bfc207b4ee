"""Count of the messages that a link, the bus or a feed refused."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class Refused:
    """How many messages were not believed or not obeyed, and a sentence about the last one."""

    count: int = 0
    last: str = ""
