"""What every start says, and what is a warning only when it lasts."""
# SPDX-License-Identifier: Apache-2.0
from typing import Optional

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
