"""protocol.png: the Car from above with everything measured around it, parameters and date."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import io

from matplotlib.axes import Axes
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from matplotlib.patches import Polygon
from matplotlib.ticker import MultipleLocator

from mtr_operator.domain.parameters import ParameterSet, with_unit
from mtr_operator.domain.picture import Look, Picture, PointSet
from mtr_operator.domain.progress import Progress
from mtr_operator.domain.scenario import LineStatus, Scenario

from .car_drawing import draw_car

FILE_NAME = "protocol.png"
_SIZE_INCH = (11.7, 8.3)  # A4 landscape
_RESOLUTION_DPI = 150
_MARGIN_M = 0.9
_INK, _PALE = "#263238", "#90a4ae"
# Colours that colour-blind readers tell apart (Okabe and Ito), and a marker each.
_LOOKS = {
    Look.FIRST: {"color": "#0072b2", "marker": "o"},
    Look.SECOND: {"color": "#d55e00", "marker": "s"},
    Look.FIRST_FAILED: {"color": "#0072b2", "marker": "x"},
    Look.SECOND_FAILED: {"color": "#d55e00", "marker": "x"},
    Look.FAILED: {"color": "#a61c3c", "marker": "x"},
    Look.INVALID: {"color": "#6a3d9a", "marker": "D"},
}


def protocol_png(scenario: Scenario, parameters: ParameterSet, progress: Progress) -> bytes:
    """Content of the file; the progress has to hold the Car's dimensions."""
    figure = Figure(figsize=_SIZE_INCH, facecolor="white")
    FigureCanvasAgg(figure)
    axes = figure.add_axes((0.06, 0.08, 0.60, 0.84))
    picture = scenario.picture(parameters, progress.car, progress.results)
    _draw_stretches(axes, picture)
    draw_car(axes, progress.car)
    for points in picture.point_sets:
        _draw_points(axes, points)
    _frame(axes, picture, progress)
    _write_panel(figure, axes, scenario, progress)
    file = io.BytesIO()
    figure.savefig(file, format="png", dpi=_RESOLUTION_DPI)
    return file.getvalue()


def _draw_stretches(axes: Axes, picture: Picture) -> None:
    for stretch in picture.stretches:
        (x0, y0), (x1, y1) = stretch.start, stretch.end
        axes.plot((y0, y1), (x0, x1), color=_PALE, linewidth=0.8, linestyle=(0, (4, 3)), zorder=2)
        length = max(((x1 - x0) ** 2 + (y1 - y0) ** 2) ** 0.5, 1e-9)
        beyond = 0.3 / length
        axes.text(y1 + beyond * (y1 - y0), x1 + beyond * (x1 - x0), stretch.label, ha="center", va="center", fontsize=8,
                  color=_INK)


def _draw_points(axes: Axes, points: PointSet) -> None:
    if not points.known:
        return
    look = _LOOKS[points.look]
    across, ahead = [y for _, y in points.known], [x for x, _ in points.known]
    if points.is_outline and len(points.known) > 2:
        _draw_outline(axes, points, look["color"])
    axes.plot(across, ahead, linestyle="none", markersize=6, markeredgewidth=1.6, color=look["color"],
              marker=look["marker"], label=f"{points.label} ({len(points.known)})", zorder=6)


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
    half_height = max([abs(x) for x, _ in ends] + [progress.car.length]) + _MARGIN_M
    half_width = max([abs(y) for _, y in ends] + [progress.car.width]) + _MARGIN_M
    axes.set_aspect("equal")
    axes.set_xlim(half_width, -half_width)  # y grows to the left
    axes.set_ylim(-half_height, half_height)
    axes.xaxis.set_major_locator(MultipleLocator(1.0 if half_width < 12.0 else 5.0))
    axes.yaxis.set_major_locator(MultipleLocator(1.0 if half_height < 12.0 else 5.0))
    axes.grid(color="#eceff1", linewidth=0.8, zorder=0)
    axes.set_axisbelow(True)
    axes.set_xlabel("y, to the Car's left [m]", color=_INK)
    axes.set_ylabel("x, to the Car's front [m]", color=_INK)
    axes.tick_params(colors=_INK, labelsize=8)
    for spine in axes.spines.values():
        spine.set_color(_PALE)


def _write_panel(figure: Figure, axes: Axes, scenario: Scenario, progress: Progress) -> None:
    left, top = 0.69, 0.93
    figure.text(left, top, f"{scenario.title} protocol", fontsize=17, fontweight="bold", color=_INK, va="top")
    started = str(progress.session.get("started", ""))
    figure.text(left, top - 0.052, started.replace("T", "  ")[:17], fontsize=10, color=_INK, va="top")
    handles, labels = axes.get_legend_handles_labels()
    legend = figure.legend(handles, labels, loc="upper left", bbox_to_anchor=(left - 0.008, top - 0.085), frameon=False,
                           fontsize=10, labelcolor=_INK, handletextpad=0.4)
    legend.set_in_layout(False)
    height = top - 0.12 - 0.032 * max(len(labels), 1)
    for heading, rows in (("Result", _summary(scenario, progress)), ("Parameters", _parameter_rows(scenario, progress)),
                          ("Test", _session_rows(progress))):
        height = _write_table(figure, heading, rows, left, height) - 0.022


def _write_table(figure: Figure, heading: str, rows: list[tuple[str, str]], left: float, top: float) -> float:
    """Write rows below each other; the height at which the table ends."""
    figure.text(left, top, heading, fontsize=10, fontweight="bold", color=_INK, va="top")
    for name, value in rows:
        top -= 0.0235
        figure.text(left, top, name, fontsize=8.5, color="#546e7a", va="top")
        figure.text(0.985, top, value, fontsize=8.5, color=_INK, va="top", ha="right")
    return top - 0.0235


def _summary(scenario: Scenario, progress: Progress) -> list[tuple[str, str]]:
    rows = [("lines", str(len(progress.results)))]
    for column in scenario.status_columns:
        counts = [(status, sum(result[column] == status.value for result in progress.results)) for status in LineStatus]
        told = ", ".join(f"{count} {status.value.replace('_', ' ')}" for status, count in counts if count)
        rows.append((column.replace("_", " "), told or "nothing measured"))
    return rows


def _parameter_rows(scenario: Scenario, progress: Progress) -> list[tuple[str, str]]:
    rows = []
    for declared in scenario.parameters_type.declarations().values():
        value = progress.parameters[declared.file_key]
        if value is not None:
            name, _, suffix = declared.file_key.rpartition("_")
            shown = name if suffix in ("m", "s", "mps", "deg") else declared.file_key
            rows.append((shown.replace("_", " "), with_unit(value, declared.unit)))
    return rows


def _session_rows(progress: Progress) -> list[tuple[str, str]]:
    car = progress.car
    rows = [("Car measured", f"{car.length:.2f} m \N{MULTIPLICATION SIGN} {car.width:.2f} m")]
    for name in ("car profile", "robot", "software", "robot software"):
        value = str(progress.session.get(name, ""))
        if value:
            rows.append((name, value if len(value) <= 34 else "\N{HORIZONTAL ELLIPSIS}" + value[-33:]))
    return rows
