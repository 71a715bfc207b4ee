"""The calibration record as the budget of distances reads it, from what was measured; plain values in and out.

Format: docs/operator/limits.md, Calibration record. What is not measured yet stays as the design has it.
`date` is the day of the oldest measurement that a term rests on; each measurement stands with its own day in `checks`.
"""
# SPDX-License-Identifier: Apache-2.0
import datetime
import math
from dataclasses import dataclass
from typing import Any, Dict, List, Mapping, Optional, Tuple

from .readings import Estimate, ReadingsUnusable

VALID_DAYS = 365
LEVER, MAST, LIDAR_YAW = "key_lever_m", "mast_lean_deg", "lidar_yaw_deg"
# Beyond it the record is refused: something is to be mended, and not to be recorded.
LARGEST = {LEVER: 0.1, MAST: 10.0, LIDAR_YAW: 10.0}
# Keys of two descriptions are in one place; both are written to the micrometre.
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
    """Which robot it is, who measures, and how far its key is before base_link by its URDF, m."""

    robot: str
    by: str
    key_ahead_m: float


@dataclass(frozen=True)
class Check:
    """One thing that was measured.

    Attributes:
        name: key_lever_m, mast_lean_deg, lidar_yaw_deg, wheel_scale, gyro_scale, lift_height_m, press_force_n,
            mass_kg or a parameter of drive control: a promise.
        estimate: in the unit that its name ends with, scales without.
        how: what was done, in some words.
    """

    name: str
    estimate: Estimate
    how: str

    def entry(self, today: datetime.date, by: str) -> Dict[str, Any]:
        """Plain values."""
        return {"name": self.name, "date": today.isoformat(), "by": by, "value": round(self.estimate.value, 6),
                "uncertainty": round(self.estimate.sigma, 6), "source": self.how}


def refuse_another(document: Mapping[str, Any], robot: str) -> None:
    """Raise ReadingsUnusable when the record is not that robot's."""
    if document["robot"] != robot:
        raise ReadingsUnusable(f"The record is of the robot {document['robot']}, not of {robot}; name a file for "
                               f"{robot} with --record.")


def continued(document: Mapping[str, Any], key_ahead_m: float) -> Tuple[Dict[str, Any], str]:
    """The record as far as it holds with a key so far before base_link, and a sentence about what does not; empty: all.

    The lever is measured against the description, so that it ends with the description that it was measured against.
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
    """The record with what was measured today.

    Args:
        document: as before; None for a robot that has none.

    Raises:
        ReadingsUnusable: the error is too large to be recorded, or the record another robot's.
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
    """A sentence for each measurement that is too old, and for each term that nobody has measured."""
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
