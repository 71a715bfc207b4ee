"""Text panel next to the drawing of a protocol."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from mtr_operator.domain.results.picture import Picture
from mtr_operator.domain.results.progress import Progress
from mtr_operator.domain.scenario import AnyScenario
from mtr_operator.domain.verdict.assessment import Assessment

from .identity.identity_rows import short_rows
from .identity.signature import DATE, SIGNATURE, signatories
from .protocol_rows import (
    Row,
    assessment_rows,
    date_text,
    finding_rows,
    parameter_rows,
    session_rows,
    summary_rows,
)

INK = "#263238"
# Maximum height of a table row, and of the margin below the tables; relative to the sheet.
_ROW, _BOTTOM = 0.0235, 0.105
# Signatures below the tables: height of each, and the horizontal ranges of name, date and signature.
_SIGN_ROW, _SIGN_COLUMNS = 0.042, ((0.69, 0.805), (0.815, 0.88), (0.89, 0.985))
_TEXT_POINTS = 8.5
BAR = {"linewidth": 5.0, "alpha": 0.3, "solid_capstyle": "butt"}
INTERVAL = {"linewidth": 1.6, "solid_capstyle": "butt"}
BRACKET = {"linewidth": 1.2, "linestyle": (0, (1, 1))}


def write_panel(figure: Figure, axes: Axes, scenario: AnyScenario, progress: Progress, *, picture: Picture,
                assessment: Assessment | None = None) -> None:
    """Write heading, date, legend, results, parameters and circumstances to the right of the axes."""
    left, top = 0.69, 0.93
    figure.text(left, top, f"{scenario.title} protocol", fontsize=17, fontweight="bold", color=INK, va="top")
    started = str(progress.session.get("started", ""))
    figure.text(left, top - 0.052, date_text(started), fontsize=10, color=INK, va="top")
    handles, labels = axes.get_legend_handles_labels()
    if any(points.bars for points in picture.point_sets):
        handles.append(Line2D((), (), color=INK, **BAR))
        labels.append("place of the key, \N{PLUS-MINUS SIGN}1 sigma")
    if any(points.brackets for points in picture.point_sets):
        handles.append(Line2D((), (), color=INK, **BRACKET))
        labels.append("border somewhere in between")
    if any(points.intervals for points in picture.point_sets):
        handles.append(Line2D((), (), color=INK, marker="|", **INTERVAL))
        labels.append("95 % interval")
    legend = figure.legend(handles, labels, loc="upper left", bbox_to_anchor=(left - 0.008, top - 0.085), frameon=False,
                           fontsize=10, labelcolor=INK, handletextpad=0.4)
    legend.set_in_layout(False)
    height = top - 0.12 - 0.032 * max(len(labels), 1)
    known = (("Result", summary_rows(scenario, progress) + finding_rows(progress)
              + assessment_rows(assessment)),
             ("Identity", short_rows(progress.identity)),
             ("Parameters", parameter_rows(scenario, progress)), ("Test", session_rows(progress)))
    tables = [(heading, rows) for heading, rows in known if rows]
    # Each table has a heading, and a gap of one row below it.
    row = min(_ROW, (height - _BOTTOM) / sum(len(rows) + 2 for _, rows in tables))
    for heading, rows in tables:
        height = _write_table(figure, heading, rows, (left, height), row) - row
    _write_signatures(figure, progress)


def _write_signatures(figure: Figure, progress: Progress) -> None:
    """Draw a signature line for the person who measured, and one for the person who checks."""
    bottom = 0.02
    for signatory in reversed(signatories(progress.identity)):
        for (left, right), text in zip(_SIGN_COLUMNS, (signatory.role, DATE, SIGNATURE)):
            figure.add_artist(Line2D((left, right), (bottom + 0.014, bottom + 0.014), color=INK, linewidth=0.6))
            figure.text(left, bottom + 0.011, text, fontsize=6.5, color="#546e7a", va="top")
        figure.text(_SIGN_COLUMNS[0][0], bottom + 0.018, signatory.name, fontsize=8, color=INK, va="bottom")
        bottom += _SIGN_ROW


def _write_table(figure: Figure, heading: str, rows: list[Row], corner: tuple[float, float], row: float) -> float:
    """Write the rows of a table; return the height at which it ends."""
    left, top = corner
    size = _TEXT_POINTS * row / _ROW
    figure.text(left, top, heading, fontsize=size + 1.5, fontweight="bold", color=INK, va="top")
    for name, value in rows:
        top -= row
        figure.text(left, top, name, fontsize=size, color="#546e7a", va="top")
        figure.text(0.985, top, value, fontsize=size, color=INK, va="top", ha="right")
    return top - row
