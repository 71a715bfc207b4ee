"""The rows of the table that plain drives and their variants give: positions, heading, size, robustness."""
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
# Sentences of what failed, by drive and method.
Failures = Dict[str, Dict[str, str]]


class PositionRow(NamedTuple):
    """A position: which of one scene's errors count."""

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
# Who tests on level ground stands and waits while the robot does not know where it is.
MAX_UNKNOWN = 0.05
PITCH = Requirement("LiDARs pitched by 0.7 deg, open and cones, standing, worst", "m", 1.5 * CM, 2.5 * CM)


def rows(outcomes: Outcomes, failures: Failures) -> List[Row]:
    """All of them; a row with a drive that gave nothing is not met, whatever the others gave."""
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
    """For how long the pose was not valid, of the drive that is worst: all other rows are of valid poses alone.

    On level ground it is limited in each scene; nobody has said for how long it may be so with a further error.
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
    """The drive of these scenes that is longest without a valid pose."""
    shares = {f"{scene}_{variant}_{seed}": not_valid(each.errors) for scene in scenes
              for seed, each in outcomes[scene].get(variant, {}).items()}
    name = max(shares, key=lambda each: shares[each], default="")
    return judged(requirement, shares.get(name), sum(failed(failures, scene, variant) for scene in scenes),
                  {"mean_share": float(np.mean(list(shares.values()))) if shares else None},
                  name if shares.get(name) else "")


def not_valid(errors: PoseErrors) -> float:
    """Share of a drive's instants without a valid pose; a drive that has no instant at all never had one."""
    return float(np.mean(np.isnan(errors.key_m))) if len(errors.key_m) else 1.0


def variants(outcomes: Outcomes) -> List[Dict[str, Any]]:
    """Each position without and with the further errors, on the same seeds."""
    return [{"name": row.requirement.name,
             **{f"{name}_m": position(outcomes, row, name, common(outcomes, row.scene, name))
                for name in (RANGE_BIAS, TILT)},
             **{f"plain_on_seeds_of_{name}_m": position(outcomes, row, PLAIN, common(outcomes, row.scene, name))
                for name in (RANGE_BIAS, TILT)}} for row in POSITIONS]


def position_row(outcomes: Outcomes, row: PositionRow, failed_drives: int) -> Row:
    """One position, and for how long it was not known."""
    unknown = unknown_share(outcomes, row)
    remark = f"unknown for {100.0 * unknown:.1f} % of the time" if unknown else ""
    return judged(row.requirement, position(outcomes, row, PLAIN), failed_drives, {"unknown_share": unknown}, remark)


def position(outcomes: Outcomes, row: PositionRow, variant: str, seeds: Optional[List[int]] = None) -> Optional[float]:
    """95 % of the key's position errors."""
    drives = outcomes[row.scene].get(variant, {})
    errors = joined([each.errors for seed, each in drives.items() if seeds is None or seed in seeds])
    return percentile(errors.key_m[row.counts(errors)])


def unknown_share(outcomes: Outcomes, row: PositionRow) -> Optional[float]:
    """Share of a row's instants at which the system says that it does not know where it is."""
    errors = joined([each.errors for each in outcomes[row.scene].get(PLAIN, {}).values()])
    known = np.isfinite(errors.key_m[row.counts(errors)])
    return float(1.0 - np.mean(known)) if len(known) else None


def common(outcomes: Outcomes, scene: str, variant: str) -> List[int]:
    """Seeds that both the plain drives and a variant have."""
    return sorted(outcomes[scene].get(PLAIN, {}).keys() & outcomes[scene].get(variant, {}).keys())


def compared(outcomes: Outcomes, row: PositionRow, variant: str,
             by: Callable[[float, float], float]) -> Optional[float]:
    """A variant's figure against the plain one on the same seeds."""
    seeds = common(outcomes, row.scene, variant)
    with_it, plain = position(outcomes, row, variant, seeds), position(outcomes, row, PLAIN, seeds)
    return by(with_it, plain) if with_it is not None and plain else None


def mean_near(outcomes: Outcomes, variant: str) -> Optional[float]:
    """Mean of the key's position errors near the Car in a variant's drives; an unknown pose counts not."""
    errors = joined([each.errors for scene in SCENES for each in outcomes[scene].get(variant, {}).values()])
    near_m = errors.key_m[(errors.standing | errors.on_axis) & (errors.beyond_m <= NEAR_M)]
    known_m = near_m[np.isfinite(near_m)]
    return float(np.mean(known_m)) if len(known_m) else None


def standing(outcomes: Outcomes, scene: str, variant: str) -> Optional[float]:
    """95 % of the key's position errors while the robot stands, in a variant's drives in one scene."""
    errors = joined([each.errors for each in outcomes[scene].get(variant, {}).values()])
    return percentile(errors.key_m[errors.standing])


def difference(first: float, second: float) -> float:
    """How much the first is larger."""
    return first - second


def quotient(first: float, second: float) -> float:
    """How many times the second the first is."""
    return first / second


def size_error(plain: List[MethodOutcome], suffix: str) -> Optional[float]:
    """95 % of the errors of length and width, of the Cars whose body is in the LiDAR's plane."""
    cars = [each.car for each in plain if each.car and not each.car.only_wheels]
    errors = np.concatenate([np.abs(column(cars, f"{name}_error{suffix}_m")) for name in ("length", "width")])
    return percentile(errors)


def worst(values: List[Optional[float]]) -> Optional[float]:
    """The maximum; None where one is not known, for that one may be the worst."""
    known = [value for value in values if value is not None]
    return max(known, default=None) if len(known) == len(values) else None


def failed(failures: Failures, scene: str, variant: str) -> int:
    """Drives of a scene in which this system, or the recording, failed."""
    return sum(name.startswith(f"{scene}_{variant}_") and bool(sentences.keys() & {THIS_SYSTEM, "recording"})
               for name, sentences in failures.items())


def judged(requirement: Requirement, value: Optional[float], failed_drives: int,
           details: Optional[Dict[str, Optional[float]]] = None, remark: str = "") -> Row:
    """One row; with a failed drive it is not met."""
    remarks = [f"{failed_drives} drives failed"] if failed_drives else []
    return Row(requirement, value, is_complete=not failed_drives,
               details={"failed_drives": failed_drives, **(details or {})},
               remark=", ".join([*remarks, *([remark] if remark else [])]))
