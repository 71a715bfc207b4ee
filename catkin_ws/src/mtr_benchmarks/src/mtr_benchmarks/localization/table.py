"""The rows of the table of goals: value, goal, must, and what is met."""
# SPDX-License-Identifier: Apache-2.0
from typing import Any, Callable, Dict, List, NamedTuple, Optional

import numpy as np

from .drives import PLAIN, RANGE_BIAS, SCENES, TILT
from .errors import percentile
from .figures import FAR_OUT_M, NEAR_M, column, joined
from .methods import THIS_SYSTEM, Outcome

CM = 0.01
# Outcomes of this system by scene, variant and seed.
Outcomes = Dict[str, Dict[str, Dict[int, Outcome]]]


class Goal(NamedTuple):
    """A figure of the table; source takes the outcomes of one scene's drives."""

    name: str
    unit: str
    goal: float
    must: float


class Position(NamedTuple):
    """A position row: which rows of which scene's errors count."""

    goal: Goal
    scene: str
    rows: Callable[[Any], np.ndarray]


POSITIONS = (
    Position(Goal("lot, standing", "m", 0.5 * CM, 1.2 * CM), "lot", lambda e: e.standing),
    Position(Goal("lot, moving 0.5 m/s", "m", 0.8 * CM, 2.0 * CM), "lot", lambda e: e.on_axis),
    Position(Goal("far, standing", "m", 1.2 * CM, 2.5 * CM), "far", lambda e: e.standing),
    Position(Goal("cones, standing", "m", 1.5 * CM, 3.0 * CM), "cones", lambda e: e.standing),
    Position(Goal("open, standing within 5 m of the Car", "m", 2.0 * CM, 4.0 * CM), "open",
             lambda e: e.standing & (e.beyond_m <= NEAR_M)),
    Position(Goal("open, standing 10 m out", "m", 3.0 * CM, 6.0 * CM), "open",
             lambda e: e.standing & (e.beyond_m >= FAR_OUT_M)),
)
YAW = Goal("yaw, all scenes, standing", "deg", 0.2, 0.5)
SIZE = Goal("Car's length and width, in the LiDAR's plane", "m", 0.5 * CM, 2.0 * CM)
SIZE_BODY = Goal("Car's length and width, widest parts", "m", 0.5 * CM, 2.0 * CM)
BIAS = Goal("worse with 2 cm of range error, worst of the positions", "m", 0.5 * CM, 2.0 * CM)
TILTED = Goal("factor with 1 deg of tilt, worst of the positions", "(ratio)", 1.5, 3.0)


def rows(outcomes: Outcomes, failures: Dict[str, Dict[str, str]]) -> List[Dict[str, Any]]:
    """The whole table; a row with a drive that gave nothing is not met, whatever the others gave."""
    table = [{**judged(row.goal, position(outcomes, row, PLAIN), failed(failures, row.scene, PLAIN)),
              "unknown_share": unknown_share(outcomes, row)} for row in POSITIONS]
    plain = [each for scene in SCENES for each in outcomes[scene].get(PLAIN, {}).values()]
    errors = joined([each.errors for each in plain])
    missing = sum(failed(failures, scene, PLAIN) for scene in SCENES)
    table.append(judged(YAW, percentile(np.abs(errors.yaw_deg[errors.standing])), missing))
    table.append(judged(SIZE, size_error(plain, ""), missing))
    table.append(judged(SIZE_BODY, size_error(plain, "_body"), missing))
    for goal, variant, by in ((BIAS, RANGE_BIAS, lambda a, b: a - b), (TILTED, TILT, lambda a, b: a / b)):
        table.append(judged(goal, worst([compared(outcomes, row, variant, by) for row in POSITIONS]),
                            sum(failed(failures, scene, variant) for scene in SCENES)))
    return table


