"""Area that the distances around a Car enclose, in m2, with its uncertainty.

The area is not linear in the distances, and distances of one test are correlated by common errors. So a Monte Carlo
method is used (JCGM 101): each distance is drawn within its 95 % interval, the coherent part once for all lines of a
draw. Between lines the outline is straight. If a distance has an open end, the area has one, too.
"""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import math
from dataclasses import replace
from typing import Any, Iterator, Mapping, Sequence

import numpy as np
import numpy.typing as npt

from mtr_operator.domain.estimation.interval import SIGMAS_OF_LEVEL, interval_of_draws
from mtr_operator.domain.geometry.ray import Ray
from mtr_operator.history.estimate import Known

Floats = npt.NDArray[np.float64]
# With this number, the ends of an interval vary by 3 % of its width between seeds.
DRAWS = 2000
_SEED = 20
# Lines with a larger gap, as seen from the Car's centre, do not enclose the Car.
_WIDEST_GAP_RAD = math.radians(120.0)


def rings(lines: Sequence[Any]) -> Iterator[tuple[float | None, list[Any]]]:
    """Yield the groups of lines that go around the Car, by their key height; other lines are excluded."""
    heights = sorted({getattr(line, "height_m", None) for line in lines}, key=lambda height: height or 0.0)
    for height in heights:
        ring = sorted((line for line in lines if getattr(line, "height_m", None) == height), key=_bearing)
        bearings = [_bearing(line) for line in ring]
        gaps = [(after - before) % (2.0 * math.pi) for before, after in zip(bearings, [*bearings[1:], *bearings[:1]])]
        if len(ring) > 2 and max(gaps) <= _WIDEST_GAP_RAD:
            yield height, ring


def _bearing(line: Any) -> float:
    # A point 1 m along the line: an axis starts on the outline, a radial line in the centre.
    x, y = line.ray.point(1.0)
    return math.atan2(y, x)


def area(ring: Sequence[Any], known: Mapping[int, Known]) -> Known | None:
    """Return the area within a ring from the distances by line number; None if a distance is unknown."""
    if any(line.number not in known for line in ring):
        return None
    rays, distances = [line.ray for line in ring], [known[line.number] for line in ring]
    growth = _gradient(rays, distances)
    coherent = max(each.coherent for each in distances)
    parts = (growth * choose(getattr(each, name) for each in distances) for name, choose in (
        ("coherent", max), ("shared", max), ("alike", min), ("alike_timing", min)))
    low, high = (_enclosed(rays, [max(0.0, getattr(each, end)) for each in distances]) for end in ("low", "high"))
    value = None if any(each.value is None for each in distances) else low
    reason = next((each.reason for each in distances if each.reason), "")
    return replace(Known(value, low, high, _ends(rays, distances, coherent), *parts), reason=reason)


def _ends(rays: Sequence[Ray], distances: Sequence[Known], coherent: float) -> tuple[float, float] | None:
    ends = [each.ends for each in distances if each.ends is not None]
    if len(ends) < len(distances):
        return None
    if all(map(math.isfinite, (end for pair in ends for end in pair))):
        found = interval_of_draws(_drawn(rays, distances, ends, coherent))
        return found.low_m, found.high_m
    # If an end is unknown, do not draw: combining the ends of all distances is conservative.
    low, high = (_enclosed(rays, [max(0.0, pair[side]) for pair in ends]) for side in (0, 1))
    return low, high


def _drawn(rays: Sequence[Ray], distances: Sequence[Known], ends: Sequence[tuple[float, float]],
           coherent: float) -> Floats:
    generator = np.random.default_rng(_SEED)
    middle = np.array([sum(pair) / 2.0 if each.value is None else each.value for each, pair in zip(distances, ends)])
    below, above = (np.abs(np.array(ends)[:, side] - middle) / SIGMAS_OF_LEVEL for side in (0, 1))
    own = generator.standard_normal((DRAWS, len(middle)))
    sigma = np.sqrt(np.maximum(np.where(own < 0.0, below, above) ** 2 - coherent ** 2, 0.0))
    together = coherent * generator.standard_normal((DRAWS, 1))
    return _areas(rays, np.maximum(middle + own * sigma + together, 0.0))


def _gradient(rays: Sequence[Ray], distances: Sequence[Known]) -> float:
    """Return the growth of the area in m2 per metre by which all known distances grow."""
    middle = np.array([each.value if each.value is not None else each.low if math.isfinite(each.low) else
                       each.high if math.isfinite(each.high) else 0.0 for each in distances])
    step = 0.01
    grown = _areas(rays, np.stack([middle, middle + step]))
    return float(grown[1] - grown[0]) / step


def _enclosed(rays: Sequence[Ray], distances: Sequence[float]) -> float:
    if math.inf in distances:
        return math.inf
    return float(_areas(rays, np.array([distances]))[0])


def _areas(rays: Sequence[Ray], distances: Floats) -> Floats:
    """Return the area of each row of distances by the shoelace formula.

    With o and d the origins and directions of the rays, a line and the next one (') add (o + r d) x (o' + r' d').
    Everything except the distances r is the same for each row.
    """
    origins = np.array([(ray.origin_x, ray.origin_y) for ray in rays])
    directions = np.array([(ray.direction_x, ray.direction_y) for ray in rays])
    next_origins, next_directions = np.roll(origins, -1, axis=0), np.roll(directions, -1, axis=0)
    alone = _cross(directions, next_origins) + np.roll(_cross(origins, next_directions), 1)
    pairs = distances * np.roll(distances, -1, axis=1)
    doubled = np.sum(_cross(origins, next_origins)) + distances @ alone + pairs @ _cross(directions, next_directions)
    found: Floats = np.abs(doubled) / 2.0
    return found


def _cross(first: Floats, second: Floats) -> Floats:
    found: Floats = first[:, 0] * second[:, 1] - first[:, 1] * second[:, 0]
    return found
