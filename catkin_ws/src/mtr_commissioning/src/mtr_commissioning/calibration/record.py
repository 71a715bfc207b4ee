"""Calibration record for the budget of distances, from the measurements; plain values in and out.

Format: docs/operator/limits.md, Calibration record. Terms without a measurement keep the values of the design. `date`
is the date of the oldest measurement that a term relies on; `checks` lists each measurement with its own date.
"""
# SPDX-License-Identifier: Apache-2.0
import datetime
import math
from dataclasses import dataclass
from typing import Any, Dict, List, Mapping, Optional, Tuple

from .readings import Estimate, ReadingsUnusable

VALID_DAYS = 365
LEVER, MAST, LIDAR_YAW = "key_lever_m", "mast_lean_deg", "lidar_yaw_deg"
# Larger values are rejected: the robot must be fixed instead.
LARGEST = {LEVER: 0.1, MAST: 10.0, LIDAR_YAW: 10.0}
# Tolerance for equal key positions in two descriptions; both are written to the micrometre.
SAME_M = 1e-6
# Terms of the design, as in operator_gui's calibration/default.yaml.
DESIGN_TERMS: Dict[str, Dict[str, Any]] = {
    MAST: {"value": 0.0, "uncertainty": 0.5, "distribution": "rectangular", "source": "spirit level of 0.5 degrees"},
    "floor_slope_deg": {"value": 0.0, "uncertainty": 0.5, "distribution": "rectangular",
                        "source": "unevenness of a floor that looks level"},
    LEVER: {"value": 0.0, "uncertainty": 0.005, "distribution": "rectangular", "source": "fitted by hand with a rule"},
    LIDAR_YAW: {"value": 0.0, "uncertainty": 1.0, "distribution": "rectangular", "source": "play of its screws"}}


@dataclass(frozen=True)
class Origin:
    """Robot and person of a measurement, and the key's distance ahead of base_link by its URDF, m."""

    robot: str
    by: str
    key_ahead_m: float


@dataclass(frozen=True)
class Check:
    """One measurement.

    Attributes:
        name: key_lever_m, mast_lean_deg, lidar_yaw_deg, wheel_scale, gyro_scale, lift_height_m, press_force_n,
            mass_kg or a parameter of drive control: a promise.
        estimate: in the unit of the name's suffix; scales are dimensionless.
        how: method in some words.
    """

    name: str
    estimate: Estimate
    how: str

    def entry(self, today: datetime.date, by: str) -> Dict[str, Any]:
        """Return plain values."""
        return {"name": self.name, "date": today.isoformat(), "by": by, "value": round(self.estimate.value, 6),
                "uncertainty": round(self.estimate.sigma, 6), "source": self.how}


def refuse_another(document: Mapping[str, Any], robot: str) -> None:
    """Raise ReadingsUnusable if the record belongs to another robot."""
    if document["robot"] != robot:
        raise ReadingsUnusable(f"The record is of the robot {document['robot']}, not of {robot}; name a file for "
                               f"{robot} with --record.")


def continued(document: Mapping[str, Any], key_ahead_m: float) -> Tuple[Dict[str, Any], str]:
    """Return the part of the record that is valid with this key position, and a sentence about the invalid part or
    empty.

    The lever is relative to the description, so it becomes invalid when the description changes.
    """
    before_m, now_m = float(document["key_ahead_m"]), round(key_ahead_m, 6)
    if math.isclose(before_m, now_m, abs_tol=SAME_M):
        return dict(document), ""
    terms = {**document["terms"], LEVER: DESIGN_TERMS[LEVER]}
    checks = [each for each in document.get("checks", []) if each["name"] != LEVER]
    return ({**document, "key_ahead_m": now_m, "terms": terms, "checks": checks},
            f"The description has the key {now_m:g} m ahead, where the record had {before_m:g} m: {LEVER} counts as "
            "never measured. Measure it (calibrate lever).")


def updated(document: Optional[Mapping[str, Any]], origin: Origin, check: Check,
            today: datetime.date) -> Dict[str, Any]:
    """Return the record with today's measurement.

    Args:
        document: previous record; None for a robot without one.

    Raises:
        ReadingsUnusable: the error is too large to be recorded, or the record belongs to another robot.
    """
    before: Dict[str, Any] = {}
    if document is not None:
        refuse_another(document, origin.robot)
        before, _ = continued(document, origin.key_ahead_m)
    checks: List[Dict[str, Any]] = [each for each in before.get("checks", []) if each["name"] != check.name]
    checks.append(check.entry(today, origin.by))
    terms = {**DESIGN_TERMS, **before.get("terms", {})}
    if check.name in terms:
        terms[check.name] = _term(check)
    days = [str(each["date"]) for each in checks if each["name"] in terms] or [today.isoformat()]
    return {"robot": origin.robot, "date": min(days), "by": origin.by,
            "valid_days": before.get("valid_days", VALID_DAYS), "key_ahead_m": round(origin.key_ahead_m, 6),
            "terms": terms, "checks": checks}


def _term(check: Check) -> Dict[str, Any]:
    largest, estimate = LARGEST[check.name], check.estimate
    if abs(estimate.value) > largest:
        raise ReadingsUnusable(f"{check.name} is {estimate.value:.3f}; at most {largest:g} is recorded. Correct the "
                               "URDF, or mend the robot, and measure again.")
    term = {"value": round(estimate.value, 6), "uncertainty": round(estimate.sigma, 6), "distribution": "normal",
            "source": check.how}
    if not math.isinf(estimate.freedom):
        term["degrees_of_freedom"] = estimate.freedom
    return term


def overdue(document: Mapping[str, Any], today: datetime.date) -> List[str]:
    """Return a sentence for each measurement that is too old, and for each term without a measurement."""
    valid_days = document["valid_days"]
    measured = {each["name"] for each in document.get("checks", [])}
    sentences = [f"{name} was never measured; the design's counts." for name in document["terms"]
                 if name in LARGEST and name not in measured]
    for each in document.get("checks", []):
        age_days = (today - datetime.date.fromisoformat(str(each["date"]))).days
        if valid_days is not None and age_days > valid_days:
            sentences.append(f"{each['name']} was measured {age_days} days ago; it is valid for {valid_days} days. "
                             "Measure it again.")
    return sentences
