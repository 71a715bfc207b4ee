"""Pictures of pages: a test around its Car, overlay of two sets, differences, and a distance over time."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import math
from typing import Any, Mapping, Sequence

from mtr_operator.domain.geometry.pose import Pose
from mtr_operator.domain.geometry.ray import Ray
from mtr_operator.domain.results.line_result import LineStatus
from mtr_operator.domain.results.picture import PointSet, Stretch
from mtr_operator.domain.robot_status import CarDimensions
from mtr_operator.history.estimate import Estimate, Known
from mtr_operator.history.line_pairs import Side
from mtr_operator.history.statistics.comparison import Comparison
from mtr_operator.history.statistics.difference import Change
from mtr_operator.history.statistics.row import DISTANCE, SIDE, Row
from mtr_operator.history.statistics.texts import estimate_text
from mtr_operator.report.figures import SIGNS, ends_text, filled

from ..statistics.trend import Trend
from .drawing import Drawing, Point

# Distance of a label from the end of its line, in m.
_LABEL_M = 0.35
# Length of the robot, in m.
ROBOT_M = 0.51
# Width of a side in a chart, in lines.
_ROOM_OF_SIDE = 1.8
# Position of the limit labels next to the chart, as a share of its width.
_BESIDE = 1.06
# Test numbers are omitted for more tests, because they would overlap.
_MAX_NAMED = 24
_SIDES = ("first", "second")
_KINDS = {Change.FARTHER: "farther", Change.NEARER: "nearer"}


def around_car(side: Side) -> str:
    """Return the picture of the test report, with the Car's front up; empty before the Car was mapped."""
    if side.progress.car is None:
        return ""
    drawing = Drawing(f"{side.scenario.title}: points around the Car")
    _draw_test(drawing, side, side.progress.car)
    return drawing.svg()


def around_car_so_far(side: Side, points: Sequence[Mapping[str, Any]], robot: Pose | None) -> str:
    """Return the picture of a test in progress, including future lines so that the scale does not change.

    points: rows of trials; only lines without a result are drawn. robot: base_link in the Car coordinate system, or
    None if unknown.
    """
    car = side.progress.car
    if car is None:
        return ""
    drawing = Drawing(f"{side.scenario.title}: points around the Car so far")
    near_m, far_m = side.parameters.distance_range_m
    rays = {line.number: line.ray for line in side.scenario.lines(side.parameters, car)}
    for ray in rays.values():
        drawing.line([_up(ray.point(near_m)), _up(ray.point(far_m))], "stretch planned")
    _draw_test(drawing, side, car)
    measured = set(side.progress.measured())
    for row in points:
        place = _place_of(row, rays)
        if place is not None and row["line"] not in measured:
            kind = "first" if row["status"] == LineStatus.OK.value else "failed"
            drawing.dot(_up(place), f"point {kind}", f"{row['word']}: {row['status']}")
    if robot is not None:
        _draw_robot(drawing, robot)
    return drawing.svg()


def _place_of(row: Mapping[str, Any], rays: Mapping[int, Ray]) -> Point | None:
    """Return the place of a trial; None if the place of the key is unknown."""
    if row["x_m"] is not None and row["y_m"] is not None:
        return float(row["x_m"]), float(row["y_m"])
    if row["distance_m"] is None or row["line"] not in rays:
        return None
    return rays[row["line"]].point(float(row["distance_m"]))


def _draw_test(drawing: Drawing, side: Side, car: CarDimensions) -> None:
    picture = side.scenario.picture(side.parameters, car, side.progress.results)
    _draw_car(drawing, car)
    for stretch in picture.stretches:
        _draw_stretch(drawing, stretch)
    for point_set in picture.point_sets:
        _draw_set(drawing, point_set)


def _draw_robot(drawing: Drawing, robot: Pose) -> None:
    """Draw a triangle that points along the heading of the robot."""
    ahead, beside = ROBOT_M / 2.0, ROBOT_M / 2.5
    corners = [robot.apply(corner) for corner in ((ahead, 0.0), (-ahead, beside), (-ahead, -beside))]
    drawing.line([_up(corner) for corner in corners], "robot", is_closed=True, title="Robot")



def _up(point: Point) -> Point:
    """Rotate a point for the page: x of the Car coordinate system (front) is up, left stays left."""
    return -point[1], point[0]


def _draw_car(drawing: Drawing, car: CarDimensions) -> None:
    half_x, half_y = car.length / 2.0, car.width / 2.0
    corners = [(half_x, half_y), (half_x, -half_y), (-half_x, -half_y), (-half_x, half_y)]
    drawing.line([_up(corner) for corner in corners], "car", is_closed=True, title="Car")
    drawing.line([_up(point) for point in ((half_x * 0.6, half_y), (half_x, 0.0), (half_x * 0.6, -half_y))], "car")


def _draw_stretch(drawing: Drawing, stretch: Stretch) -> None:
    drawing.line([_up(stretch.start), _up(stretch.end)], "stretch", title=stretch.label)
    (x, y), (start_x, start_y) = _up(stretch.end), _up(stretch.start)
    away = math.hypot(x - start_x, y - start_y) or 1.0
    drawing.text((x + _LABEL_M * (x - start_x) / away, y + _LABEL_M * (y - start_y) / away), stretch.label)


