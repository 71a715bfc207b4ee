"""Rows of the table for plain drives and their variants: positions, heading, size and robustness."""
# SPDX-License-Identifier: Apache-2.0
from typing import Any, Callable, Dict, List, NamedTuple, Optional, Sequence

import numpy as np

from mtr_core.arrays import BoolArray

from ...harness.rows import Requirement, Row
from ..drives.selection import OPPOSED, PITCHED, PITCHED_SCENES, PLAIN, RANGE_BIAS, SCENES, TILT
from ..methods.errors import PoseErrors, percentile
from ..methods.outcome import THIS_SYSTEM, MethodOutcome
from .figures import FAR_OUT_M, NEAR_M, column, joined

CM = 0.01
# Outcomes of this system by scene, variant and seed.
Outcomes = Dict[str, Dict[str, Dict[int, MethodOutcome]]]
# Sentences about failures, by drive and method.
Failures = Dict[str, Dict[str, str]]


class PositionRow(NamedTuple):
    """Row of a position, with the selection of the errors that count in one scene."""

    requirement: Requirement
    scene: str
    counts: Callable[[PoseErrors], BoolArray]


POSITIONS = (
    PositionRow(Requirement("lot, standing", "m", 0.5 * CM, 1.2 * CM), "lot", lambda e: e.standing),
    PositionRow(Requirement("lot, moving 0.5 m/s", "m", 0.8 * CM, 2.0 * CM), "lot", lambda e: e.on_axis),
    PositionRow(Requirement("far, standing", "m", 1.2 * CM, 2.5 * CM), "far", lambda e: e.standing),
    PositionRow(Requirement("cones, standing", "m", 1.5 * CM, 3.0 * CM), "cones", lambda e: e.standing),
    PositionRow(Requirement("open, standing within 5 m of the Car", "m", 2.0 * CM, 4.0 * CM), "open",
                lambda e: e.standing & (e.beyond_m <= NEAR_M)),
    PositionRow(Requirement("open, standing 10 m out", "m", 3.0 * CM, 6.0 * CM), "open",
                lambda e: e.standing & (e.beyond_m >= FAR_OUT_M)),
)
YAW = Requirement("yaw, all scenes, standing", "deg", 0.2, 0.5)
SIZE = Requirement("Car's length and width, in the LiDAR's plane", "m", 0.5 * CM, 2.0 * CM)
SIZE_BODY = Requirement("Car's length and width, widest parts", "m", 0.5 * CM, 2.0 * CM)
BIAS = Requirement("worse with 2 cm of range error, worst of the positions", "m", 0.5 * CM, 2.0 * CM)
OPPOSED_BIAS = Requirement("front ranges +10 mm, rear -10 mm, mean error within 5 m", "m", 0.2 * CM, 0.3 * CM)
TILTED = Requirement("factor with 1 deg of tilt, worst of the positions", "(ratio)", 1.5, 2.0)
# A test waits at standstill while the pose is invalid on level ground.
MAX_UNKNOWN = 0.05
PITCH = Requirement("LiDARs pitched by 0.7 deg, open and cones, standing, worst", "m", 1.5 * CM, 2.5 * CM)


def rows(outcomes: Outcomes, failures: Failures) -> List[Row]:
    """Return all rows; a row with a failed drive is not met, whatever the other drives gave."""
    plain = [each for scene in SCENES for each in outcomes[scene].get(PLAIN, {}).values()]
    errors = joined([each.errors for each in plain])
    missing = sum(failed(failures, scene, PLAIN) for scene in SCENES)
    table = [position_row(outcomes, row, failed(failures, row.scene, PLAIN)) for row in POSITIONS]
    table.append(judged(YAW, percentile(np.abs(errors.yaw_deg[errors.standing])), missing))
    table.append(judged(SIZE, size_error(plain, ""), missing))
    table.append(judged(SIZE_BODY, size_error(plain, "_body"), missing))
    for requirement, variant, by in ((BIAS, RANGE_BIAS, difference), (TILTED, TILT, quotient)):
        table.append(judged(requirement, worst([compared(outcomes, row, variant, by) for row in POSITIONS]),
                            sum(failed(failures, scene, variant) for scene in SCENES)))
    table.append(judged(OPPOSED_BIAS, mean_near(outcomes, OPPOSED),
                        sum(failed(failures, scene, OPPOSED) for scene in SCENES)))
    table.append(judged(PITCH, worst([standing(outcomes, scene, PITCHED) for scene in PITCHED_SCENES]),
                        sum(failed(failures, scene, PITCHED) for scene in SCENES)))
    return table + unknown_rows(outcomes, failures)


def unknown_rows(outcomes: Outcomes, failures: Failures) -> List[Row]:
    """Return rows of the share of invalid poses in the worst drive; all other rows count only valid poses.

    On level ground it is limited in each scene; with additional errors it has no limit.
    """
    level = [unknown_row(Requirement(f"{scene}, pose not valid, worst drive", "(share)", must=MAX_UNKNOWN), outcomes,
                         failures, (scene,), PLAIN) for scene in SCENES]
    return level + [unknown_row(Requirement(f"{name}, pose not valid, worst drive", "(share)"), outcomes, failures,
                                SCENES, variant)
                    for name, variant in (("2 cm of range error", RANGE_BIAS), ("1 deg of tilt", TILT),
                                          ("front ranges +10 mm, rear -10 mm", OPPOSED),
                                          ("LiDARs pitched by 0.7 deg", PITCHED))]


