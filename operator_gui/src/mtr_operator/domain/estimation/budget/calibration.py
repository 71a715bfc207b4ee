"""Calibration record of a robot: its possible deviations from the drawing that its own sensors cannot detect."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import dataclasses
import datetime
import enum
import math
from dataclasses import dataclass
from typing import Any

MAST_LEAN, FLOOR_SLOPE, KEY_LEVER, LIDAR_YAW = "mast_lean_deg", "floor_slope_deg", "key_lever_m", "lidar_yaw_deg"
# Names of the terms that each record must contain.
TERM_NAMES = (MAST_LEAN, FLOOR_SLOPE, KEY_LEVER, LIDAR_YAW)
# Checks with an effect other than terms: tape measure less reported height, and the least strength of a press to which
# the Car reacted each time.
LIFT_HEIGHT, PRESS_STRENGTH = "lift_height_m", "press_strength"


class Distribution(enum.Enum):
    """Distribution of an error. Its uncertainty is 1 sigma of a normal one, half the width of the others."""

    NORMAL = "normal"
    RECTANGULAR = "rectangular"
    TRIANGULAR = "triangular"

    @property
    def sigma_per_uncertainty(self) -> float:
        """Sigma per uncertainty, GUM 4.3.7 and 4.3.9."""
        return {Distribution.NORMAL: 1.0, Distribution.RECTANGULAR: 1.0 / math.sqrt(3.0),
                Distribution.TRIANGULAR: 1.0 / math.sqrt(6.0)}[self]


@dataclass(frozen=True)
class CalibratedTerm:
    """Error of the robot, in the unit of its name's suffix.

    Attributes:
        value: known error that is not corrected at its source; it counts in full.
        uncertainty: see Distribution.
        degrees_of_freedom: infinite without a statistic.
        source: method of determination.
    """

    value: float
    uncertainty: float
    distribution: Distribution
    degrees_of_freedom: float
    source: str

    @property
    def sigma(self) -> float:
        """Standard uncertainty, including the known but uncorrected error (GUM F.2.4.5)."""
        return math.hypot(self.uncertainty * self.distribution.sigma_per_uncertainty, self.value)


@dataclass(frozen=True)
class RobotCheck:
    """Measurement at the robot, in the unit of its name's suffix; scales are dimensionless.

    Attributes:
        name: of a term, or of a quantity outside the budget: wheel_scale, gyro_scale, lift_height_m, press_force_n,
            press_strength.
        made: date. by: person. uncertainty: 1 sigma. source: method of determination.
    """

    name: str
    made: datetime.date
    by: str
    value: float
    uncertainty: float
    source: str

    def to_document(self) -> dict[str, Any]:
        """Return plain values as in the file."""
        return {"name": self.name, "date": self.made.isoformat(), "by": self.by, "value": self.value,
                "uncertainty": self.uncertainty, "source": self.source}


@dataclass(frozen=True)
class CalibrationRecord:
    """Calibration of a robot. Attributes: robot: its name. made: date. by: person. valid_days: None for unlimited.
    key_ahead_m: of base_link.

    terms: by their names, all of TERM_NAMES. checks: recorded measurements.
    """

    robot: str
    made: datetime.date
    by: str
    valid_days: int | None
    key_ahead_m: float
    terms: dict[str, CalibratedTerm]
    checks: tuple[RobotCheck, ...] = ()

    def check_named(self, name: str) -> RobotCheck | None:
        """Return the last measurement of this name; None without one."""
        return next((check for check in reversed(self.checks) if check.name == name), None)

    @property
    def key_height_offset_m(self) -> float:
        """Excess of the key's height over the reported one, by a tape measure; 0 if it was not measured."""
        check = self.check_named(LIFT_HEIGHT)
        return 0.0 if check is None else check.value

    def cautions(self, parameters: object, today: datetime.date) -> tuple[str, ...]:
        """Return sentences on objections to a test with these parameters today: expired record, too weak press."""
        strength = getattr(parameters, "press_strength", None)
        weak = "" if strength is None else self._press_caution(strength)
        return tuple(filter(None, (self.warning(today), weak)))

    def _press_caution(self, strength: float) -> str:
        check = self.check_named(PRESS_STRENGTH)
        if check is None or strength >= check.value:
            return ""
        return (f"Parameter press_strength is {strength:g}; at the calibration of {check.made.isoformat()} the Car "
                f"answered from {check.value:g} on. Press at least as strongly, or calibrate again.")

    def warning(self, today: datetime.date) -> str:
        """Return a sentence if the record is outdated, else empty."""
        age_days = (today - self.made).days
        if self.valid_days is not None and age_days > self.valid_days:
            return (f"The robot's calibration record of {self.made.isoformat()} is {age_days} days old; it was valid "
                    f"for {self.valid_days} days. Calibrate the robot again, or doubt the uncertainties.")
        return next((sentence for check in self.checks if (sentence := self._overdue(check, today))), "")

    def _overdue(self, check: RobotCheck, today: datetime.date) -> str:
        age_days = (today - check.made).days
        if self.valid_days is None or age_days <= self.valid_days:
            return ""
        return (f"The robot's {check.name} was measured {age_days} days ago; it was valid for {self.valid_days} days. "
                "Calibrate the robot again.")

    def to_document(self) -> dict[str, Any]:
        """Return plain values as in the file."""
        terms = {}
        for name, term in self.terms.items():
            values = {**dataclasses.asdict(term), "distribution": term.distribution.value}
            if math.isinf(term.degrees_of_freedom):
                del values["degrees_of_freedom"]
            terms[name] = values
        document = {"robot": self.robot, "date": self.made.isoformat(), "by": self.by, "valid_days": self.valid_days,
                    "key_ahead_m": self.key_ahead_m, "terms": terms}
        return {**document, "checks": [check.to_document() for check in self.checks]} if self.checks else document
