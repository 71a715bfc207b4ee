"""Figures that show each text as it was typed."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from typing import Any

import matplotlib
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure


def plain_figure(size_inch: tuple[float, float], **options: Any) -> Figure:
    """Return a figure with a canvas. Dollar signs are plain text in titles, legends, tick labels and annotations.

    options: further arguments of matplotlib's Figure.
    """
    # Names of Cars, keys and people are drawn; as mathematics they would be changed, or raise an exception.
    matplotlib.rcParams["text.parse_math"] = False
    figure = Figure(figsize=size_inch, **options)
    FigureCanvasAgg(figure)
    return figure
