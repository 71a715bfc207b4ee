"""What a log need not hear: what every start says, and the same kind again and again."""
# SPDX-License-Identifier: Apache-2.0
from typing import Dict, Hashable, Optional, Tuple

# All nodes of a robot have spoken by then.
QUIET_S = 5.0


class QuietStart:
    """Until everything was good once, or for some seconds, nothing that is missing is worth a warning."""

    def __init__(self, quiet_s: float = QUIET_S):
        self._quiet_s = quiet_s
        self._begun_s: Optional[float] = None

    def warns(self, now_s: float, is_good: bool) -> bool:
        """True when what is missing at a tick is a warning; is_good: nothing is. now_s: on the steady clock."""
        if self._begun_s is None:
            self._begun_s = now_s
        if is_good:
            self._quiet_s = 0.0
        return now_s - self._begun_s >= self._quiet_s


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
