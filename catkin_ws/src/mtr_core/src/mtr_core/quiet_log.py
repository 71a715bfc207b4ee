"""Suppression of log entries: missing inputs at a start, and repetitions of the same kind."""
# SPDX-License-Identifier: Apache-2.0
from typing import Dict, Hashable, Optional, Tuple

# By then all nodes of a robot have published.
QUIET_S = 5.0


class QuietStart:
    """Suppresses warnings about missing inputs until all were available once, or for some seconds."""

    def __init__(self, quiet_s: float = QUIET_S):
        self._quiet_s = quiet_s
        self._begun_s: Optional[float] = None

    def warns(self, now_s: float, is_good: bool) -> bool:
        """Return True if missing inputs are worth a warning at now_s of the steady clock. is_good: none is missing."""
        if self._begun_s is None:
            self._begun_s = now_s
        if is_good:
            self._quiet_s = 0.0
        return now_s - self._begun_s >= self._quiet_s


class Throttle:
    """Passes one sentence of each kind per period, with the number of suppressed ones.

    The key is the kind, not the sentence, because a flooding sender can vary its text.
    """

    def __init__(self, period_s: float):
        self._period_s = period_s
        self._kinds: Dict[Hashable, Tuple[float, int]] = {}

    def passed(self, kind: Hashable, sentence: str, now_s: float) -> str:
        """Return the sentence for the log, or an empty text if it is suppressed."""
        said_s, kept_back = self._kinds.get(kind, (-float("inf"), 0))
        if now_s - said_s < self._period_s:
            self._kinds[kind] = (said_s, kept_back + 1)
            return ""
        self._kinds[kind] = (now_s, 0)
        return f"{sentence} ({kept_back} more of this kind before.)" if kept_back else sentence
