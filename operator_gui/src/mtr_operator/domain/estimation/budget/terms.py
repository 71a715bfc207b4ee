"""Parts of the uncertainty of one distance: terms with their sensitivities, along the line."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import math
from dataclasses import dataclass

from ...geometry.outline import SideError
from .calibration import FLOOR_SLOPE, KEY_LEVER, LIDAR_YAW, MAST_LEAN, CalibrationRecord, Distribution

_RAD_PER_DEG = math.pi / 180.0
STATUS, CAR_MAP, PRESSES = "robot's Status and the Car's bus", "robot's map of the Car", "attempts of the test"
CALIBRATION = "calibration record of"
# Terms that differ between the lines; all others are the same error on every line.
_OWN_OF_RECORD = (FLOOR_SLOPE,)


@dataclass(frozen=True)
class Term:
    """Source of error of a distance.

    Attributes:
        name: of the source; a common term on two lines is the same error.
        sigma: standard uncertainty, in unit. uncertainty, distribution: as recorded, see Distribution. sensitivity: m
        of distance per unit.
        is_common: the error is the same on all lines, except for its sensitivity.
    """

    name: str
    value: float
    uncertainty: float
    unit: str
    distribution: Distribution
    degrees_of_freedom: float
    sensitivity: float
    sigma: float
    source: str
    is_common: bool

    @property
    def contribution_m(self) -> float:
        """Part of the distance's standard uncertainty, without sign."""
        return abs(self.sensitivity) * self.sigma


@dataclass(frozen=True)
class Carriage:
    """Position of the carried key at a measurement. direction: unit vector of the line, away from the Car."""

    direction: tuple[float, float]
    key_height_m: float
    heading_offset_rad: float = 0.0


@dataclass(frozen=True)
class Measurement:
    """Standard uncertainties of one distance from its own measurement, in m; 0 for an absent part.

    place_m: position and time of the key. attempts_m: uncertainty that remains after the attempts.
    outline_m: of the Car's length and width, half of which may shift the line's origin; (0, 0) for lines from the
    centre, and if the sides are known.
    sides: of the Car where the line begins; place_m then excludes them.
    timing_m: common uncertainty of all lines' distances of this word, from the Car's timing.
    """

    place_m: float
    attempts_m: float
    outline_m: tuple[float, float]
    timing_m: float = 0.0
    word: str = ""
    sides: tuple[SideError, ...] = ()


def terms_of(measurement: Measurement, carriage: Carriage, record: CalibrationRecord) -> tuple[Term, ...]:
    """Return all terms of a distance of a robot that faces the Car."""
    half_x, half_y = (component / 2.0 for component in carriage.direction)
    own = (_measured("place and instant of the key", measurement.place_m, 1.0, STATUS, is_common=False),
           _measured("attempts", measurement.attempts_m, 1.0, PRESSES, is_common=False),
           _measured("length of the Car", measurement.outline_m[0], half_x, CAR_MAP, is_common=True),
           _measured("width of the Car", measurement.outline_m[1], half_y, CAR_MAP, is_common=True))
    sides = tuple(_measured(f"{side.side} of the Car", side.sigma_m, side.share, CAR_MAP, is_common=True)
                  for side in measurement.sides)
    measured = tuple(term for term in (*own, *sides) if term.sigma > 0.0)
    return measured + _of_timing(measurement) + _of_record(carriage, record)


def _measured(name: str, sigma_m: float, sensitivity: float, source: str, is_common: bool) -> Term:
    return Term(name, 0.0, sigma_m, "m", Distribution.NORMAL, math.inf, sensitivity, sigma_m, source, is_common)


def _of_timing(measurement: Measurement) -> tuple[Term, ...]:
    """Return the timing term, an error common to all lines in its own sigmas; the effect depends on the speeds of a
    line's passes."""
    if measurement.timing_m == 0.0:
        return ()
    return (Term(f"timing of the Car, {measurement.word}", 0.0, 1.0, "sigma", Distribution.NORMAL, math.inf,
                 measurement.timing_m, 1.0, PRESSES, is_common=True),)


def _of_record(carriage: Carriage, record: CalibrationRecord) -> tuple[Term, ...]:
    """Return the record's terms: a mast that leans towards the Car shifts the key by its height, a LiDAR yaw turns its
    lever."""
    height_m = carriage.key_height_m + record.key_height_offset_m
    sensitivities = {
        MAST_LEAN: -height_m * _RAD_PER_DEG,
        FLOOR_SLOPE: -height_m * _RAD_PER_DEG,
        KEY_LEVER: -math.cos(carriage.heading_offset_rad),
        LIDAR_YAW: record.key_ahead_m * math.sin(carriage.heading_offset_rad) * _RAD_PER_DEG}
    source = f"{CALIBRATION} {record.made.isoformat()}"
    return tuple(Term(name, term.value, term.uncertainty, name.rpartition("_")[2], term.distribution,
                      term.degrees_of_freedom, sensitivities[name], term.sigma, f"{source}: {term.source}",
                      name not in _OWN_OF_RECORD)
                 for name, term in record.terms.items())
