"""Distance of a phone in a signal of the Car's bus."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import collections
from dataclasses import dataclass

from mtr_operator.domain.distance_feed import REPORTED, DistanceFeed, Reported
from mtr_operator.domain.results.refused import Refused
from mtr_operator.domain.robot_status import RobotStatus

from ..can_frame import CanFrame
from ..database.codec import SignalReader
from ..further.entries import FIRST_BUS, Entries, is_whole
from ..further.places import Place
from .address import SERIAL, TCP, FeedAddress, feed_address, feed_at

KEY = "phone_distance"
_SIGNAL_KEYS = {"bus", "message", "signal", "unit", "no_distance"}
# Length of each unit in metres.
_UNITS = {"m": 1.0, "dm": 0.1, "cm": 0.01, "mm": 0.001}
_MAX_WAITING = 6000
_NAME = "signal {} of the Car's message {}"


@dataclass(frozen=True, eq=False)
class PhoneSignal:
    """Signal with the distance. metres: length of the signal's unit. no_distance: raw values for an unknown
    distance."""

    place: Place
    metres: float
    no_distance: frozenset[int]


def read_phone(entries: Entries) -> PhoneSignal | FeedAddress | None:
    """Return the source that a profile declares; None without one. ConnectionFailed, or InvalidParameter for an
    address, states a fault."""
    table = entries.content.get(KEY)
    if table is None:
        return None
    if isinstance(table, str):
        return _address(entries, table)
    if not isinstance(table, dict) or not {"message", "signal"} <= set(table) or not set(table) <= _SIGNAL_KEYS:
        raise entries.wrong(f"phone_distance must be tcp:HOST:PORT, serial:DEVICE:BAUD, or a table of "
                            f"{', '.join(sorted(_SIGNAL_KEYS))}.")
    bus = table.get("bus", FIRST_BUS)
    if bus != FIRST_BUS and bus not in entries.buses:
        raise entries.wrong(f"phone_distance names the bus {bus}, which is not in buses.")
    if bus == FIRST_BUS and "database" not in entries.content:
        raise entries.wrong("phone_distance needs the entry database.")
    message = entries.message(table["message"], bus)
    name = entries.signal(message, table["signal"], bus)
    if not message.get_signal_by_name(name).scale:
        raise entries.wrong(f"phone_distance names the signal {name}, whose scale in the database is 0.")
    unit = table.get("unit") or message.get_signal_by_name(name).unit or "m"
    if unit not in _UNITS:
        raise entries.wrong(f"phone_distance has the unit {unit}; allowed is {', '.join(_UNITS)}: name it (unit).")
    none = table.get("no_distance", [])
    if not isinstance(none, list) or not all(is_whole(raw) for raw in none):
        raise entries.wrong(f"phone_distance has no_distance: {none!r}; allowed is a list of whole numbers.")
    place = Place(bus, message, name)
    return PhoneSignal(place, _UNITS[unit], frozenset().union(
        *(entries.decoded(raw, (place.declared,)) for raw in none)))


def _address(entries: Entries, text: str) -> FeedAddress:
    address = feed_address(text)
    if address.kind not in (TCP, SERIAL):
        raise entries.wrong(f"phone_distance is {text}; a simulated phone is for the command line (--phone-feed).")
    return address


def feed_of(declared: PhoneSignal | FeedAddress | None) -> DistanceFeed | None:
    """Return the feed that a profile declares, not connected yet."""
    if declared is None:
        return None
    return CarSignalFeed(declared) if isinstance(declared, PhoneSignal) else feed_at(declared)


def is_bus_feed(name: str) -> bool:
    """Return True for the name of a CarSignalFeed, as in the record of a test."""
    head, _, _ = _NAME.partition("{}")
    return name.startswith(head)


class CarSignalFeed(DistanceFeed):
    """Feed that the link to the Car updates with every frame of all buses, under its lock."""

    def __init__(self, signal: PhoneSignal):
        self._signal = signal
        self._reader = SignalReader(signal.place.message, (signal.place.signal,))
        self._waiting: collections.deque[float] = collections.deque(maxlen=_MAX_WAITING)
        self._refused = Refused()

    @property
    def name(self) -> str:
        return _NAME.format(self._signal.place.signal, self._signal.place.message.name)

    def connect(self) -> None:
        """See DistanceFeed: connected together with the link to the Car."""

    def frame(self, frame: CanFrame) -> None:
        """Add a frame."""
        place = self._signal.place
        if (frame.bus, frame.can_id, frame.is_extended) != place.key:
            return
        raw = self._reader.values(frame.data).get(place.signal)
        # The frame is too short, or another page of a multiplexed message.
        if raw is None or raw in self._signal.no_distance:
            return
        distance_m = float(place.declared.conversion.raw_to_scaled(raw, decode_choices=False)) * self._signal.metres
        wrong = REPORTED.violation(distance_m)
        if wrong:
            self._refused = Refused(self._refused.count + 1, f"{wrong[:1].upper()}{wrong[1:]}")
        else:
            self._waiting.append(distance_m)

    def observe(self, status: RobotStatus) -> list[Reported]:
        """See DistanceFeed; the link to the Car has waited until its bus had caught up with this Status."""
        told = []
        # The reader's thread may add another frame meanwhile.
        while self._waiting:
            told.append(Reported(status.stamp_s, self._waiting.popleft()))
        return told

    @property
    def problem(self) -> str:
        """See DistanceFeed: the link to the Car reports faults of the bus."""
        return ""

    @property
    def refused(self) -> Refused:
        return self._refused

    def close(self) -> None:
        pass
