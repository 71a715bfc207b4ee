"""What the protocol of Key press shows."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from typing import Sequence

from ...geometry.pose import Point
from ...geometry.radials import radials_around
from ...geometry.ray import Ray
from ...results.figure import Kind, figure_of
from ...results.line_result import LineStatus, MeasuredDistance
from ...results.picture import Picture, PointRole, PointSet, Stretch, bars_along, intervals_along
from ..key_press_parameters import KeyPressParameters
from ..key_press_result import ADAPTIVE, KeyPressResult
from ..line_search.open_borders import open_borders
from ..line_search.result import SURE_PERCENT

_Measured = Sequence[tuple[Ray, KeyPressResult]]


def picture_of(parameters: KeyPressParameters, results: Sequence[KeyPressResult]) -> Picture:
    """Radials, the outlines of the distances found, and where nothing is known."""
    rays = {radial.number: radial.ray for radial in radials_around(parameters.angle_between_radials_rad)}
    measured = [(rays[result.radial], result) for result in results]
    stretches = tuple(Stretch(ray.point(parameters.minimum_distance_m), ray.point(parameters.maximum_distance_m),
                              result.place) for ray, result in measured)
    invalid = tuple(ray.point(parameters.press_distances_m[0]) for ray, result in measured
                    if result.status is LineStatus.INVALID)
    sets = _searched(parameters, measured) if parameters.method == ADAPTIVE else _scanned(measured)
    return Picture(stretches, (*sets, PointSet("Invalid", PointRole.INVALID, invalid)))


def _scanned(measured: _Measured) -> tuple[PointSet, ...]:
    """The places that worked, the next ones that did not, and those beyond which nobody has looked."""
    found = [(ray, result.distances[0], figure_of(result.distances[0])) for ray, result in measured]
    ends = [(ray, distance, figure) for ray, distance, figure in found if figure.kind is Kind.BETWEEN]
    worked = tuple(ray.point(figure.first_m) if figure.kind is Kind.BETWEEN and figure.first_m is not None else None
                   for ray, _, figure in found)
    beyond = tuple(ray.point(figure.first_m) for ray, _, figure in found
                   if figure.kind is Kind.AT_LEAST and figure.first_m is not None)
    failed = tuple(_place(ray, result.failed_distance_m) for ray, result in measured)
    brackets = tuple((ray.point(figure.first_m), ray.point(figure.second_m)) for ray, _, figure in ends
                     if figure.first_m is not None and figure.second_m is not None)
    return (PointSet("Press worked", PointRole.FIRST, worked, is_outline=True,
                     bars=bars_along([(ray, distance) for ray, distance, _ in ends]), brackets=brackets,
                     figures=tuple(figure if figure.kind is Kind.BETWEEN else None for _, _, figure in found)),
            PointSet("Press failed", PointRole.FAILED, failed),
            PointSet("Border farther than here", PointRole.FIRST_FAILED, beyond,
                     figures=tuple(figure for _, _, figure in found if figure.kind is Kind.AT_LEAST)))


def _searched(parameters: KeyPressParameters, measured: _Measured) -> tuple[PointSet, ...]:
    """Where half and where nearly all presses work with their intervals, and where the border was not found."""
    half = [(ray, result.distances[0]) for ray, result in measured]
    sure = [(ray, distance) for ray, result in measured for distance in result.distances_at(SURE_PERCENT)]
    holes = tuple(ray.point(hole_m) for ray, result in measured for hole_m in result.holes_nearer_than(float("inf")))
    return (_area("50 % of the presses work", PointRole.FIRST, half),
            _area("95 % of the presses work", PointRole.SECOND, sure),
            *open_borders(measured, parameters.minimum_distance_m, parameters.search_plan.maximum_m),
            PointSet("Hole", PointRole.FAILED, holes))


def _area(label: str, role: PointRole, measured: Sequence[tuple[Ray, MeasuredDistance]]) -> PointSet:
    places = tuple(_place(ray, distance.distance_m) for ray, distance in measured)
    figures = tuple(figure_of(distance) if role is PointRole.FIRST and distance.distance_m is not None else None
                    for _, distance in measured)
    return PointSet(label, role, places, is_outline=True, bars=bars_along(measured),
                    intervals=intervals_along(measured), figures=figures)


def _place(ray: Ray, distance_m: float | None) -> Point | None:
    return None if distance_m is None else ray.point(distance_m)
