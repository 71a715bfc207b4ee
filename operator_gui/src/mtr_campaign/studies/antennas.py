"""Study: placement of passive entry antennas for a required unlock area."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import argparse
import dataclasses
import math
import pathlib
from typing import Any, Mapping, Sequence

from matplotlib.patches import FancyBboxPatch, Rectangle

from mtr_operator.domain.robot_status import CarDimensions
from mtr_operator.report.drawing.plain_figure import plain_figure

from ..errors import CampaignError
from ..kernels.order import order_of
from ..plan.plan import Design, Plan
from ..plan.run import Run
from ..work.campaign import run_campaign
from ..work.folder import OK, Done
from ..work.optimiser import figure_of
from .plans import shipped_plan

PICTURE, SHORT_RUNS = "antennas.png", 12
_LENGTH_M, _WIDTH_M = 4.5, 1.8
_CAR = CarDimensions(_LENGTH_M, _WIDTH_M, 0.0, 0.0)
_BEFORE, _AFTER = "tab:orange", "tab:blue"


def study(options: argparse.Namespace) -> list[str]:
    """Run the optimisation and draw both states; return sentences about the result."""
    plan = shipped_plan("antennas", **({"runs": SHORT_RUNS} if options.short else {}))
    before = run_campaign(dataclasses.replace(plan, name=f"{plan.name}_before", factors={}, design=Design()), options)
    found = run_campaign(plan, options)
    first = next(iter(before.course.runs.values()))
    runs = [done for done in found.course.runs.values() if done.status == OK]
    if first.status != OK or not runs:
        raise CampaignError(f"No run of the study has a result; see {found.folder}.")
    scores = [_score(plan, done) for done in runs]
    best = runs[scores.index(min(scores))]
    path = found.folder / PICTURE
    draw(plan, first, best, scores, path)
    changes = ", ".join(f"{name.partition('.')[2]} {best.run.settings[name]:.2f}" for name in plan.factors)
    return [f"Wanted is that the Car unlocks at {plan.design.wanted:g} m on each line. Off by (rms): "
            f"{_score(plan, first):.3f} m as the Car ships, {min(scores):.3f} m with the best of {len(runs)} "
            f"placements: {changes}.",
            f"The picture is {path}, the tests are in the store {found.store}."]


def draw(plan: Plan, before: Done, best: Done, scores: Sequence[float], path: pathlib.Path) -> None:
    """Draw the Car from above with both areas, and the progress of the optimisation."""
    figure = plain_figure((12.0, 6.5), layout="constrained")
    above, course = figure.subplots(1, 2, width_ratios=(3, 2))
    wanted_m = plan.design.wanted
    above.add_patch(Rectangle((-_LENGTH_M / 2, -_WIDTH_M / 2), _LENGTH_M, _WIDTH_M, facecolor="0.9", edgecolor="0.3"))
    above.add_patch(FancyBboxPatch((-_LENGTH_M / 2, -_WIDTH_M / 2), _LENGTH_M, _WIDTH_M, facecolor="none",
                                   boxstyle=f"round,pad={wanted_m},rounding_size={wanted_m}", linestyle="--",
                                   edgecolor="tab:green", label=f"wanted: {wanted_m:g} m from the outline"))
    for done, colour, name in ((before, _BEFORE, "as it ships"), (best, _AFTER, "best placement")):
        points = _points(done)
        above.plot(*zip(*points, points[0]), "o-", color=colour, markersize=4,
                   label=f"unlocks, {name}: {_score(plan, done):.2f} m off (rms)")
        antennas = _antennas(done.run)
        above.scatter([x for x, _, _ in antennas], [y for _, y, _ in antennas], marker="D", color=colour, zorder=3)
        for x, y, strength_db in antennas:
            above.annotate(f"{strength_db:.1f} dB", (x, y), textcoords="offset points", color=colour, fontsize=8,
                           xytext=(6, 6 if done is before else -12))
    above.set(xlabel="x, to the Car's front (m)", ylabel="y, to its left (m)", aspect="equal",
              title="Where the Car unlocks; antennas as diamonds")
    above.legend(loc="upper center", bbox_to_anchor=(0.5, -0.1), fontsize=9)
    lowest = [min(scores[:number]) for number in range(1, len(scores) + 1)]
    course.plot(range(1, len(scores) + 1), scores, ".", color="0.6", label="a run")
    course.plot(range(1, len(scores) + 1), lowest, color=_AFTER, drawstyle="steps-post",
                label="best so far")
    course.axhline(_score(plan, before), color=_BEFORE, linestyle=":", label="as it ships")
    course.set(xlabel="run", ylabel="off the wanted distance, rms over the lines (m)", title="The optimisation",
               ylim=(0.0, None))
    course.legend()
    figure.savefig(str(path))


def _score(plan: Plan, done: Done) -> float:
    value = figure_of(plan, done)
    return math.inf if value is None else value


def _points(done: Done) -> list[tuple[float, float]]:
    """Return the unlock points around the Car."""
    order = order_of(done.run)
    distances: Mapping[str, Any] = done.outcome["distances"]["unlock"]
    lines = order.scenario.lines(order.parameters, _CAR)
    points = [line.ray.point(distances[str(line.number)]) for line in lines
              if distances.get(str(line.number)) is not None]
    return sorted(points, key=lambda point: math.atan2(point[1], point[0]))


def _antennas(run: Run) -> list[tuple[float, float, float]]:
    honest = order_of(run).car.honest
    return [] if honest is None else [(each.x_m, each.y_m, each.strength_db) for each in honest.antennas]