def variants(outcomes: Outcomes) -> List[Dict[str, Any]]:
    """Each position without and with the further errors, on the same seeds."""
    return [{"name": row.goal.name, **{f"{name}_m": position(outcomes, row, name, common(outcomes, row.scene, name))
                                       for name in (RANGE_BIAS, TILT)},
             **{f"plain_on_seeds_of_{name}_m": position(outcomes, row, PLAIN, common(outcomes, row.scene, name))
                for name in (RANGE_BIAS, TILT)}} for row in POSITIONS]


def position(outcomes: Outcomes, row: Position, variant: str, seeds: Optional[List[int]] = None) -> Optional[float]:
    """95 % of the key's position errors."""
    drives = outcomes[row.scene].get(variant, {})
    errors = joined([each.errors for seed, each in drives.items() if seeds is None or seed in seeds])
    return percentile(errors.key_m[row.rows(errors)])


def unknown_share(outcomes: Outcomes, row: Position) -> Optional[float]:
    """Share of a row's instants at which the system says that it does not know where it is."""
    errors = joined([each.errors for each in outcomes[row.scene].get(PLAIN, {}).values()])
    known = np.isfinite(errors.key_m[row.rows(errors)])
    return float(1.0 - np.mean(known)) if len(known) else None


def common(outcomes: Outcomes, scene: str, variant: str) -> List[int]:
    """Seeds that both the plain drives and a variant have."""
    return sorted(outcomes[scene].get(PLAIN, {}).keys() & outcomes[scene].get(variant, {}).keys())


def compared(outcomes: Outcomes, row: Position, variant: str,
             by: Callable[[float, float], float]) -> Optional[float]:
    """A variant's figure against the plain one on the same seeds."""
    seeds = common(outcomes, row.scene, variant)
    with_it, plain = position(outcomes, row, variant, seeds), position(outcomes, row, PLAIN, seeds)
    return by(with_it, plain) if with_it is not None and plain else None


def size_error(plain: List[Outcome], suffix: str) -> Optional[float]:
    """95 % of the errors of length and width, of the Cars whose body is in the LiDAR's plane."""
    cars = [each.car for each in plain if each.car and not each.car["only_wheels"]]
    errors = np.concatenate([np.abs(column(cars, f"{name}_error{suffix}_m")) for name in ("length", "width")])
    return percentile(errors)


def worst(values: List[Optional[float]]) -> Optional[float]:
    """The largest of those that are known."""
    return max((value for value in values if value is not None), default=None)


def failed(failures: Dict[str, Dict[str, str]], scene: str, variant: str) -> int:
    """Drives of a scene in which this system, or the recording, failed."""
    return sum(name.startswith(f"{scene}_{variant}_") and bool(sentences.keys() & {THIS_SYSTEM, "recording"})
               for name, sentences in failures.items())


def judged(goal: Goal, value: Optional[float], failed_drives: int = 0) -> Dict[str, Any]:
    """One row; a value that is not known meets nothing."""
    known = value is not None and not failed_drives
    return {"name": goal.name, "unit": goal.unit, "value": value, "goal": goal.goal, "must": goal.must,
            "failed_drives": failed_drives, "met": known and value <= goal.must,
            "goal_met": known and value <= goal.goal}


def printed(row: Dict[str, Any]) -> str:
    """One row for a person; lengths in cm."""
    scale, unit = (100.0, "cm") if row["unit"] == "m" else (1.0, row["unit"].strip("()"))
    value = "unknown" if row["value"] is None else f"{scale * row['value']:.2f}"
    failed_drives = f", {row['failed_drives']} drives failed" if row["failed_drives"] else ""
    unknown = f", unknown for {100.0 * row['unknown_share']:.1f} % of the time" if row.get("unknown_share") else ""
    verdict = "goal met" if row["goal_met"] else "met" if row["met"] else "NOT MET"
    limits = f"goal {scale * row['goal']:.2f}, must {scale * row['must']:.2f}"
    return f"{row['name']:<55} {value:>8} {unit:<6} {limits}: {verdict}{failed_drives}{unknown}"
