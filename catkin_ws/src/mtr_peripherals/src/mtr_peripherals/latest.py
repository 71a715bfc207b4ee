"""The newest message of a topic that need not come, with its age on the steady clock."""
# SPDX-License-Identifier: Apache-2.0
from typing import Generic, Optional, Tuple, TypeVar

from mtr_core.liveness import NS, is_fresh

T = TypeVar("T")


class Latest(Generic[T]):
    """Holds one message; written by one thread, read by another."""

    def __init__(self) -> None:
        self._taken: Optional[Tuple[T, int]] = None

    def take(self, message: T, steady_stamp_ns: int) -> None:
        """A message of that time."""
        self._taken = message, steady_stamp_ns

    def at(self, now_ns: int, limit_s: float) -> Optional[T]:
        """The message when it is not older than that, else None."""
        taken = self._taken
        return taken[0] if taken and is_fresh((now_ns - taken[1]) * NS, limit_s) else None
