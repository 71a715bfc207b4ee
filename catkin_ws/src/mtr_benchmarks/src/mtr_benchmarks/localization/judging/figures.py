"""Figures of one method over many drives."""
# SPDX-License-Identifier: Apache-2.0
import math
from dataclasses import dataclass
from typing import Optional, Sequence

import numpy as np

from mtr_core.arrays import FloatArray

from ..methods.errors import PoseErrors, percentile
from ..methods.outcome import CarErrors, MethodOutcome

NEAR_M, FAR_OUT_M = 5.0, 9.0
DIMENSIONS = 3
# 95 % quantile of a chi-square distribution with three degrees of freedom.
CHI_SQUARE_95 = 7.815


@dataclass(frozen=True)
class SceneFigures:
    """Figures of one method in one scene over all rows of all drives. The names are those in the file; None: unknown.

    Attributes:
        online_*, moving_*, standstill_*: errors of the key's position; p95: 95 %.
        standstill_near, standstill_10m: within NEAR_M of the Car, and from FAR_OUT_M on.
        unknown_share: share of the time without a valid pose.
        car_*, length_*, width_*: 95 % of the errors of the Car.
        nees_ratio: see `ratio`; nees_within_95_share: share of the poses within their 95 % bound.
    """

    drives: int
    online_rmse_m: Optional[float]
    online_p95_m: Optional[float]
    online_max_m: Optional[float]
    moving_p95_m: Optional[float]
    standstill_p95_m: Optional[float]
    standstill_near_p95_m: Optional[float]
    standstill_10m_p95_m: Optional[float]
    yaw_p95_deg: Optional[float]
    unknown_share: Optional[float]
    car_pose_p95_m: Optional[float]
    car_yaw_p95_deg: Optional[float]
    length_error_m: Optional[float]
    width_error_m: Optional[float]
    length_error_body_m: Optional[float]
    width_error_body_m: Optional[float]
    nees_ratio: Optional[float]
    nees_within_95_share: Optional[float]
    cpu_ms_per_scan: Optional[float]


def scene_figures(outcomes: Sequence[MethodOutcome]) -> SceneFigures:
    """Return the figures of these drives."""
    errors = joined([each.errors for each in outcomes])
    standing = errors.standing
    cars = [each.car for each in outcomes if each.car]
    measured = [car for car in cars if not car.only_wheels]
    return SceneFigures(
        drives=len(outcomes),
        online_rmse_m=root_mean_square(errors.key_m),
        online_p95_m=percentile(errors.key_m),
        online_max_m=percentile(errors.key_m, 100.0),
        moving_p95_m=percentile(errors.key_m[errors.on_axis]),
        standstill_p95_m=percentile(errors.key_m[standing]),
        standstill_near_p95_m=percentile(errors.key_m[standing & (errors.beyond_m <= NEAR_M)]),
        standstill_10m_p95_m=percentile(errors.key_m[standing & (errors.beyond_m >= FAR_OUT_M)]),
        yaw_p95_deg=percentile(np.abs(errors.yaw_deg[standing])),
        unknown_share=float(np.mean(np.isnan(errors.key_m))) if len(errors.key_m) else None,
        car_pose_p95_m=percentile(column(cars, "position_error_m")),
        car_yaw_p95_deg=percentile(column(cars, "yaw_error_deg")),
        length_error_m=percentile(np.abs(column(measured, "length_error_m"))),
        width_error_m=percentile(np.abs(column(measured, "width_error_m"))),
        length_error_body_m=percentile(np.abs(column(measured, "length_error_body_m"))),
        width_error_body_m=percentile(np.abs(column(measured, "width_error_body_m"))),
        nees_ratio=ratio(errors.nees),
        nees_within_95_share=share_below(errors.nees, CHI_SQUARE_95),
        cpu_ms_per_scan=float(np.mean([each.cpu_ms_per_scan for each in outcomes])) if outcomes else None,
    )


def joined(errors: Sequence[PoseErrors]) -> PoseErrors:
    """Return all rows of all drives."""
    return PoseErrors(*(np.concatenate(columns) for columns in zip(*errors))) if errors else PoseErrors(
        np.zeros(0), np.zeros(0), np.zeros(0), np.zeros((0, DIMENSIONS)), np.zeros(0, bool), np.zeros(0, bool),
        np.zeros(0))


def column(cars: Sequence[CarErrors], name: str) -> FloatArray:
    """Return one figure of all Cars."""
    return np.array([getattr(car, name) for car in cars], dtype=float)


def root_mean_square(values: FloatArray) -> Optional[float]:
    """Return the root mean square of the known values."""
    known = values[np.isfinite(values)]
    return math.sqrt(float(np.mean(known**2))) if len(known) else None


def ratio(nees: FloatArray) -> Optional[float]:
    """Return the mean normalised squared error divided by its expectation; 1: consistent, above: overconfident."""
    known = nees[np.isfinite(nees)]
    return float(np.mean(known)) / DIMENSIONS if len(known) else None


def mean(values: Sequence[float]) -> Optional[float]:
    """Return the mean; None without values."""
    return float(np.mean(values)) if values else None


def share_below(values: FloatArray, limit: float) -> Optional[float]:
    """Return the share of the known values below a limit."""
    known = values[np.isfinite(values)]
    return float(np.mean(known < limit)) if len(known) else None
