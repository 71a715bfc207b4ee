"""Limits of the numbers that come from outside, from the robot or from a file: one table for every border.

What lies beyond them cannot be true; nothing is computed with it. NaN and infinity are beyond all of them. Numbers are
in SI units; whoever converts does it before.
"""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Iterable


@dataclass(frozen=True)
class Limit:
    """Allowed range of a number, ends included. name: as it stands in a sentence."""

    name: str
    low: float
    high: float
    unit: str = ""

    def allows(self, value: object) -> bool:
        """True for a number within the range."""
        return (isinstance(value, (int, float)) and not isinstance(value, bool)
                and self.low <= value <= self.high)

    def violation(self, value: object, of: str = "") -> str:
        """Sentence with value and range when the number is beyond them, else empty. of: what it belongs to."""
        if self.allows(value):
            return ""
        unit = f" {self.unit}" if self.unit else ""
        return (f"{of}{self.name} is {_shown(value)}{unit}; allowed is {self.low:g} to {self.high:g}{unit}.")


def first_violation(values: Iterable[tuple[Limit, object]], of: str = "") -> str:
    """Sentence about the first number beyond its limit, empty when there is none."""
    for limit, value in values:
        if not limit.allows(value):
            return limit.violation(value, of)
    return ""


def _shown(value: object) -> str:
    if isinstance(value, float) or (isinstance(value, int) and not isinstance(value, bool) and abs(value) < 1e15):
        return f"{value:g}"
    return f"{str(value)[:40]!r}" if isinstance(value, str) else f"no number in range ({type(value).__name__})"


# Cars, vans and the smallest trailer that has locks; a bus is 12 to 25 m long.
CAR_LENGTH = Limit("length of the Car", 1.0, 30.0, "m")
CAR_WIDTH = Limit("width of the Car", 0.5, 5.0, "m")
CAR_SIGMA = Limit("uncertainty of the Car's size", 0.0, 5.0, "m")
OUTLINE = Limit("coordinate of the Car's outline", -30.0, 30.0, "m")
MAX_OUTLINE_POINTS = 1000

# A test area is some ten metres across; the robot refuses waypoints beyond 100 m.
COORDINATE = Limit("position", -1000.0, 1000.0, "m")
# Two turns: a heading may be wound up a little.
HEADING = Limit("heading", -4.0 * math.pi, 4.0 * math.pi, "rad")
CORRECTION = Limit("correction of the Car's frame", -100.0, 100.0, "m")
# A pose without any doubt is not measured: a thousandth of a millimetre is better than any instrument here.
POSITION_SIGMA = Limit("uncertainty of the position", 1e-6, 100.0, "m")
HEADING_SIGMA = Limit("uncertainty of the heading", 1e-6, 2.0 * math.pi, "rad")
VARIANCE = Limit("variance of the position", 0.0, 1e4, "m2")
COVARIANCE = Limit("covariance of the position", -1e4, 1e4, "m2")
# Three times the fastest platform, and one turn in a third of a second.
SPEED = Limit("speed", -6.0, 6.0, "m/s")
YAW_RATE = Limit("turning rate", -20.0, 20.0, "rad/s")
# The highest supported mast reaches 3 m; the floor may be uneven.
KEY_HEIGHT = Limit("height of the Remote key", -0.5, 5.0, "m")
KEY_OFFSET = Limit("place of the Remote key on the robot", -3.0, 3.0, "m")
BATTERY = Limit("charge of the battery", 0, 100, "%")

# Clocks count from the robot's start or from 1970; the end of the range is in the year 2096.
STAMP = Limit("time", 0.0, 4e9, "s")
CHECK_DIFFERENCE = Limit("difference found by the check of the Car", 0.0, 1000.0)

# Results of lines in files.
DISTANCE = Limit("distance", -30.0, 1000.0, "m")
DISTANCE_SIGMA = Limit("uncertainty of the distance", 0.0, 10.0, "m")
LINE_NUMBER = Limit("number of the line", 1, 100_000)

# Columns of results by their unit, where nothing narrower is known; without one a number counts or is a direction.
OF_UNIT = {"m": DISTANCE, "s": STAMP, "deg": Limit("angle", -720.0, 720.0, "deg"), "m/s": SPEED}
PLAIN = Limit("number", -1e6, 1e6)
