"""Shapes in m, x to the right and y up, as a self-contained SVG without scripts and external content."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from html import escape
from typing import Sequence

Point = tuple[float, float]
# Longer side of a drawing in px; browsers scale it down to the page.
_SIZE = 640.0
_MARGIN = 46.0


class Drawing:
    """Collects shapes and scales them to the drawing. Kinds are classes of style.css."""

    def __init__(self, title: str, is_stretched: bool = False):
        """Create an empty drawing. is_stretched: x and y have independent scales, as in a chart."""
        self._title = title
        self._is_stretched = is_stretched
        self._shapes: list[tuple[str, tuple[Point, ...], str]] = []

    def line(self, points: Sequence[Point], kind: str, is_closed: bool = False, title: str = "") -> None:
        """Add a line through points. title: tooltip."""
        self._shapes.append(("polygon" if is_closed else "polyline", tuple(points), _class(kind) + _titled(title)))

    def dot(self, point: Point, kind: str, title: str = "") -> None:
        """Add a point."""
        self._shapes.append(("circle", (point,), _class(kind) + _titled(title)))

    def text(self, point: Point, words: str, kind: str = "label") -> None:
        """Add a text centred at a point."""
        self._shapes.append(("text", (point,), f"{_class(kind)}>{escape(words)}</text>"))

    def svg(self) -> str:
        """Return the SVG of all shapes."""
        points = [point for _, shape, _ in self._shapes for point in shape] or [(0.0, 0.0)]
        left, bottom = min(x for x, _ in points), min(y for _, y in points)
        width, height = max(x for x, _ in points) - left or 1.0, max(y for _, y in points) - bottom or 1.0
        across = _SIZE / width if self._is_stretched else _SIZE / max(width, height)
        up = _SIZE / 2.0 / height if self._is_stretched else across

        def placed(point: Point) -> tuple[float, float]:
            return _MARGIN + (point[0] - left) * across, _MARGIN + (height - (point[1] - bottom)) * up

        body = "".join(_element(kind, [placed(point) for point in shape], rest) for kind, shape, rest in self._shapes)
        return (f'<svg viewBox="0 0 {width * across + 2 * _MARGIN:.0f} {height * up + 2 * _MARGIN:.0f}" role="img" '
                f'aria-label="{escape(self._title)}" xmlns="http://www.w3.org/2000/svg">{body}</svg>')


def _class(kind: str) -> str:
    return f' class="{escape(kind)}"'


def _titled(title: str) -> str:
    return f"><title>{escape(title)}</title>" if title else "/>"


def _element(kind: str, points: Sequence[Point], rest: str) -> str:
    if kind in ("polyline", "polygon"):
        places = f'points="{" ".join(f"{x:.1f},{y:.1f}" for x, y in points)}"'
    elif kind == "circle":
        places = f'cx="{points[0][0]:.1f}" cy="{points[0][1]:.1f}" r="4"'
    else:
        places = f'x="{points[0][0]:.1f}" y="{points[0][1]:.1f}"'
    end = "" if rest.endswith(("/>", "</text>")) else f"</{kind}>"
    return f"<{kind} {places}{rest}{end}"