def _draw_set(drawing: Drawing, points: PointSet) -> None:
    role = points.role.value.replace(" ", "-")
    if points.is_outline:
        for start, end, is_sure in points.pieces():
            drawing.line([_up(start), _up(end)], f"outline {role}" if is_sure else f"outline {role} unsure")
    for pair in (*points.intervals, *points.bars, *points.brackets):
        drawing.line([_up(pair[0]), _up(pair[1])], f"interval {role}")
    figures = points.figures or (None,) * len(points.points)
    for point, figure in zip(points.points, figures):
        if point is not None:
            said = "" if figure is None else filled(SIGNS[figure.kind], figure)
            drawing.dot(_up(point), f"point {role}", f"{points.label}: {said}".rstrip(": "))


def overlay_picture(comparison: Comparison, word: str) -> str:
    """Return both sets around the Car: intervals along each line, and an outline through the values."""
    first = comparison.tests.first
    lines = {line.number: line for line in first.scenario.lines(first.parameters, first.progress.measured_car)}
    drawing = Drawing(f"{word}: both sides around the Car")
    _draw_car(drawing, first.progress.measured_car)
    rows = [row for row in comparison.distances if row.word == word]
    for name in _SIDES:
        known = []
        for row in rows:
            ray, found = lines[row.lines[0]].ray, getattr(row, name)
            ends = _shown_ends(found)
            if ends is not None:
                drawing.line([_up(ray.point(end)) for end in ends], f"interval {name}", title=_titled(row, name))
            if found.value is not None:
                known.append(_up(ray.point(found.value)))
                drawing.dot(known[-1], f"point {name}", _titled(row, name))
        if len(known) == len(rows) > 2:
            drawing.line(known, f"outline {name}", is_closed=True)
    for row in rows:
        if row.is_different:
            known_m = [end for name in _SIDES for end in (_shown_ends(getattr(row, name)) or ())]
            drawing.text(_up(lines[row.lines[0]].ray.point(max(known_m, default=0.0) + _LABEL_M)), "*", "star")
    return drawing.svg()


def _shown_ends(found: Estimate) -> tuple[float, float] | None:
    """Return the finite ends of an interval; an open interval collapses to its known end."""
    ends = [end for end in (found.low, found.high) if math.isfinite(end)]
    return (min(ends), max(ends)) if ends else None


def _titled(row: Row, name: str) -> str:
    found = getattr(row, name)
    return f"{row.name}, {name}: {estimate_text(found)} m, 95 % {ends_text(found.low, found.high) or 'unknown'}"


def difference_picture(comparison: Comparison, word: str) -> str:
    """Return the differences of lines and sides with their intervals and a zero line; open ends reach the edge."""
    rows = [row for row in comparison.rows if row.quantity in (DISTANCE, SIDE) and row.word == word
            and not row.difference.reason]
    ends = [end for row in rows for end in (row.difference.low, row.difference.high) if math.isfinite(end)]
    edge = 1.1 * max((abs(end) for end in ends), default=1.0) or 1.0
    drawing = Drawing(f"{word}: second less first, with 95 % intervals", is_stretched=True)
    places = _places_of(rows)
    drawing.line([(-0.5, 0.0), (max(places, default=0.0) + 0.5, 0.0)], "axis")
    for height in (-edge, edge):
        drawing.text((-0.9, height), f"{height:+.2f} m")
    for index, row in zip(places, rows):
        kind = f"{'different ' if row.is_different else ''}{_KINDS.get(row.change, 'same')}"
        low, high = (min(max(end, -edge), edge) for end in (row.difference.low, row.difference.high))
        title = f"{row.title}: {row.change.value}"
        drawing.line([(index, low), (index, high)], f"interval {kind}", title=title)
        if row.difference.value is not None:
            drawing.dot((index, row.difference.value), f"point {kind}", title)
        drawing.text((index, -edge), str(row.line or row.name.split()[0]), "label small")
    return drawing.svg()


def _places_of(rows: Sequence[Row]) -> list[float]:
    """Return the positions of lines and sides; sides have more space, because they have names."""
    places: list[float] = []
    for row in rows:
        places.append((places[-1] if places else -1.0) + (_ROOM_OF_SIDE if row.quantity == SIDE else 1.0))
    return places


def trend_picture(trend: Trend, names: Sequence[str]) -> str:
    """Return the chart of a distance over the tests in order of time, with control limits.

    names: of the tests, such as "test 17".
    """
    drawing = Drawing("Distance over time with control limits", is_stretched=True)
    last = max(len(trend.points) - 1, 1)
    limits = [(height, kind) for height, kind in ((trend.centre, "axis"), (trend.low, "limit"), (trend.high, "limit"))
              if math.isfinite(height)]
    for height, kind in limits:
        drawing.line([(0.0, height), (float(last), height)], kind)
        drawing.text((last * _BESIDE, height), f"{height:.2f} m")
    known_ends = [_ends_of(point.known) for point in trend.points]
    foot = min((end for end in (*(height for height, _ in limits), *(end for ends in known_ends for end in ends))),
               default=0.0)
    for index, (point, name, ends) in enumerate(zip(trend.points, names, known_ends)):
        if point.known is None:
            continue
        kind = "different" if point.is_beyond else "same"
        if ends:
            drawing.line([(index, min(ends)), (index, max(ends))], f"interval {kind}", title=name)
        if point.known.value is not None:
            drawing.dot((index, point.known.value), f"point {kind}", f"{name}: {point.known.value:.2f} m")
        if len(names) <= _MAX_NAMED:
            drawing.text((index, foot), name.partition(",")[0].rpartition(" ")[2], "label small below")
    return drawing.svg()


def _ends_of(known: Known | None) -> list[float]:
    """Return the finite ends of a known distance."""
    return [] if known is None else [end for end in (known.ends or (known.low, known.high)) if math.isfinite(end)]
