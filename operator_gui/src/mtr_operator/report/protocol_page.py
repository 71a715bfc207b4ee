"""Creates protocol.png and protocol.pdf: the Car from above with all measured points, parameters and date."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import io
import math

from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import Polygon
from matplotlib.ticker import MultipleLocator

from mtr_operator.domain.geometry.pose import Point
from mtr_operator.domain.results.picture import Picture, PointRole, PointSet
from mtr_operator.domain.results.progress import Progress
from mtr_operator.domain.scenario import AnyScenario, ScenarioParameters
from mtr_operator.domain.verdict.assessment import Assessment

from .car_drawing import draw_car
from .drawing.plain_figure import plain_figure
from .error_map.colours import draw_errors, draw_scale
from .figures import SIGNS, filled
from .protocol_panel import BAR, BRACKET, INK, INTERVAL, write_panel

_SIZE_INCH = (11.7, 8.3)  # A4 landscape
_RESOLUTION_DPI = 150
_POINTS_PER_INCH = 72.0
_AXES_BOX = (0.06, 0.08, 0.60, 0.84)  # parts of the size: left, bottom, width, height
_LABEL_GAP_INCH, _LABEL_WIDTH_INCH, _LABEL_HEIGHT_INCH = 0.18, 0.28, 0.13
_MARGIN_PART = 0.14
_CAP_INCH = 0.05
_PALE = "#90a4ae"
# Colours that are distinct for colour-blind readers (Okabe and Ito), each with a marker.
_STYLES = {
    PointRole.FIRST: {"color": "#0072b2", "marker": "o"},
    PointRole.SECOND: {"color": "#d55e00", "marker": "s"},
    PointRole.FIRST_FAILED: {"color": "#0072b2", "marker": "x"},
    PointRole.SECOND_FAILED: {"color": "#d55e00", "marker": "x"},
    PointRole.FAILED: {"color": "#a61c3c", "marker": "x"},
    PointRole.INVALID: {"color": "#6a3d9a", "marker": "D"},
    PointRole.UNKNOWN: {"color": "#546e7a", "marker": "o", "markerfacecolor": "none"},
}


def protocol_png(scenario: AnyScenario, parameters: ScenarioParameters, progress: Progress,
                 assessment: Assessment | None = None) -> bytes:
    """Return the content of the file; the progress must contain the Car's dimensions."""
    return _saved(_page(scenario, parameters, progress, assessment), "png", {})


def protocol_pdf(scenario: AnyScenario, parameters: ScenarioParameters, progress: Progress,
                 assessment: Assessment | None = None) -> bytes:
    """Return the page for printing; it contains the date of the test, not of its creation."""
    return _saved(_page(scenario, parameters, progress, assessment), "pdf", {"CreationDate": None})


def _page(scenario: AnyScenario, parameters: ScenarioParameters, progress: Progress,
          assessment: Assessment | None) -> Figure:
    figure = plain_figure(_SIZE_INCH, facecolor="white")
    axes = figure.add_axes(_AXES_BOX)
    picture = scenario.picture(parameters, progress.measured_car, progress.results)
    _draw_stretches(axes, picture)
    for points in picture.point_sets:
        _draw_points(axes, points)
    _frame(axes, picture, progress)
    for points in picture.point_sets:
        _draw_intervals(axes, points)
        _write_figures(axes, points)
    draw_car(axes, progress.measured_car, _POINTS_PER_INCH / _metres_per_inch(axes))
    label_stretches(axes, picture)
    for points in picture.point_sets:
        draw_scale(figure, points)
    write_panel(figure, axes, scenario, progress, picture=picture, assessment=assessment)
    return figure


def _saved(figure: Figure, kind: str, metadata: dict[str, None]) -> bytes:
    file = io.BytesIO()
    figure.savefig(file, format=kind, dpi=_RESOLUTION_DPI, metadata=metadata)
    return file.getvalue()


def _draw_stretches(axes: Axes, picture: Picture) -> None:
    for stretch in picture.stretches:
        (x0, y0), (x1, y1) = stretch.start, stretch.end
        axes.plot((y0, y1), (x0, x1), color=_PALE, linewidth=0.8, linestyle=(0, (4, 3)), zorder=2)


def label_stretches(axes: Axes, picture: Picture) -> None:
    """Label the far ends that do not overlap; the limits of the axes must be set."""
    per_inch = _metres_per_inch(axes)
    written: list[Point] = []
    for stretch in picture.stretches:
        (x0, y0), (x1, y1) = stretch.start, stretch.end
        beyond = _LABEL_GAP_INCH * per_inch / max(math.dist(stretch.start, stretch.end), 1e-9)
        place = (x1 + beyond * (x1 - x0), y1 + beyond * (y1 - y0))
        if all(abs(place[0] - x) > _LABEL_HEIGHT_INCH * per_inch or abs(place[1] - y) > _LABEL_WIDTH_INCH * per_inch
               for x, y in written):
            written.append(place)
            axes.text(place[1], place[0], stretch.label, ha="center", va="center", fontsize=8, color=INK)


