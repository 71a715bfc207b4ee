"""Drives of the localization benchmark with errors chosen by a test, and their table."""
# SPDX-License-Identifier: Apache-2.0
import numpy as np

from mtr_benchmarks.localization import report
from mtr_benchmarks.localization.drives import selection
from mtr_benchmarks.localization.drives.selection import (
    ABDUCT,
    ANY_CAR,
    CAMPAIGN,
    KIDNAP,
    LIDAR_KINDS,
    LIDAR_SCENES,
    OPPOSED,
    PITCHED,
    PITCHED_SCENES,
    PLAIN,
    RANGE_BIAS,
    SCENES,
    TILT,
    BenchmarkDrive,
)
from mtr_benchmarks.localization.judging import abduction, any_car
from mtr_benchmarks.localization.judging.any_car import CarVerdict
from mtr_benchmarks.localization.judging.figures import joined
from mtr_benchmarks.localization.methods.errors import PoseErrors
from mtr_benchmarks.localization.methods.outcome import THIS_SYSTEM, CarErrors, MethodOutcome
from mtr_benchmarks.localization.one_drive import DriveResult

CAR = CarErrors(
    position_error_m=0.003, along_error_m=0.003, across_error_m=0.0, yaw_error_deg=0.1, length_error_m=-0.004,
    width_error_m=0.006, length_plane_sigma_m=0.002, width_plane_sigma_m=0.002, length_error_body_m=-0.04,
    width_error_body_m=-0.03, length_sigma_m=0.01, width_sigma_m=0.01, sigmas=[0.001, 0.001, 0.001], only_wheels=False,
    warning="", key_frame_rmse_m=0.001)
FOUND_AGAIN = abduction.Fate(3.0, 90.0, True, 0.8, 6.0, abduction.RIGHT, 0.0, None, None)
SEGMENTS = [{"kind": "kidnap", "begin_s": 4.0}]


def errors(key_m, standing=True, on_axis=False, beyond_m=2.0, nees=3.0):
    """Return a hundred identical rows."""
    one = np.ones(100)
    whitened = np.full((100, 3), np.sqrt(nees / 3.0))
    return PoseErrors(0.02 * np.arange(100), key_m * one, 0.1 * one, whitened, np.full(100, standing),
                  np.full(100, on_axis), beyond_m * one)


def kidnapped_errors(key_m):
    """Return errors of a robot that is lifted at 4 s; key_m has errors by (begin, end)."""
    stamps = np.arange(0.0, 20.0, 0.02)
    values = np.full(len(stamps), 0.005)
    for (begin_s, end_s), error_m in key_m.items():
        values[(stamps >= begin_s) & (stamps < end_s)] = error_m
    one = np.ones(len(stamps))
    return PoseErrors(stamps, values, one, np.ones((len(stamps), 3)), one > 0, one < 0, one)


def drive(scene, variant, seed):
    """Return a drive of the benchmark."""
    return BenchmarkDrive(selection.options(scene, seed), variant)


def result(scene, variant, seed, key_m):
    """Return a drive with rows near the Car, far out, and on an axis."""
    parts = [errors(key_m), errors(key_m, beyond_m=9.9), errors(key_m, standing=False, on_axis=True)]
    return DriveResult(drive(scene, variant, seed), {THIS_SYSTEM: MethodOutcome(joined(parts), 0.5, CAR)}, {}, [])


def failed(scene, variant, method, sentence="The Car was not located."):
    """Return a failed drive."""
    return DriveResult(drive(scene, variant, 9), {}, {method: sentence}, [])


def all_results(key_m=0.004, biased_m=0.006, tilted_m=0.005, opposed_m=0.0025, pitched_m=0.014):
    """Return two seeds of each kind of drive in the table."""
    found = [result(scene, variant, seed, each_m) for scene in SCENES for seed in (1, 2)
             for variant, each_m in ((PLAIN, key_m), (RANGE_BIAS, biased_m), (TILT, tilted_m),
                                    (OPPOSED, opposed_m))]
    found += [result(scene, PITCHED, seed, pitched_m) for scene in PITCHED_SCENES for seed in (1, 2)]
    found += [result(scene, variant, 1, key_m) for variant in LIDAR_KINDS for scene in LIDAR_SCENES]
    lifted = kidnapped_errors({(4.0, 4.5): 2.0, (4.5, 9.0): float("nan")})
    return [*found, result("lot", CAMPAIGN, 1, key_m),
            DriveResult(drive("lot", KIDNAP, 1), {THIS_SYSTEM: MethodOutcome(lifted, 0.5, CAR)}, {}, SEGMENTS),
            DriveResult(drive("lot", ABDUCT, 1), {}, {}, [], FOUND_AGAIN),
            DriveResult(drive("lot", ANY_CAR, 1), {}, {}, [], car=CarVerdict(any_car.RIGHT, "", {}, CAR))]


def rows(results):
    """Return the table as written to the file, by name of the row."""
    return {row["name"]: row for row in report.report(results, None).document()["table"]}
