"""Evaluates the estimate of an unknown Car: right, asked about, or wrong."""
# SPDX-License-Identifier: Apache-2.0
import math
from dataclasses import dataclass
from typing import Any, Dict, List, Optional, Sequence, Tuple

import numpy as np

from ...harness.rows import Requirement, Row
from ..methods.errors import percentile
from ..methods.outcome import CarErrors

RIGHT, ASKED, WRONG = "right", "asked", "wrong"
# Published values may be off by these limits, or by this number of their own sigmas.
RIGHT_M, RIGHT_DEG, RIGHT_SIGMAS = 0.03, 0.5, 3.0
FOUND_CARS = Requirement("any Car: found right", "(share)", goal=0.995, must=0.975, at_least=True)
WRONG_CARS = Requirement("any Car: wrong without a word", "(count)", must=0.0)
CLOSE_CARS = Requirement("any Car: centre, length and width within 3 cm, heading within 0.5 deg", "(share)")
# A side that was not seen has the sigma of all ordinary cars; a larger sigma carries no information.
LARGEST_SIGMA = Requirement("any Car: largest sigma of centre, length and width", "m", must=0.87)
SEEN = Requirement("any Car: centre and size in the LiDAR's plane where body is seen, 95 %", "m", must=0.01)


@dataclass(frozen=True)
class CarVerdict:
    """Verdict on one Car; the names are those in the file.

    Attributes:
        verdict: right, asked (the Operator is asked and nothing is published) or wrong.
        sentence: the question, or the wrong values.
        drawn: numbers of the Car and its neighbour.
        errors: None if nothing was published.
    """

    verdict: str
    sentence: str
    drawn: Dict[str, Any]
    errors: Optional[CarErrors] = None


def verdict(errors: CarErrors, drawn: Dict[str, Any]) -> CarVerdict:
    """Return the verdict on the published pose in map and size of the Car."""
    beyond = [f"{name} by {100.0 * abs(error):.1f} cm with a sigma of {100.0 * sigma:.1f}"
              for name, error, sigma in published(errors) if not is_within(error, sigma, RIGHT_M)]
    yaw_sigma_deg = math.degrees(errors.sigmas[2])
    if not is_within(errors.yaw_error_deg, yaw_sigma_deg, RIGHT_DEG):
        beyond.append(f"heading by {errors.yaw_error_deg:.2f} deg with a sigma of {yaw_sigma_deg:.2f}")
    return CarVerdict(WRONG if beyond else RIGHT, ", ".join(beyond), drawn, errors)


def is_within(error: float, sigma: float, limit: float) -> bool:
    """Return True if an error is within the limit or its sigmas; NaN or an infinite sigma is not."""
    return math.isfinite(sigma) and abs(error) <= max(limit, RIGHT_SIGMAS * sigma)


def is_close(errors: CarErrors) -> bool:
    """Return True if the estimate is within the limits whatever its sigmas are."""
    return errors.yaw_error_deg <= RIGHT_DEG and all(abs(error) <= RIGHT_M for _, error, _ in published(errors))


def published(errors: CarErrors) -> List[Tuple[str, float, float]]:
    """Return name, error and sigma in m of the published place and size."""
    return [("centre along", errors.along_error_m, errors.sigmas[0]),
            ("centre across", errors.across_error_m, errors.sigmas[1]),
            ("length", errors.length_error_body_m, errors.length_sigma_m),
            ("width", errors.width_error_body_m, errors.width_sigma_m)]


def errors_where_seen(errors: CarErrors) -> List[float]:
    """Return errors of centre and size in the LiDAR plane: along the Car if both ends were seen, across it if both
    sides were."""
    along = [errors.along_error_m, errors.length_error_m] if errors.length_plane_sigma_m else []
    return along + ([errors.across_error_m, errors.width_error_m] if errors.width_plane_sigma_m else [])


def rows(verdicts: Sequence[CarVerdict], failed_drives: int = 0, repeated: int = 0) -> List[Row]:
    """Return the rows. No row is met if a drive failed, or without Cars."""
    counts = {each: sum(one.verdict == each for one in verdicts) for each in (RIGHT, ASKED, WRONG)}
    details: Dict[str, Optional[float]] = {"failed_drives": failed_drives, "repeated_drives": repeated}
    is_complete = bool(verdicts) and not failed_drives
    told = f"{counts[RIGHT]} of {len(verdicts)} right, {counts[ASKED]} asked about" + (
        f", {failed_drives} drives failed" if failed_drives else "") + (
        f", {repeated} drives repeated" if repeated else "")
    estimates = [one.errors for one in verdicts if one.errors]
    close = sum(is_close(each) for each in estimates)
    sigmas_m = [sigma for each in estimates for _, _, sigma in published(each)]
    body = [one.errors for one in verdicts if one.errors and not one.errors.only_wheels]
    seen_m = np.abs([value for each in body for value in errors_where_seen(each)])
    return [Row(FOUND_CARS, counts[RIGHT] / len(verdicts) if verdicts else None, is_complete, details, told),
            Row(CLOSE_CARS, close / len(verdicts) if verdicts else None, is_complete, details,
                f"{close} of {len(verdicts)}; the other right ones by their sigmas"),
            Row(LARGEST_SIGMA, float(np.max(sigmas_m)) if sigmas_m else None, is_complete, details),
            Row(WRONG_CARS, counts[WRONG] if verdicts else None, is_complete, details),
            Row(SEEN, percentile(seen_m), is_complete, details, f"{len(body)} Cars")]