def _metres_per_inch(axes: Axes) -> float:
    # The axes are taller than wide for a Car and its surroundings; otherwise this is slightly too small.
    return float(axes.get_ylim()[1] - axes.get_ylim()[0]) / (_SIZE_INCH[1] * _AXES_BOX[3])


def _draw_points(axes: Axes, points: PointSet) -> None:
    if not points.known:
        return
    style = _STYLES[points.role]
    across, ahead = [y for _, y in points.known], [x for x, _ in points.known]
    if points.is_outline and len(points.known) > 2:
        _draw_outline(axes, points, style["color"])
    for (x0, y0), (x1, y1) in points.brackets:
        axes.plot((y0, y1), (x0, x1), color=style["color"], zorder=5, **BRACKET)
    for (x0, y0), (x1, y1) in points.bars:
        axes.plot((y0, y1), (x0, x1), color=style["color"], zorder=5, **BAR)
    if points.errors_m:
        draw_errors(axes, points)
        return
    axes.plot(across, ahead, linestyle="none", markersize=6, markeredgewidth=1.6, **style,
              label=f"{points.label} ({len(points.known)})", zorder=6)


def _draw_intervals(axes: Axes, points: PointSet) -> None:
    """Draw a line with a cap across each end; the limits of the axes must be set."""
    color, cap_m = _STYLES[points.role]["color"], _CAP_INCH * _metres_per_inch(axes)
    for (x0, y0), (x1, y1) in points.intervals:
        length_m = max(math.dist((x0, y0), (x1, y1)), 1e-9)
        across_x, across_y = -(y1 - y0) * cap_m / length_m, (x1 - x0) * cap_m / length_m
        for (ax, ay), (bx, by) in (((x0, y0), (x1, y1)), *(((x - across_x, y - across_y), (x + across_x, y + across_y))
                                                           for x, y in ((x0, y0), (x1, y1)))):
            axes.plot((ay, by), (ax, bx), color=color, zorder=5, **INTERVAL)


def _write_figures(axes: Axes, points: PointSet) -> None:
    """Write the figure of each point next to it."""
    gap_m = _LABEL_GAP_INCH * _metres_per_inch(axes)
    for point, figure in zip(points.points, points.figures):
        if point is not None and figure is not None:
            text = filled(SIGNS[figure.kind], figure)
            axes.text(point[1], point[0] + gap_m, text, ha="center", va="center", fontsize=7, zorder=7,
                      color=_STYLES[points.role]["color"], bbox={"facecolor": "white", "alpha": 0.8, "pad": 0.6,
                                                                 "edgecolor": "none"})


def _draw_outline(axes: Axes, points: PointSet, color: str) -> None:
    is_complete = True
    for (x0, y0), (x1, y1), is_known in points.pieces():
        is_complete = is_complete and is_known
        axes.plot((y0, y1), (x0, x1), color=color, linewidth=1.4 if is_known else 0.9, zorder=5,
                  linestyle="-" if is_known else (0, (1, 2)))
    if is_complete:
        axes.add_patch(Polygon([(y, x) for x, y in points.known], closed=True, facecolor=color, alpha=0.10, zorder=1))


def _frame(axes: Axes, picture: Picture, progress: Progress) -> None:
    ends = [stretch.end for stretch in picture.stretches] + [point for s in picture.point_sets for point in s.known]
    ends += [end for points in picture.point_sets for bar in (*points.bars, *points.intervals) for end in bar]
    extent_x = max([abs(x) for x, _ in ends] + [progress.measured_car.length])
    extent_y = max([abs(y) for _, y in ends] + [progress.measured_car.width])
    margin = _MARGIN_PART * max(extent_x, extent_y)
    half_height, half_width = extent_x + margin, extent_y + margin
    axes.set_aspect("equal")
    axes.set_xlim(half_width, -half_width)  # y grows to the left
    axes.set_ylim(-half_height, half_height)
    axes.xaxis.set_major_locator(MultipleLocator(1.0 if half_width < 12.0 else 5.0))
    axes.yaxis.set_major_locator(MultipleLocator(1.0 if half_height < 12.0 else 5.0))
    axes.grid(color="#eceff1", linewidth=0.8, zorder=0)
    axes.set_axisbelow(True)
    axes.set_xlabel("y, to the Car's left [m]", color=INK)
    axes.set_ylabel("x, to the Car's front [m]", color=INK)
    axes.tick_params(colors=INK, labelsize=8)
    for spine in axes.spines.values():
        spine.set_color(_PALE)