def unknown_row(requirement: Requirement, outcomes: Outcomes, failures: Failures, scenes: Sequence[str],
                variant: str) -> Row:
    """Return the row of the drive with the largest share of invalid poses in these scenes."""
    shares = {f"{scene}_{variant}_{seed}": not_valid(each.errors) for scene in scenes
              for seed, each in outcomes[scene].get(variant, {}).items()}
    name = max(shares, key=lambda each: shares[each], default="")
    return judged(requirement, shares.get(name), sum(failed(failures, scene, variant) for scene in scenes),
                  {"mean_share": float(np.mean(list(shares.values()))) if shares else None},
                  name if shares.get(name) else "")


def not_valid(errors: PoseErrors) -> float:
    """Return the share of a drive's instants without a valid pose; a drive without instants counts as 1."""
    return float(np.mean(np.isnan(errors.key_m))) if len(errors.key_m) else 1.0


def variants(outcomes: Outcomes) -> List[Dict[str, Any]]:
    """Return each position with and without the additional errors, on the same seeds."""
    return [{"name": row.requirement.name,
             **{f"{name}_m": position(outcomes, row, name, common(outcomes, row.scene, name))
                for name in (RANGE_BIAS, TILT)},
             **{f"plain_on_seeds_of_{name}_m": position(outcomes, row, PLAIN, common(outcomes, row.scene, name))
                for name in (RANGE_BIAS, TILT)}} for row in POSITIONS]


def position_row(outcomes: Outcomes, row: PositionRow, failed_drives: int) -> Row:
    """Return the row of one position, with its share of unknown poses."""
    unknown = unknown_share(outcomes, row)
    remark = f"unknown for {100.0 * unknown:.1f} % of the time" if unknown else ""
    return judged(row.requirement, position(outcomes, row, PLAIN), failed_drives, {"unknown_share": unknown}, remark)


def position(outcomes: Outcomes, row: PositionRow, variant: str, seeds: Optional[List[int]] = None) -> Optional[float]:
    """Return the 95th percentile of the key's position errors."""
    drives = outcomes[row.scene].get(variant, {})
    errors = joined([each.errors for seed, each in drives.items() if seeds is None or seed in seeds])
    return percentile(errors.key_m[row.counts(errors)])


def unknown_share(outcomes: Outcomes, row: PositionRow) -> Optional[float]:
    """Return the share of a row's instants without a valid pose."""
    errors = joined([each.errors for each in outcomes[row.scene].get(PLAIN, {}).values()])
    known = np.isfinite(errors.key_m[row.counts(errors)])
    return float(1.0 - np.mean(known)) if len(known) else None


def common(outcomes: Outcomes, scene: str, variant: str) -> List[int]:
    """Return the seeds that both the plain drives and a variant have."""
    return sorted(outcomes[scene].get(PLAIN, {}).keys() & outcomes[scene].get(variant, {}).keys())


def compared(outcomes: Outcomes, row: PositionRow, variant: str,
             by: Callable[[float, float], float]) -> Optional[float]:
    """Return the comparison of a variant's figure with the plain one on the same seeds."""
    seeds = common(outcomes, row.scene, variant)
    with_it, plain = position(outcomes, row, variant, seeds), position(outcomes, row, PLAIN, seeds)
    return by(with_it, plain) if with_it is not None and plain else None


def mean_near(outcomes: Outcomes, variant: str) -> Optional[float]:
    """Return the mean of the key's position errors near the Car in a variant's drives; unknown poses do not count."""
    errors = joined([each.errors for scene in SCENES for each in outcomes[scene].get(variant, {}).values()])
    near_m = errors.key_m[(errors.standing | errors.on_axis) & (errors.beyond_m <= NEAR_M)]
    known_m = near_m[np.isfinite(near_m)]
    return float(np.mean(known_m)) if len(known_m) else None


def standing(outcomes: Outcomes, scene: str, variant: str) -> Optional[float]:
    """Return the 95th percentile of the key's position errors at standstill, in a variant's drives in one scene."""
    errors = joined([each.errors for each in outcomes[scene].get(variant, {}).values()])
    return percentile(errors.key_m[errors.standing])


def difference(first: float, second: float) -> float:
    """Return the difference."""
    return first - second


def quotient(first: float, second: float) -> float:
    """Return the quotient."""
    return first / second


def size_error(plain: List[MethodOutcome], suffix: str) -> Optional[float]:
    """Return the 95th percentile of the errors of length and width, for Cars whose body is in the LiDAR plane."""
    cars = [each.car for each in plain if each.car and not each.car.only_wheels]
    errors = np.concatenate([np.abs(column(cars, f"{name}_error{suffix}_m")) for name in ("length", "width")])
    return percentile(errors)


def worst(values: List[Optional[float]]) -> Optional[float]:
    """Return the maximum; None if a value is unknown, because it may be the worst."""
    known = [value for value in values if value is not None]
    return max(known, default=None) if len(known) == len(values) else None


def failed(failures: Failures, scene: str, variant: str) -> int:
    """Return the number of drives of a scene in which this system or the recording failed."""
    return sum(name.startswith(f"{scene}_{variant}_") and bool(sentences.keys() & {THIS_SYSTEM, "recording"})
               for name, sentences in failures.items())


def judged(requirement: Requirement, value: Optional[float], failed_drives: int,
           details: Optional[Dict[str, Optional[float]]] = None, remark: str = "") -> Row:
    """Return one row; with a failed drive it is not met."""
    remarks = [f"{failed_drives} drives failed"] if failed_drives else []
    return Row(requirement, value, is_complete=not failed_drives,
               details={"failed_drives": failed_drives, **(details or {})},
               remark=", ".join([*remarks, *([remark] if remark else [])]))
