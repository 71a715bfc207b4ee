"""Shape of a car from above: its parts as polygons for drawings.

A corner is (part of the half length towards the front, part of the half width towards the left).
"""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from typing import Sequence

from mtr_operator.domain.geometry.pose import Point

# Radius of the body's corners, as a part of the width.
ROUNDING_PART = 0.16
WINDSCREEN = ((0.38, -0.80), (0.38, 0.80), (0.14, 0.66), (0.14, -0.66))
REAR_WINDOW = ((-0.74, -0.74), (-0.74, 0.74), (-0.56, 0.64), (-0.56, -0.64))
SIDE_WINDOW = ((0.26, 0.84), (-0.62, 0.80), (-0.52, 0.70), (0.12, 0.72))
HEADLAMP = ((0.97, 0.42), (0.94, 0.78), (0.86, 0.86), (0.90, 0.46))
TAIL = ((-0.985, 0.50), (-0.955, 0.84), (-0.91, 0.90), (-0.94, 0.52))


def scaled(part: Sequence[Point], half_length: float, half_width: float) -> list[Point]:
    """Return the corners of a part in the Car coordinate system, in m."""
    return [(ahead * half_length, across * half_width) for ahead, across in part]


def mirrored(part: Sequence[Point]) -> list[Point]:
    """Return the same part on the other side."""
    return [(ahead, -across) for ahead, across in part]
