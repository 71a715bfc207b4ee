"""A calibration record from the plain values of a file; each refusal is one sentence that names the place in it.

    robot: MTR-1                  # which robot
    date: 2026-03-01
    by: J. Novak
    valid_days: 365               # 1 to 3650; null: without end
    key_ahead_m: 0.35             # Remote key in front of base_link
    terms:                        # all four
      mast_lean_deg: {value: 0.1, uncertainty: 0.2, distribution: normal, degrees_of_freedom: 9, source: spirit level}
      floor_slope_deg: {value: 0, uncertainty: 0.5, distribution: rectangular, source: survey of the hall}
      key_lever_m: {value: 0, uncertainty: 0.002, distribution: rectangular, source: rule}
      lidar_yaw_deg: {value: 0, uncertainty: 0.3, distribution: normal, source: wall test}
    checks:                       # may be missing: what was measured when, also what is in no budget
      - {name: wheel_scale, date: 2026-03-01, by: J. Novak, value: 1.002, uncertainty: 0.0003, source: tape of 10 m}
"""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import datetime
import math
from typing import Any, Mapping

from ...errors import InvalidCalibration
from ...limits import Limit
from .calibration import TERM_NAMES, CalibratedTerm, CalibrationRecord, Distribution, RobotCheck

_KEYS = ("robot", "date", "by", "valid_days", "key_ahead_m", "terms")
_TERM_KEYS = ("value", "uncertainty", "distribution", "degrees_of_freedom", "source")
_CHECK_KEYS = ("name", "date", "by", "value", "uncertainty", "source")
_MAX_CHECKS = 50
_CHECK_VALUE, _CHECK_UNCERTAINTY = Limit("value", -1e4, 1e4), Limit("uncertainty", 0.0, 1e4)
_MAX_TEXT = 200
_VALID_DAYS = Limit("valid_days", 1, 3650, "days")
_KEY_AHEAD = Limit("key_ahead_m", -3.0, 3.0, "m")
_FREEDOM = Limit("degrees_of_freedom", 1.0, 1e9)
# A mast that leans by 10 degrees, or a key that is 10 cm off, must be fixed instead of recorded.
_LARGEST = {"deg": 10.0, "m": 0.1}


def calibration_from(document: Any) -> CalibrationRecord:
    """Return the record in a document; InvalidCalibration states fault and position."""
    _check_table({"checks": None, **document} if isinstance(document, Mapping) else document, (*_KEYS, "checks"), "")
    valid_days = document["valid_days"]
    if valid_days is not None and (not isinstance(valid_days, int) or not _VALID_DAYS.allows(valid_days)):
        raise InvalidCalibration("valid_days has to be a whole number of days from 1 to 3650, or null.")
    terms = document["terms"]
    _check_table(terms, TERM_NAMES, "terms: ")
    return CalibrationRecord(_text(document["robot"], "robot"), _date(document["date"]), _text(document["by"], "by"),
                             valid_days, _number(_KEY_AHEAD, document["key_ahead_m"], ""),
                             {name: _term(name, terms[name]) for name in TERM_NAMES}, _checks(document))


def _checks(document: Mapping[str, Any]) -> tuple[RobotCheck, ...]:
    entries = document.get("checks", [])
    if not isinstance(entries, list) or len(entries) > _MAX_CHECKS:
        raise InvalidCalibration(f"checks has to be a list of at most {_MAX_CHECKS} entries.")
    return tuple(_check(entry, f"checks {number}: ") for number, entry in enumerate(entries, 1))


def _check(entry: Any, place: str) -> RobotCheck:
    _check_table(entry, _CHECK_KEYS, place)
    return RobotCheck(_text(entry["name"], f"{place}name"), _date(entry["date"]), _text(entry["by"], f"{place}by"),
                      _number(_CHECK_VALUE, entry["value"], place),
                      _number(_CHECK_UNCERTAINTY, entry["uncertainty"], place),
                      _text(entry["source"], f"{place}source"))


def _term(name: str, table: Any) -> CalibratedTerm:
    place = f"{name}: "
    values = {"degrees_of_freedom": None, **table} if isinstance(table, Mapping) else table
    _check_table(values, _TERM_KEYS, place)
    unit = name.rpartition("_")[2]
    largest = _LARGEST[unit]
    value = _number(Limit("value", -largest, largest, unit), values["value"], place)
    uncertainty = _number(Limit("uncertainty", 0.0, largest, unit), values["uncertainty"], place)
    freedom = values["degrees_of_freedom"]
    words = [item.value for item in Distribution]
    if values["distribution"] not in words:
        raise InvalidCalibration(f"{place}distribution has to be one of {', '.join(words)}.")
    return CalibratedTerm(value, uncertainty, Distribution(values["distribution"]),
                          math.inf if freedom is None else _number(_FREEDOM, freedom, place),
                          _text(values["source"], f"{place}source"))


def _check_table(table: Any, keys: tuple[str, ...], place: str) -> None:
    if not isinstance(table, Mapping):
        raise InvalidCalibration(f"{place}it has to consist of lines of the form 'name: value'.")
    missing = [key for key in keys if key not in table]
    if missing:
        raise InvalidCalibration(f"{place}{missing[0]} is missing.")
    unknown = [key for key in table if key not in keys]
    if unknown:
        raise InvalidCalibration(f"{place}{str(unknown[0])[:_MAX_TEXT]!r} is unknown; known are {', '.join(keys)}.")


def _number(limit: Limit, value: Any, place: str) -> float:
    violation = limit.violation(value, place)
    if violation:
        raise InvalidCalibration(violation)
    return float(value)


def _text(value: Any, place: str) -> str:
    if not isinstance(value, str) or not value.strip() or len(value) > _MAX_TEXT or not value.isprintable():
        raise InvalidCalibration(f"{place} has to be a text of 1 to {_MAX_TEXT} characters in one line.")
    return value.strip()


def _date(value: Any) -> datetime.date:
    """Return a date: YAML parses it, JSON contains it as a text."""
    if isinstance(value, datetime.date) and not isinstance(value, datetime.datetime):
        return value
    try:
        return datetime.date.fromisoformat(value)
    except (TypeError, ValueError):
        raise InvalidCalibration("date has to be a day such as 2026-03-01.") from None
