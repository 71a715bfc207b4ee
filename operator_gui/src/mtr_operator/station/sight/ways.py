"""Lines that are free before the robot drives them: a warning only, because the robot's planner decides en route."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any, Sequence

import numpy as np

from mtr_operator.domain.actions.distance import gap_to_outline
from mtr_operator.domain.results.picture import Stretch
from mtr_operator.domain.robot_status import CarDimensions

from .obstacle_map import CELL_M, ObstacleMap

# Extent of the robot beyond its key, away from the Car, and to both sides of the line, with the planner's margin and
# half a cell of the map. Docs of mtr_motion_planner: 0.27 m ahead, 0.254 m behind, 0.22 m to the side, key 0.25 m
# ahead.
_BEHIND_KEY_M, _ASIDE_M = 0.6, 0.4
# Closer to its outline, returns are from the Car itself.
_CAR_M = 0.4
_SHORT_RUN = 2


@dataclass(frozen=True)
class Ways:
    """Lines by their labels, in their order.

    Attributes:
        hindered: lines with an obstacle on their path or at their end. gap_m: from the Car to the nearest obstacle, NaN
            without one.
        unseen: other lines through places that the robot has not seen.
    """

    hindered: tuple[str, ...] = ()
    gap_m: float = math.nan
    unseen: tuple[str, ...] = ()


def ways_of(stretches: Sequence[Stretch], car: CarDimensions, obstacles: ObstacleMap) -> Ways:
    """Evaluate the lines of a plan with the robot's observations around this Car."""
    places = beside_car(obstacles.places, car)
    found = [(stretch.label, place) for stretch in stretches for place in _on_way(stretch, places)]
    hindered = tuple(dict.fromkeys(label for label, _ in found))
    gap_m = min((gap_to_outline((float(place[0]), float(place[1])), car) for _, place in found), default=math.nan)
    unseen = dict.fromkeys(stretch.label for stretch in stretches
                           if stretch.label not in hindered and not _is_seen(stretch, obstacles))
    return Ways(hindered, gap_m, tuple(unseen))


def beside_car(places: Any, car: CarDimensions) -> Any:
    """Return the places, (n, 2), m, of objects other than the Car."""
    half = np.array([car.length / 2.0, car.width / 2.0])
    return places[np.hypot(*np.maximum(np.abs(places) - half, 0.0).T) > _CAR_M]


def spans(labels: Sequence[str]) -> str:
    """Return a text such as "1, 4\N{EN DASH}7, 12": numbers in their order; only the ends of three or more consecutive
    ones."""
    runs: list[list[int]] = []
    for number in map(int, labels):
        if runs and number == runs[-1][-1] + 1:
            runs[-1].append(number)
        else:
            runs.append([number])
    parts = [f"{run[0]}\N{EN DASH}{run[-1]}" if len(run) > _SHORT_RUN else ", ".join(map(str, run)) for run in runs]
    return ", ".join(parts)


def _is_seen(stretch: Stretch, obstacles: ObstacleMap) -> bool:
    (near_x, near_y), (far_x, far_y) = stretch.start, stretch.end
    parts = np.linspace(0.0, 1.0, 2 + int(math.hypot(far_x - near_x, far_y - near_y) / CELL_M))
    return bool(np.all(obstacles.has_seen(near_x + parts * (far_x - near_x), near_y + parts * (far_y - near_y))))


def _on_way(stretch: Stretch, places: Any) -> Any:
    """Return the places that the robot would touch while its key is carried along."""
    (near_x, near_y), (far_x, far_y) = stretch.start, stretch.end
    length_m = math.hypot(far_x - near_x, far_y - near_y)
    if length_m == 0.0 or not len(places):
        return places[:0]
    ahead_x, ahead_y = (far_x - near_x) / length_m, (far_y - near_y) / length_m
    along = (places[:, 0] - near_x) * ahead_x + (places[:, 1] - near_y) * ahead_y
    aside = np.abs((places[:, 1] - near_y) * ahead_x - (places[:, 0] - near_x) * ahead_y)
    return places[(along > -_ASIDE_M) & (along < length_m + _BEHIND_KEY_M) & (aside < _ASIDE_M)]
