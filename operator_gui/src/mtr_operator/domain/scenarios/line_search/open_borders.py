"""What a picture shows of borders that a search did not find between its places."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from typing import Callable, Sequence

from ...estimation.press.radial_estimate import Reach
from ...geometry.ray import Ray
from ...results.figure import Figure, Kind, figure_of
from ...results.picture import PointRole, PointSet
from .result import SearchedResult

_Found = Sequence[tuple[Ray, SearchedResult, Figure]]


def open_borders(measured: Sequence[tuple[Ray, SearchedResult]], nearest_m: float,
                 farthest_m: float) -> tuple[PointSet, ...]:
    """The end that is known of each, with what may be said of it, and where nothing is known the best guess.

    nearest_m, farthest_m: of the places, beyond which a border lies that a search did not bound more closely.
    """
    found = [(ray, result, figure_of(result.distances[0])) for ray, result in measured]
    farther = [each for each in found if each[2].kind is Kind.AT_LEAST or each[1].reach == Reach.FARTHER.value]
    nearer = [each for each in found if each[2].kind is Kind.AT_MOST or each[1].reach == Reach.NEARER.value]
    unknown = [each for each in found if each[2].kind is Kind.UNKNOWN]
    return (_set("Border farther than here", PointRole.FIRST_FAILED, farther, lambda _: farthest_m),
            _set("Border nearer than here", PointRole.SECOND_FAILED, nearer, lambda _: nearest_m),
            _set("Border unknown", PointRole.UNKNOWN, unknown,
                 lambda result: (nearest_m + farthest_m) / 2.0 if result.d50_m is None else result.d50_m))


def _set(label: str, role: PointRole, found: _Found, place_m: Callable[[SearchedResult], float]) -> PointSet:
    """place_m: of a border without a known end."""
    places = tuple(ray.point(place_m(result) if figure.first_m is None else figure.first_m)
                   for ray, result, figure in found)
    return PointSet(label, role, places, figures=tuple(figure for _, _, figure in found))
