"""Figures over many drives: those of each scene, and those of the table of goals."""
# SPDX-License-Identifier: Apache-2.0
import math
from typing import Any, Dict, List, Optional, Sequence

import numpy as np

from .errors import Errors, percentile
from .methods import Outcome

NEAR_M, FAR_OUT_M = 5.0, 9.0
DIMENSIONS = 3
# 95 % of a chi-square distribution with three degrees of freedom.
CHI_SQUARE_95 = 7.815


def scene_figures(outcomes: Sequence[Outcome]) -> Dict[str, Any]:
    """The figures of one method in one scene; all rows of all drives count alike."""
    errors = joined([each.errors for each in outcomes])
    standing = errors.standing
    cars = [each.car for each in outcomes if each.car]
    measured = [car for car in cars if not car["only_wheels"]]
    return {
        "drives": len(outcomes),
        "online_rmse_m": root_mean_square(errors.key_m),
        "online_p95_m": percentile(errors.key_m),
        "online_max_m": percentile(errors.key_m, 100.0),
        "moving_p95_m": percentile(errors.key_m[errors.on_axis]),
        "standstill_p95_m": percentile(errors.key_m[standing]),
        "standstill_near_p95_m": percentile(errors.key_m[standing & (errors.beyond_m <= NEAR_M)]),
        "standstill_10m_p95_m": percentile(errors.key_m[standing & (errors.beyond_m >= FAR_OUT_M)]),
        "yaw_p95_deg": percentile(np.abs(errors.yaw_deg[standing])),
        "unknown_share": float(np.mean(np.isnan(errors.key_m))) if len(errors.key_m) else None,
        "car_pose_p95_m": percentile(column(cars, "position_error_m")),
        "car_yaw_p95_deg": percentile(column(cars, "yaw_error_deg")),
        "length_error_m": percentile(np.abs(column(measured, "length_error_m"))),
        "width_error_m": percentile(np.abs(column(measured, "width_error_m"))),
        "length_error_body_m": percentile(np.abs(column(measured, "length_error_body_m"))),
        "width_error_body_m": percentile(np.abs(column(measured, "width_error_body_m"))),
        "nees_ratio": ratio(errors.nees),
        "nees_within_95_share": share_below(errors.nees, CHI_SQUARE_95),
        "cpu_ms_per_scan": float(np.mean([each.cpu_ms_per_scan for each in outcomes])) if outcomes else None,
    }


def joined(errors: Sequence[Errors]) -> Errors:
    """All rows of all drives."""
    return Errors(*(np.concatenate(columns) for columns in zip(*errors))) if errors else Errors(
        *(np.zeros(0), np.zeros(0), np.zeros(0), np.zeros(0), np.zeros(0, bool), np.zeros(0, bool), np.zeros(0)))


def column(cars: List[Dict[str, Any]], name: str) -> np.ndarray:
    """One figure of all Cars."""
    return np.array([car[name] for car in cars], dtype=float)


def root_mean_square(values: np.ndarray) -> Optional[float]:
    """Over the known values."""
    known = values[np.isfinite(values)]
    return math.sqrt(float(np.mean(known**2))) if len(known) else None


def ratio(nees: np.ndarray) -> Optional[float]:
    """Mean normalised error squared by its expectation; 1: honest, above: too sure, below: too cautious."""
    known = nees[np.isfinite(nees)]
    return float(np.mean(known)) / DIMENSIONS if len(known) else None


def share_below(values: np.ndarray, limit: float) -> Optional[float]:
    """Share of the known values that are below a limit."""
    known = values[np.isfinite(values)]
    return float(np.mean(known < limit)) if len(known) else None
