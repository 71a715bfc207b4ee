"""The newest message of an optional topic, with its age on the steady clock."""
# SPDX-License-Identifier: Apache-2.0
from typing import Generic, Optional, Tuple, TypeVar

from mtr_core.liveness import NS, is_fresh

T = TypeVar("T")


class Latest(Generic[T]):
    """Stores one message; written by one thread, read by another."""

    def __init__(self) -> None:
        self._taken: Optional[Tuple[T, int]] = None

    def take(self, message: T, steady_stamp_ns: int) -> None:
        """Store a message with its steady time."""
        self._taken = message, steady_stamp_ns

    def at(self, now_ns: int, limit_s: float) -> Optional[T]:
        """Return the message if it is not older than the limit, otherwise None."""
        taken = self._taken
        return taken[0] if taken and is_fresh((now_ns - taken[1]) * NS, limit_s) else None
