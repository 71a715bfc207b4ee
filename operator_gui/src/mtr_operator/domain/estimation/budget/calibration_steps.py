"""Converts a person's readings of rule and tape measure to terms and checks of a calibration record."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import dataclasses
import datetime
import math
import statistics
from dataclasses import dataclass
from typing import Sequence

from ...errors import InvalidCalibration
from .calibration import (
    KEY_LEVER,
    LIFT_HEIGHT,
    PRESS_STRENGTH,
    CalibratedTerm,
    CalibrationRecord,
    Distribution,
    RobotCheck,
)

# With fewer readings their spread is unknown.
MIN_READINGS = 3
# Rule with millimetre marks, its mark and the plumb line: half the width of a rectangular distribution, GUM 4.3.7.
_RULE_HALF_M = 0.001
# Readings of one quantity that differ by more than this are reading or typing errors.
_MAX_RANGE_M = 0.02
_MAX_AXLES_RANGE_M = 0.01
# Heights that are closer together do not test the lift's travel.
_MIN_SPAN_M = 0.3
_MM_PER_M, _CM_PER_M = 1000.0, 100.0


@dataclass(frozen=True)
class Found:
    """Mean of readings in m, and the standard deviation of one reading."""

    count: int
    mean_m: float
    spread_m: float

    @property
    def sigma_m(self) -> float:
        """Standard uncertainty of the mean, including the rule's."""
        return math.hypot(self.spread_m / math.sqrt(self.count), _RULE_HALF_M / math.sqrt(3.0))


@dataclass(frozen=True)
class Signed:
    """Person and date of a step."""

    made: datetime.date
    by: str


def found_from(readings_m: Sequence[float]) -> Found:
    """Evaluate readings of one quantity; InvalidCalibration if they are too few, or inconsistent."""
    if len(readings_m) < MIN_READINGS:
        raise InvalidCalibration(f"There are {len(readings_m)} readings; give at least {MIN_READINGS}.")
    range_m = max(readings_m) - min(readings_m)
    if range_m > _MAX_RANGE_M:
        raise InvalidCalibration(f"The readings differ by {range_m * _MM_PER_M:.0f} mm; allowed is "
                                 f"{_MAX_RANGE_M * _MM_PER_M:.0f} mm. Read them again.")
    return Found(len(readings_m), statistics.fmean(readings_m), statistics.stdev(readings_m))


def lever_from(front_m: Sequence[float], rear_m: Sequence[float]) -> Found:
    """Return the key's distance ahead of base_link, which lies midway between the axles, from its distances ahead of
    both axles. InvalidCalibration if the readings are inconsistent."""
    if len(front_m) != len(rear_m):
        raise InvalidCalibration(f"There are {len(front_m)} readings to the front axle and {len(rear_m)} to the rear "
                                 "one; give as many of both.")
    found = found_from([(front + rear) / 2.0 for front, rear in zip(front_m, rear_m)])
    apart_m = [rear - front for front, rear in zip(front_m, rear_m)]
    range_m = max(apart_m) - min(apart_m)
    if range_m > _MAX_AXLES_RANGE_M:
        raise InvalidCalibration(f"The distance between the axles differs by {range_m * _MM_PER_M:.0f} mm between the "
                                 f"readings; allowed is {_MAX_AXLES_RANGE_M * _MM_PER_M:.0f} mm. Read them again.")
    return found


def height_from(pairs_m: Sequence[tuple[float, float]]) -> Found:
    """Return the excess of the key's height over the reported one, from tape measure and reported heights.
    InvalidCalibration if the readings are insufficient or inconsistent."""
    found = found_from([tape_m - reported_m for tape_m, reported_m in pairs_m])
    reported = [reported_m for _, reported_m in pairs_m]
    span_m = max(reported) - min(reported)
    if span_m < _MIN_SPAN_M:
        raise InvalidCalibration(f"The heights are {span_m * _CM_PER_M:.0f} cm apart; give some that are at least "
                                 f"{_MIN_SPAN_M * _CM_PER_M:.0f} cm apart.")
    return found


def with_lever(record: CalibrationRecord, found: Found, stated_m: float, signed: Signed) -> CalibrationRecord:
    """Return the record with this lever; stated_m: the lever in the robot's description. The difference is known but
    not corrected, and counts in full until the description is fixed."""
    how, off_m = f"rule to both axles, {found.count} readings", found.mean_m - stated_m
    term = CalibratedTerm(round(off_m, 6), round(found.sigma_m, 6), Distribution.NORMAL, found.count - 1.0, how)
    changed = dataclasses.replace(record, key_ahead_m=stated_m, terms={**record.terms, KEY_LEVER: term})
    return _with_check(changed, KEY_LEVER, (off_m, found.sigma_m, how), signed)


def with_height(record: CalibrationRecord, found: Found, signed: Signed) -> CalibrationRecord:
    """Return the record with the excess of the key's height over the reported one."""
    how = f"tape measure at {found.count} heights"
    return _with_check(record, LIFT_HEIGHT, (found.mean_m, found.sigma_m, how), signed)


def with_press(record: CalibrationRecord, strength: float, step: float, presses: int,
               signed: Signed) -> CalibrationRecord:
    """Return the record with the least strength at which the Car reacted each time; step: of the search."""
    how = f"answers of the Car, {presses} presses in steps of {step:g}"
    return _with_check(record, PRESS_STRENGTH, (strength, step / math.sqrt(12.0), how), signed)


def _with_check(record: CalibrationRecord, name: str, told: tuple[float, float, str],
                signed: Signed) -> CalibrationRecord:
    """Add a check. told: value, 1 sigma, and source. The record is as old as the oldest check that a term relies on."""
    value, sigma, how = told
    check = RobotCheck(name, signed.made, signed.by, round(value, 6), round(sigma, 6), how)
    checks = (*(each for each in record.checks if each.name != name), check)
    days = [each.made for each in checks if each.name in record.terms]
    return dataclasses.replace(record, made=min(days, default=record.made), checks=checks)
