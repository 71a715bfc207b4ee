"""Frames of a simulated Car on a bus, built from its profile."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import collections
from typing import Any, Iterator, NamedTuple

import can

from mtr_operator.domain.errors import ConnectionFailed
from mtr_operator.domain.ports import LockState

from ..database.codec import as_decoded, encode
from ..phone.car_signal import PhoneSignal
from ..profile import CarProfile
from .declared import CauseSignal
from .entries import FIRST_BUS
from .places import MessageKey

# Time for which the flag of a change and a temporary cause are set: some cycles of every message.
_SHOWN_S = 0.1
_FEWEST_FRAMES = 3
# Time for which a Car with a state only on change repeats locking before a test.
_ANNOUNCED_S = 1.0
# Background frames, because a real bus is never empty.
BACKGROUND_ID = 0x001


class SpokenFrame(NamedTuple):
    """A frame and the name of its bus."""

    bus: str
    message: can.Message


class SpokenFrames:
    """Generator of the frames, cycle by cycle; all signals that the profile does not name are 0.

    Attributes:
        is_locked, source: content of the next cycle; source: as in CarEvent.
        stops, open_doors: raw values of stop signals by kind, if different from a parked Car's, and names of open
            doors.
    """

    def __init__(self, profile: CarProfile, is_locked: bool = True):
        self.is_locked, self.source = is_locked, ""
        self.stops: dict[str, int] = {}
        self.open_doors: set[str] = set()
        self._profile = profile
        self._was_locked = is_locked
        self._cycles = self._changes = self._shown = 0
        self._sent: collections.Counter[MessageKey] = collections.Counter()
        self._is_told = False
        self._distance_raw: int | None = None
        # The state comes first: signals of a change are sent together with it or after it.
        self._messages: dict[MessageKey, Any] = {
            (FIRST_BUS, profile.message.frame_id, profile.message.is_extended_frame): profile.message}
        self._messages.update((place.key, place.message) for place in profile.further.places())

    @property
    def is_fd(self) -> bool:
        """True if one of the messages needs CAN FD."""
        return any(message.is_fd or message.length > 8 for message in self._messages.values())

    def next(self) -> Iterator[SpokenFrame]:
        """Yield the frames of the next cycle."""
        self._cycles += 1
        self._shown = max(self._shown - 1, 0)
        if self.is_locked is not self._was_locked:
            self._was_locked = self.is_locked
            self._changes += 1
            self._shown = max(round(_SHOWN_S / self._profile.cycle_time_s), _FEWEST_FRAMES)
            self._is_told = False
        if self._profile.is_only_on_change:
            yield from self._sign_of_life()
        for key, message in self._messages.items():
            if message is not self._profile.message or not self._is_told:
                yield self._frame(key, message)
        is_begun = self._cycles * self._profile.cycle_time_s > _ANNOUNCED_S
        self._is_told = self._profile.is_only_on_change and is_begun

    def _sign_of_life(self) -> Iterator[SpokenFrame]:
        """Yield the cyclic frames that accompany a state that is sent only on change."""
        message = self._profile.liveness
        if message is None:
            yield SpokenFrame(FIRST_BUS, can.Message(arbitration_id=BACKGROUND_ID, is_extended_id=False))
            return
        key = (FIRST_BUS, message.frame_id, message.is_extended_frame)
        # A message with further signals of the profile is sent in each cycle anyway.
        if key not in self._messages:
            yield self._frame(key, message)

    def phone(self, signal: PhoneSignal, distance_m: float) -> Iterator[SpokenFrame]:
        """Yield the distance of a phone, in the nearest step of the Car's signal.

        A message with other signals of the profile carries it from the next cycle on, and needs no frame of its own.
        """
        place = signal.place
        self._distance_raw = round((distance_m / signal.metres - place.declared.offset) / place.declared.scale)
        if place.key not in self._messages:
            yield self._frame(place.key, place.message)

    def _frame(self, key: MessageKey, message: Any) -> SpokenFrame:
        self._sent[key] += 1
        return SpokenFrame(key[0], _sent(message, self._data(key, message)))

    def _data(self, key: MessageKey, message: Any) -> bytes:
        wanted = dict(self._wanted(key, message))
        for name, value in wanted.items():
            if as_decoded(message.get_signal_by_name(name), value) is None:
                raise ConnectionFailed(f"Signal {name} of message {message.name} cannot carry the value {value}.")
        return encode(message, wanted)

    def _wanted(self, key: MessageKey, message: Any) -> Iterator[tuple[str, int]]:
        profile, further = self._profile, self._profile.further
        if message is profile.message:
            yield from self._state(self._sent[key])
        for place, count in [*((each, self._sent[key]) for each in further.alive),
                             *((each, self._changes) for each in further.counters)]:
            if place.message is message:
                yield place.signal, place.counts.value(count)
        if isinstance(profile.phone, PhoneSignal) and profile.phone.place.key == key and self._distance_raw is not None:
            yield profile.phone.place.signal, self._distance_raw
        yield from self._stops(message)
        if further.key is not None and further.key.message is message:
            yield further.key.signal, further.key_under_test or 1
        for cause in further.causes:
            if cause.place.message is message:
                yield cause.place.signal, self._cause(cause)

    def _stops(self, message: Any) -> Iterator[tuple[str, int]]:
        """Yield the values of doors and of signals that stop the robot."""
        for door in self._profile.further.doors:
            if door.place.message is message:
                yield door.place.signal, min(door.open) if door.name in self.open_doors else _other_than(door.open)
        for stop in self._profile.further.stops:
            if stop.place.message is message:
                yield stop.place.signal, self.stops.get(stop.kind, min(stop.parked))

    def _state(self, sent: int) -> Iterator[tuple[str, int]]:
        """Yield the values of the state's message. sent: frames of the message, including this one."""
        profile = self._profile
        raw = state_raw(profile, self.is_locked)
        yield from ((signal, raw) for signal in (profile.door_signals.values() or (profile.signal,)))
        counts = {profile.alive_signal: sent, profile.command_signal: self._changes}
        yield from ((name, profile.counts(name).value(count)) for name, count in counts.items() if name)
        if profile.changed_signal:
            yield profile.changed_signal, int(self._shown > 0)
        if profile.source_signal:
            yield profile.source_signal, _raw_of(profile.sources, self.source, 0)

    def _cause(self, cause: CauseSignal) -> int:
        idle = min(cause.idle, default=_other_than(frozenset(cause.sources)))
        return _raw_of(cause.sources, self.source, idle) if cause.stays or self._shown else idle


def _sent(message: Any, data: bytes) -> can.Message:
    is_fd = bool(message.is_fd or message.length > 8)
    return can.Message(arbitration_id=message.frame_id, is_extended_id=message.is_extended_frame, is_fd=is_fd,
                       bitrate_switch=is_fd, data=data)


def state_raw(profile: CarProfile, is_locked: bool) -> int:
    """Return the raw value of a state, of all doors if the driver's door has a separate value."""
    wanted = LockState.LOCKED if is_locked else LockState.UNLOCKED
    raws = [raw for raw, state in profile.states.items() if state is wanted]
    if not raws:
        raise ConnectionFailed(f"Car profile {profile.name}: no signal can carry a value that states lists as "
                               f"{wanted.value}.")
    return next((raw for raw in raws if raw not in profile.driver_only), raws[0])


def _raw_of(sources: dict[int, str], source: str, otherwise: int) -> int:
    return next((raw for raw, each in sources.items() if each == source), otherwise)


def _other_than(values: frozenset[int]) -> int:
    return next(value for value in range(len(values) + 1) if value not in values)
