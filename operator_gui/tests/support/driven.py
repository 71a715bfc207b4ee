"""Tests of Autolock as they are after driving: two passes on each axis, their static boundaries given."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import measured

from mtr_operator.domain.estimation.interval import SIGMAS_OF_LEVEL
from mtr_operator.domain.identity.identity import Identity
from mtr_operator.domain.results.line_result import LineStatus
from mtr_operator.domain.results.progress import Progress
from mtr_operator.domain.robot_status import CarDimensions
from mtr_operator.domain.scenarios import SCENARIOS
from mtr_operator.domain.scenarios.autolock_result import AutolockResult
from mtr_operator.history.line_pairs import Side

SCENARIO = SCENARIOS["autolock"]
CAR = CarDimensions(4.5, 1.8, 0.07, 0.07)
SPEEDS_MPS = (0.4, 0.13)
SIGMA_M, COMMON_M, SHARED_M, PLACE_M = 0.15, 0.12, 0.1, 0.04


def parameters():
    return SCENARIO.parameters_type(passes=2, measuring_speeds_mps=SPEEDS_MPS, measurements_distance_m=1.0)


def axes(car=CAR):
    return SCENARIO.lines(parameters(), car)


def side(events_m, identity=None, car=CAR, speeds_mps=SPEEDS_MPS):
    """events_m: of an axis' number and a word the distances at the events of its passes."""
    results = [_result(axis, events_m, speeds_mps) for axis in axes(car)]
    progress = Progress(SCENARIO.name, parameters().to_mapping(), {"started": measured.STARTED}, car, results,
                        identity=Identity(car_model="Golf") if identity is None else identity)
    return Side(SCENARIO, parameters(), progress)


def _result(axis, events_m, speeds_mps):
    values = {}
    for word in ("unlock", "lock"):
        passes_m = tuple(events_m(axis.number, word))
        static_m = sum(passes_m) / len(passes_m)
        values.update({
            f"{word}_status": LineStatus.OK, f"{word}_distance_m": passes_m[0], f"{word}_uncertainty_m": PLACE_M,
            f"{word}_robot_time_s": 9.0, f"{word}_passes": len(passes_m), f"{word}_pass_distances_m": passes_m,
            f"{word}_pass_speeds_mps": speeds_mps, f"{word}_static_m": static_m, f"{word}_static_sigma_m": SIGMA_M,
            f"{word}_static_low_m": static_m - SIGMAS_OF_LEVEL * SIGMA_M,
            f"{word}_static_high_m": static_m + SIGMAS_OF_LEVEL * SIGMA_M,
            f"{word}_static_common_sigma_m": COMMON_M, f"{word}_static_shared_sigma_m": SHARED_M})
    ray = axis.ray
    return AutolockResult(axis.number, axis.side, ray.origin_x, ray.origin_y, ray.direction_x, ray.direction_y,
                          reason="", **values)
