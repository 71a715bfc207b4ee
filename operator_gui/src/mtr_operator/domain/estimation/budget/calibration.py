"""The calibration record of a robot: how far it may be from its drawing, where no sensor of its own tells."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import dataclasses
import datetime
import enum
import math
from dataclasses import dataclass
from typing import Any

MAST_LEAN, FLOOR_SLOPE, KEY_LEVER, LIDAR_YAW = "mast_lean_deg", "floor_slope_deg", "key_lever_m", "lidar_yaw_deg"
# Every record has all of them.
TERM_NAMES = (MAST_LEAN, FLOOR_SLOPE, KEY_LEVER, LIDAR_YAW)


class Distribution(enum.Enum):
    """Of an error; what its uncertainty is: 1 sigma of a normal one, half the width of the others."""

    NORMAL = "normal"
    RECTANGULAR = "rectangular"
    TRIANGULAR = "triangular"

    @property
    def sigma_per_uncertainty(self) -> float:
        """GUM 4.3.7 and 4.3.9."""
        return {Distribution.NORMAL: 1.0, Distribution.RECTANGULAR: 1.0 / math.sqrt(3.0),
                Distribution.TRIANGULAR: 1.0 / math.sqrt(6.0)}[self]


@dataclass(frozen=True)
class CalibratedTerm:
    """One error of the robot, in the unit that its name ends with.

    Attributes:
        value: what is known of it and not corrected at its home; it counts in full.
        uncertainty: see Distribution.
        degrees_of_freedom: infinite where it is no statistic.
        source: how it was found.
    """

    value: float
    uncertainty: float
    distribution: Distribution
    degrees_of_freedom: float
    source: str

    @property
    def sigma(self) -> float:
        """Standard uncertainty, with what is known and not corrected (GUM F.2.4.5)."""
        return math.hypot(self.uncertainty * self.distribution.sigma_per_uncertainty, self.value)


@dataclass(frozen=True)
class CalibrationRecord:
    """Attributes: robot: which one. made: date. by: who. valid_days: None without end. key_ahead_m: of base_link.

    terms: by their names, all of TERM_NAMES.
    """

    robot: str
    made: datetime.date
    by: str
    valid_days: int | None
    key_ahead_m: float
    terms: dict[str, CalibratedTerm]

    def warning(self, today: datetime.date) -> str:
        """Sentence when the record is not of today's robot any more, else empty."""
        age_days = (today - self.made).days
        if self.valid_days is not None and age_days > self.valid_days:
            return (f"The robot's calibration record of {self.made.isoformat()} is {age_days} days old; it was valid "
                    f"for {self.valid_days} days. Calibrate the robot again, or doubt the uncertainties.")
        return ""

    def to_document(self) -> dict[str, Any]:
        """Plain values as in the file."""
        terms = {}
        for name, term in self.terms.items():
            values = {**dataclasses.asdict(term), "distribution": term.distribution.value}
            if math.isinf(term.degrees_of_freedom):
                del values["degrees_of_freedom"]
            terms[name] = values
        return {"robot": self.robot, "date": self.made.isoformat(), "by": self.by, "valid_days": self.valid_days,
                "key_ahead_m": self.key_ahead_m, "terms": terms}
