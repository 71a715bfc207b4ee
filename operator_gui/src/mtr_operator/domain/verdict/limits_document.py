"""Limits from the plain values of a file; each refusal is one sentence that names the place in it.

    further_time_limit_s: 600          # 0 to 7200, default 600
    limits:                            # 1 to 200 of them
      - name: driver's door            # default: its number
        what: unlock                   # a distance of the scenario: unlock, lock, press; or sleep_time, phone_error,
                                       # relay_probability
        at_least_m: 1.2                # or at_most_m; at_least_s or at_most_s of sleep_time, at_most_error_m of
                                       # phone_error, at_most_percent of relay_probability
        share_percent: 50              # 5, 50 or 95, default 50
        sides: [left, front_left]      # default: all
        angles_deg: [225, 315]         # clockwise from the Car's front, default: all
"""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import difflib
from typing import Any, Mapping

from .. import limits as numbers
from ..errors import InvalidLimits
from .limits import DEFAULT_FURTHER_TIME_S, Limits
from .requirement import (
    AT_LEAST_S,
    AT_MOST_ERROR_M,
    AT_MOST_PERCENT,
    AT_MOST_S,
    OF_DISTANCES,
    SIDES,
    UNITS,
    Requirement,
)

# 24 zones of a Car with some limits each; a longer list is not maintainable.
MAX_REQUIREMENTS = 200
SHARES_PERCENT = (50, 95, 5)
_MAX_TEXT = 60
_KEYS = ("limits", "further_time_limit_s")
_ENTRY_KEYS = ("name", "what", *UNITS, "share_percent", "sides", "angles_deg")
_FURTHER_TIME = numbers.Limit("further_time_limit_s", 0.0, 7200.0, "s")
_OF_KEY = {
    **dict.fromkeys(OF_DISTANCES, numbers.DISTANCE), **dict.fromkeys((AT_LEAST_S, AT_MOST_S), numbers.Limit(
        "a time", 0.0, 86_400.0, "s")),
    AT_MOST_ERROR_M: numbers.Limit("an error", 0.0, 1000.0, "m"),
    AT_MOST_PERCENT: numbers.Limit("a probability", 0.0, 100.0, "%")}
_ANGLE = numbers.Limit("an angle", -360.0, 720.0, "deg")
_WIDEST_DEG = 360.0


def limits_from(document: Any) -> Limits:
    """Return the limits in a document; InvalidLimits states fault and position."""
    if not isinstance(document, Mapping):
        raise InvalidLimits("It has to consist of lines of the form 'name: value', one of them 'limits:'.")
    _check_keys(document, _KEYS, "")
    further_s = document.get("further_time_limit_s", DEFAULT_FURTHER_TIME_S)
    _check_number(_FURTHER_TIME, further_s, "")
    entries = document.get("limits")
    if not isinstance(entries, list) or not 1 <= len(entries) <= MAX_REQUIREMENTS:
        raise InvalidLimits(f"'limits' has to be a list of 1 to {MAX_REQUIREMENTS} limits.")
    requirements = tuple(_requirement(number, entry) for number, entry in enumerate(entries, start=1))
    names = [requirement.name for requirement in requirements]
    doubled = next((name for name in names if names.count(name) > 1), None)
    if doubled is not None:
        raise InvalidLimits(f"Two limits are called {doubled!r}; give each a name of its own.")
    return Limits(requirements, float(further_s))


def _requirement(number: int, entry: Any) -> Requirement:
    place = f"Limit {number}: "
    if not isinstance(entry, Mapping):
        raise InvalidLimits(f"{place}it has to consist of lines of the form 'name: value'.")
    _check_keys(entry, _ENTRY_KEYS, place)
    name = _text(entry.get("name", f"limit {number}"), "name", place)
    bounds = {key: entry[key] for key in UNITS if entry.get(key) is not None}
    if len(bounds) != 1:
        raise InvalidLimits(f"{place}it needs either at_least_m or at_most_m; or, of what is no distance, one of "
                            f"{', '.join(key for key in UNITS if key not in OF_DISTANCES)}.")
    (key, bound), = bounds.items()
    _check_number(_OF_KEY[key], bound, place)
    of_distance: dict[str, Any] = dict.fromkeys(OF_DISTANCES)
    return Requirement(name, _text(entry.get("what"), "what", place), **{**of_distance, key: float(bound)},
                       share_percent=_share(entry, place, key), sides=_sides(entry.get("sides"), place),
                       angles_deg=_angles(entry.get("angles_deg"), place))


def _share(entry: Mapping[Any, Any], place: str, key: str) -> int:
    share = entry.get("share_percent", SHARES_PERCENT[0])
    if "share_percent" in entry and key not in OF_DISTANCES:
        raise InvalidLimits(f"{place}share_percent is for distances; leave it out beside {key}.")
    if isinstance(share, bool) or share not in SHARES_PERCENT:
        raise InvalidLimits(f"{place}share_percent has to be one of {', '.join(map(str, sorted(SHARES_PERCENT)))}.")
    return int(share)


def _sides(value: Any, place: str) -> tuple[str, ...]:
    if value is None:
        return ()
    if not isinstance(value, list) or not value or not all(isinstance(side, str) for side in value):
        raise InvalidLimits(f"{place}sides has to be a list of sides, such as [left, front_left].")
    for side in value:
        if side not in SIDES:
            raise InvalidLimits(f"{place}side {side[:_MAX_TEXT]!r} is unknown; known are {', '.join(SIDES)}.")
    return tuple(dict.fromkeys(value))


def _angles(value: Any, place: str) -> tuple[float, float] | None:
    if value is None:
        return None
    if not isinstance(value, list) or len(value) != 2:
        raise InvalidLimits(f"{place}angles_deg has to be a list of two angles, such as [225, 315].")
    for angle in value:
        _check_number(_ANGLE, angle, place)
    first, last = map(float, value)
    if last - first > _WIDEST_DEG:
        raise InvalidLimits(f"{place}angles_deg goes round more than once.")
    return first, last


def _text(value: Any, key: str, place: str) -> str:
    if not isinstance(value, str) or not value.strip() or len(value) > _MAX_TEXT or not value.isprintable():
        raise InvalidLimits(f"{place}{key} has to be a text of 1 to {_MAX_TEXT} characters in one line.")
    return value.strip()


def _check_number(limit: numbers.Limit, value: Any, place: str) -> None:
    violation = limit.violation(value, place)
    if violation:
        raise InvalidLimits(violation)


def _check_keys(table: Mapping[Any, Any], known: tuple[str, ...], place: str) -> None:
    for key in table:
        if key not in known:
            shown = key[:_MAX_TEXT] if isinstance(key, str) else type(key).__name__
            close = difflib.get_close_matches(shown, known, n=1)
            hint = f"did you mean {close[0]}?" if close else f"known are {', '.join(known)}."
            raise InvalidLimits(f"{place}{shown!r} is unknown; {hint}")
