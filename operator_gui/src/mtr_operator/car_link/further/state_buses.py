"""Detects the buses that carry the message of the state, and reports if it is not on the expected one."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import collections
from typing import TYPE_CHECKING, Any

from ..can_frame import CanFrame
from .entries import FIRST_BUS

if TYPE_CHECKING:
    from ..profile import CarProfile


class StateBuses:
    """Watch of the state's message and its liveness substitute, updated with every frame."""

    def __init__(self, profile: CarProfile):
        self._profile = profile
        # A polled ECU is queried only on the first bus.
        watched = (profile.message, profile.liveness) if profile.poll is None else ()
        self._watched: dict[tuple[int, bool], Any] = {_key(each): each for each in watched if each is not None}
        self._seen: dict[tuple[int, bool], set[str]] = collections.defaultdict(set)

    def frame(self, frame: CanFrame) -> None:
        """Record the bus of a frame."""
        if (frame.can_id, frame.is_extended) in self._watched:
            self._seen[frame.can_id, frame.is_extended].add(frame.bus)

    def elsewhere(self, is_silent: bool) -> str:
        """Return a sentence if a message arrives, but only on another bus; empty otherwise.

        is_silent: a cyclic message is missing on the first bus.
        """
        for key, message in self._watched.items():
            is_missing = is_silent or (self._profile.is_only_on_change and message is self._profile.message)
            seen = self._seen.get(key, set())
            if is_missing and seen and FIRST_BUS not in seen:
                return self._sentence(message, min(seen))
        return ""

    def _sentence(self, message: Any, bus: str) -> str:
        name = f"Message {message.name} (id 0x{message.frame_id:X})"
        buses = self._profile.further.buses
        if bus in buses:
            return (f"{name} comes only on the bus {bus}, and the car profile expects it on the bus of the state. Swap "
                    "the adapters; in a log, number the channels so that the bus of the state is channel 0 and the bus "
                    f"{bus} is channel {1 + buses.index(bus)}.")
        return (f"{name} comes only on {bus} of the log, and the car profile expects it on channel 0, because it names "
                "further buses (buses). Number the channels of the log so that the bus of the state is channel 0.")

    @property
    def notices(self) -> tuple[str, ...]:
        """Return a sentence for each further bus that carries the message of the state in addition to the first one."""
        message = self._profile.message
        names = sorted(self._others() & set(self._profile.further.buses))
        return tuple(f"Message {message.name} (id 0x{message.frame_id:X}) comes on the bus of the state and on the bus "
                     f"{name}; that of the first one counts. Check that the adapters are at the buses that the profile "
                     "names." for name in names)

    @property
    def several_channels(self) -> str:
        """Return a sentence on a log with the message of the state on channels that the profile does not name, or
        empty."""
        unnamed = sorted(self._others() - set(self._profile.further.buses))
        if not unnamed:
            return ""
        message = self._profile.message
        return (f"Message {message.name} (id 0x{message.frame_id:X}) comes on several channels of the log, "
                f"{unnamed[0]} among them, and the car profile does not say which is which; name the further buses "
                "(buses).")

    def _others(self) -> set[str]:
        """Return the further buses with the message of the state, if the first one carries it."""
        seen = self._seen.get(_key(self._profile.message), set()) if self._profile.poll is None else set()
        return seen - {FIRST_BUS} if FIRST_BUS in seen else set()


def _key(message: Any) -> tuple[int, bool]:
    return message.frame_id, bool(message.is_extended_frame)
