"""Bounds how often the log hears of one kind of event."""
# SPDX-License-Identifier: Apache-2.0
from typing import Dict, Hashable, Tuple


class Throttle:
    """Lets one sentence of a kind pass per period, with the number of those that it kept back.

    The key is the kind, not the sentence: whoever floods the robot chooses the words.
    """

    def __init__(self, period_s: float):
        self._period_s = period_s
        self._kinds: Dict[Hashable, Tuple[float, int]] = {}

    def passed(self, kind: Hashable, sentence: str, now_s: float) -> str:
        """The sentence for the log, empty when it is kept back."""
        said_s, kept_back = self._kinds.get(kind, (-float("inf"), 0))
        if now_s - said_s < self._period_s:
            self._kinds[kind] = (said_s, kept_back + 1)
            return ""
        self._kinds[kind] = (now_s, 0)
        return f"{sentence} ({kept_back} more of this kind before.)" if kept_back else sentence
