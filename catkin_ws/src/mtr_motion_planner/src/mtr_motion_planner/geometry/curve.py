"""A curve that the robot can follow without a stop: the curvature is piecewise linear in the distance."""
# SPDX-License-Identifier: Apache-2.0
import math
from dataclasses import dataclass
from typing import List, Sequence, Tuple

import numpy as np

from mtr_core.arrays import FloatArray
from mtr_core.se2 import Pose2

STEP_M = 0.03


@dataclass(frozen=True)
class CurvePiece:
    """Arc or straight line: curvature in 1/m, positive to the left of travel, and length in m."""

    curvature: float
    length: float


@dataclass(frozen=True)
class Curve:
    """Samples (n,) at equal distances along the path, in the frame of the plan.

    Attributes:
        step_m: distance between two samples.
        x, y: m.
        heading: direction of travel, rad, without jumps of a whole turn.
        curvature: 1/m, positive to the left of travel.
        bend: change of curvature, 1/m2.
    """

    step_m: float
    x: FloatArray
    y: FloatArray
    heading: FloatArray
    curvature: FloatArray
    bend: FloatArray

    @property
    def length(self) -> float:
        """Length in m."""
        return self.step_m * (len(self.x) - 1)

    @property
    def start(self) -> Pose2:
        """First pose."""
        return Pose2(float(self.x[0]), float(self.y[0]), float(self.heading[0]))

    @property
    def end(self) -> Pose2:
        """Last pose."""
        return Pose2(float(self.x[-1]), float(self.y[-1]), float(self.heading[-1]))


    def after(self, first: int) -> "Curve":
        """Return the rest from a sample on."""
        return Curve(self.step_m, self.x[first:], self.y[first:], self.heading[first:], self.curvature[first:],
                     self.bend[first:])

    def slid(self, aside: FloatArray) -> "Curve":
        """Return the curve with the same headings, shifted to the left by a length in each step between samples."""
        steps = np.diff(self.x) + 1j * np.diff(self.y)
        steps = steps + aside * np.exp(0.5j * (self.heading[1:] + self.heading[:-1] + math.pi))
        places = np.concatenate(([0.0], np.cumsum(steps)))
        return Curve(self.step_m, self.x[0] + places.real, self.y[0] + places.imag, self.heading, self.curvature,
                     self.bend)


def merged(pieces: Sequence[CurvePiece], gap_m: float) -> List[CurvePiece]:
    """Return the pieces without empty ones; arcs of the same sense with a short line between them become one."""
    kept: List[CurvePiece] = []
    for piece in pieces:
        if piece.length < 1e-6:
            continue
        kept.append(piece)
        if len(kept) > 2 and kept[-2].curvature == 0.0 and kept[-2].length < gap_m \
                and kept[-3].curvature * kept[-1].curvature > 0.0:
            kept[-3:] = [_one_arc(kept[-3:])]
        elif len(kept) > 1 and (kept[-2].curvature * kept[-1].curvature > 0.0
                                or kept[-2].curvature == kept[-1].curvature):
            kept[-2:] = [_one_arc(kept[-2:])]
    return kept


def _one_arc(pieces: Sequence[CurvePiece]) -> CurvePiece:
    length = sum(piece.length for piece in pieces)
    return CurvePiece(sum(piece.curvature * piece.length for piece in pieces) / length, length)


def breakpoints(pieces: Sequence[CurvePiece], widths: Sequence[float], first_curvature: float
                ) -> Tuple[List[float], List[float]]:
    """Return distances and curvatures between which the curvature is linear.

    widths has one entry for the start, where the curvature comes from first_curvature, and one for each joint. A ramp
    is centred on its joint, which preserves the turned angle; pieces that are too short shorten it.
    """
    lengths = [piece.length for piece in pieces]
    distances, values = [0.0], [first_curvature]
    used = min(widths[0], 0.5 * lengths[0]) if first_curvature != pieces[0].curvature else 0.0
    if used > 0.0:
        distances.append(used)
        values.append(pieces[0].curvature)
    joint = 0.0
    for index, (piece, following) in enumerate(zip(pieces, pieces[1:])):
        joint += piece.length
        last = index + 2 == len(pieces)
        room = min(piece.length - used, 0.5 * following.length if not last else following.length)
        half = min(0.5 * widths[index + 1], room)
        distances += [joint - half, joint + half]
        values += [piece.curvature, following.curvature]
        used = half
    distances.append(joint + lengths[-1])
    values.append(pieces[-1].curvature)
    return distances, values


def trace(start: Pose2, distances: Sequence[float], values: Sequence[float]) -> Curve:
    """Return samples of the curve that starts at the pose."""
    steps = max(2, math.ceil(distances[-1] / STEP_M))
    step = distances[-1] / steps
    along = np.linspace(0.0, distances[-1], steps + 1)
    curvature = np.interp(along, distances, values)
    middle = np.interp(along[:-1] + 0.5 * step, distances, values)
    # Simpson's rule is exact for the angle inside one clothoid; the chord has the direction of its middle.
    turned = (curvature[:-1] + 4.0 * middle + curvature[1:]) * (step / 6.0)
    heading = start.heading + np.concatenate(([0.0], np.cumsum(turned)))
    chord = heading[:-1] + 0.5 * turned + (curvature[:-1] - curvature[1:]) * (step / 12.0)
    length = step * (1.0 - (step * middle) ** 2 / 24.0)
    x = start.x + np.concatenate(([0.0], np.cumsum(length * np.cos(chord))))
    y = start.y + np.concatenate(([0.0], np.cumsum(length * np.sin(chord))))
    bend = np.concatenate((np.diff(curvature) / step, [0.0]))
    return Curve(step, x, y, heading, curvature, bend)
