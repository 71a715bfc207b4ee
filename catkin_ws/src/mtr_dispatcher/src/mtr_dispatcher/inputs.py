"""What the dispatcher knows of the robot when it writes a Status."""
# SPDX-License-Identifier: Apache-2.0
from typing import Any, NamedTuple, Optional

# Age at which a periodic message no longer tells the present.
STALE_AFTER_S = 0.5


class Inputs(NamedTuple):
    """The messages of their topics that hold at now_s, None before the first.

    They are read by attribute; a message that is too old has been replaced by None in `fresh`.
    """

    now_s: float
    pose: Optional[Any] = None
    car: Optional[Any] = None
    mode: Optional[Any] = None
    peripherals: Optional[Any] = None
    check: Optional[Any] = None

    def fresh(self) -> "Inputs":
        """The same without stale messages."""
        return Inputs(self.now_s, *(message if self._is_fresh(message) else None for message in self[1:]))

    def _is_fresh(self, message: Optional[Any]) -> bool:
        return message is not None and self.now_s - message.header.stamp.to_sec() <= STALE_AFTER_S
