"""Entries of a profile for the signals that stop the robot: ignition, gear and speed."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from mtr_operator.domain.supervision.car_signals import GEAR, IGNITION, SPEED

from .entries import Entries, is_whole
from .places import Place

KEY = "stop_signals"
KINDS = (IGNITION, GEAR, SPEED)
PLACE_KEYS = {"bus", "message", "signal"}
_KEYS = PLACE_KEYS | {"parked", "unknown"}


@dataclass(frozen=True, eq=False)
class StopSignal:
    """Signal that stops the robot. kind: see domain.supervision.car_signals. parked: raw values of a parked Car, with
    which the robot may move. unknown: values without information. Any other value stops the robot."""

    kind: str
    place: Place
    parked: frozenset[int]
    unknown: frozenset[int]


def stop_tables(entries: Entries) -> dict[str, dict[str, Any]]:
    """Return the entry stop_signals by kind; ConnectionFailed states a fault."""
    table = entries.content.get(KEY, {})
    if not isinstance(table, dict) or not set(table) <= set(KINDS):
        raise entries.wrong(f"{KEY} must be a table of {', '.join(KINDS)}.")
    for kind, each in table.items():
        if not isinstance(each, dict) or not {"message", "signal", "parked"} <= set(each) <= _KEYS:
            raise entries.wrong(f"{kind} of {KEY} must be a table of message, signal and parked; bus and unknown are "
                                "optional.")
        if not each["parked"]:
            raise entries.wrong(f"{kind} of {KEY} has no parked value: the robot could never move.")
    return table


def stop_signal(entries: Entries, kind: str, table: dict[str, Any], place: Place) -> StopSignal:
    """Return one signal, with the values as decoded."""
    parked, unknown = (_values(entries, kind, name, table.get(name, []), place) for name in ("parked", "unknown"))
    if not parked:
        raise entries.wrong(f"{kind} of {KEY} lists no parked value that the signal {place.signal} can carry.")
    if parked & unknown:
        raise entries.wrong(f"{kind} of {KEY} lists {min(parked & unknown)} as parked and as unknown.")
    return StopSignal(kind, place, parked, unknown)


def _values(entries: Entries, kind: str, name: str, values: Any, place: Place) -> frozenset[int]:
    if not isinstance(values, list) or not all(is_whole(value) for value in values):
        raise entries.wrong(f"{kind} of {KEY} has {name}: {values!r}; allowed is a list of whole numbers.")
    return frozenset().union(*(entries.decoded(value, (place.declared,)) for value in values))
