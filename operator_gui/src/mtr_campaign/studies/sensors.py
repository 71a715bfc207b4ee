"""Study: contribution of each error of the robot to a distance, by Sobol indices."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import argparse
import json
import pathlib
from dataclasses import dataclass
from typing import Any, Sequence

import numpy as np
import numpy.typing as npt

from mtr_operator.domain.robot_status import CarDimensions
from mtr_operator.report.drawing.plain_figure import plain_figure

from ..errors import CampaignError
from ..kernels.order import order_of
from ..plan.designs import problem_of
from ..plan.plan import Plan
from ..work.campaign import Finished, run_campaign
from ..work.folder import OK
from .plans import shipped_plan

PICTURE, TABLE, SHORT_SAMPLES = "sensors.png", "sensors.json", 4
_WORD = "unlock"
_CAR = CarDimensions(4.5, 1.8, 0.0, 0.0)
_NAMES = {"position_x_m": "position along the Car", "position_y_m": "position across the Car",
          "heading_rad": "heading (LiDAR's yaw)", "mast_lean_rad": "mast leans", "floor_slope_rad": "floor slopes",
          "key_lever_m": "key's lever", "inset_m": "sides stand back", "clock_s": "clock of the bus"}
Floats = npt.NDArray[np.float64]


@dataclass(frozen=True)
class Indices:
    """Indices of one factor over all lines, weighted by the variance of each line.

    Attributes:
        first, total: Sobol indices; first_95, total_95: half of their 95 % intervals. sigma_mm: by side, 1 sigma of
            a distance caused by this factor alone.
    """

    name: str
    first: float
    first_95: float
    total: float
    total_95: float
    sigma_mm: dict[str, float]


def study(options: argparse.Namespace) -> list[str]:
    """Run, analyse and draw; return sentences about the result."""
    plan = shipped_plan("sensors", **({"samples": SHORT_SAMPLES} if options.short else {}))
    finished = run_campaign(plan, options)
    indices, sigma_mm = analysed(finished)
    table = [vars(each) for each in indices]
    (finished.folder / TABLE).write_text(json.dumps({"sigma_mm": sigma_mm, "factors": table}, indent=1),
                                         encoding="utf-8")
    draw(indices, sigma_mm, finished.folder / PICTURE)
    told = "; ".join(f"{_NAMES[each.name]} {100.0 * each.total:.0f} %" for each in indices)
    return [f"All errors together make {sigma_mm:.1f} mm (1 sigma, mean of the lines). Of the variance, by total "
            f"Sobol index: {told}.",
            f"The picture is {finished.folder / PICTURE}, its figures are beside it, the tests in the store "
            f"{finished.store}."]


def analysed(finished: Finished) -> tuple[list[Indices], float]:
    """Return the indices, the largest first, and 1 sigma of a distance in mm; CampaignError if runs are missing."""
    from SALib.analyze import sobol
    plan = finished.plan
    outputs, lines = _outputs(finished)
    results = [sobol.analyze(problem_of(plan.factors), column, calc_second_order=False, seed=plan.design.seed)
               for column in outputs.T]
    variances = np.var(outputs, axis=0)
    sides = _sides(plan, lines)
    # The estimate of an index that is 0 may be slightly negative.
    own_mm = 1000.0 * np.sqrt(np.maximum(np.array([each["S1"] for each in results]), 0.0) * variances[:, None])
    found = []
    for index, name in enumerate(plan.factors):
        first, first_95, total, total_95 = (
            float(np.average([each[key][index] for each in results], weights=variances))
            for key in ("S1", "S1_conf", "ST", "ST_conf"))
        by_side = {side: float(np.mean(own_mm[[line == side for line in sides], index])) for side in sides}
        found.append(Indices(name.partition(".")[2], first, first_95, total, total_95, by_side))
    return sorted(found, key=lambda each: -each.total), float(1000.0 * np.sqrt(np.mean(variances)))


def _outputs(finished: Finished) -> tuple[Floats, list[int]]:
    """Return the distances in m, one row per run of the design, and the lines with a distance in every run."""
    runs = [finished.course.runs[run.digest] for run in finished.plan.runs()]
    if any(done.status != OK for done in runs):
        raise CampaignError(f"Runs of the study failed; see {finished.folder}, and start it again.")
    columns: dict[str, list[Any]] = {line: [done.outcome["distances"][_WORD].get(line) for done in runs]
                                     for line in runs[0].outcome["distances"][_WORD]}
    whole = {line: values for line, values in columns.items() if None not in values and np.ptp(values) > 0.0}
    if not whole:
        raise CampaignError("No line was measured in each run of the study.")
    return np.array(list(whole.values()), dtype=float).T, [int(line) for line in whole]


def _sides(plan: Plan, lines: Sequence[int]) -> list[str]:
    order = order_of(next(plan.runs()))
    by_number = {line.number: line for line in order.scenario.lines(order.parameters, _CAR)}
    return [by_number[number].side.replace("_", " ") for number in lines]


def draw(indices: Sequence[Indices], sigma_mm: float, path: pathlib.Path) -> None:
    """Draw bars of the indices, and the effect of each error on the distances of each side."""
    figure = plain_figure((13.0, 6.0), layout="constrained")
    shares, sides = figure.subplots(1, 2, width_ratios=(3, 4))
    places = np.arange(len(indices))[::-1]
    for offset, height, label, value, error in ((0.2, 0.38, "alone (first order)", "first", "first_95"),
                                                (-0.2, 0.38, "with all others (total)", "total", "total_95")):
        shares.barh(places + offset, [100.0 * getattr(each, value) for each in indices], height, label=label,
                    xerr=[100.0 * getattr(each, error) for each in indices], capsize=3)
    shares.set_yticks(places, [_NAMES[each.name] for each in indices])
    shares.set(xlabel="part of the variance of a distance (%), with 95 % intervals",
               title=f"Which error matters most; all together {sigma_mm:.0f} mm (1 sigma)")
    shares.legend()
    names = list(indices[0].sigma_mm)
    values = np.array([[each.sigma_mm[side] for side in names] for each in indices])
    picture = sides.imshow(values, aspect="auto", cmap="Blues", vmin=0.0)
    for row, column in np.ndindex(values.shape):
        sides.text(column, row, f"{values[row, column]:.0f}", ha="center", va="center", fontsize=9,
                   color="white" if values[row, column] > 0.6 * values.max() else "black")
    sides.set_xticks(range(len(names)), names, rotation=30, ha="right")
    sides.set_yticks(range(len(indices)), [_NAMES[each.name] for each in indices])
    sides.set_title("What each alone makes of an unlock distance (mm, 1 sigma), by side")
    figure.colorbar(picture, ax=sides, label="mm")
    figure.savefig(str(path))
