"""Position errors as colours on the protocol, with the colour scale in cm."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from matplotlib.axes import Axes
from matplotlib.cm import ScalarMappable
from matplotlib.colors import ListedColormap, Normalize
from matplotlib.figure import Figure

from mtr_operator.domain.results.diverging import colour_of_error, scale_of
from mtr_operator.domain.results.picture import PointSet

from ..protocol_panel import INK

_SHADES = 201
_CM_PER_M = 100.0
# Parts of the sheet: left, bottom, width, height; above the drawing.
_SCALE_BOX = (0.24, 0.955, 0.24, 0.014)


def draw_errors(axes: Axes, points: PointSet) -> None:
    """Draw each point in the colour of its error, with a ring, so that a point without an error is visible too."""
    scale_m = scale_of(points.errors_m)
    colours = [tuple(part / 255.0 for part in colour_of_error(error_m, scale_m)) for error_m in points.errors_m]
    axes.scatter([y for _, y in points.known], [x for x, _ in points.known], s=70, c=colours, edgecolors=INK,
                 linewidths=0.7, zorder=6, label=f"{points.label} ({len(points.known)})")


def draw_scale(figure: Figure, points: PointSet) -> None:
    """Draw the colour scale; nothing for points without errors."""
    if not points.errors_m:
        return
    scale_m = scale_of(points.errors_m)
    shades = [tuple(part / 255.0 for part in colour_of_error(2.0 * index / (_SHADES - 1) - 1.0, 1.0))
              for index in range(_SHADES)]
    mapped = ScalarMappable(Normalize(-_CM_PER_M * scale_m, _CM_PER_M * scale_m), ListedColormap(shades))
    bar = figure.colorbar(mapped, cax=figure.add_axes(_SCALE_BOX), orientation="horizontal")
    bar.ax.tick_params(labelsize=7, colors=INK, length=2)
    bar.ax.set_title("error: reported less measured [cm]", fontsize=7, color=INK, pad=3)
