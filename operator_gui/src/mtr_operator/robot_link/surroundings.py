"""Converts the robot's view of its surroundings to and from its message; implausible points are dropped, because
nothing is measured with them."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import itertools
import math
from typing import Iterable, Sequence

from mtr_operator.domain.geometry.pose import Point
from mtr_operator.domain.surroundings import StopZone, Surroundings
from mtr_proto import robot_link_pb2 as pb

_CM_PER_M = 100.0
# More than any robot sends: 500 returns and 200 points of the path.
_MAX_POINTS = 4096
_MAX_OBSTACLE_M = 100.0


def surroundings_from(message: pb.Surroundings) -> Surroundings:
    """Return the surroundings as a type of the domain."""
    distance_m, bearing_rad = message.obstacle_m, message.obstacle_bearing_rad
    is_there = message.HasField("obstacle_m") and 0.0 <= distance_m < _MAX_OBSTACLE_M and math.isfinite(bearing_rad)
    return Surroundings(_points(message.points_cm), _points(message.path_cm), StopZone(message.zone),
                        (distance_m, bearing_rad) if is_there else None)


def surroundings_message(seen: Surroundings) -> pb.Surroundings:
    """Return the message that a robot sends."""
    message = pb.Surroundings(points_cm=_centimetres(seen.points), path_cm=_centimetres(seen.path),
                              zone=seen.zone.value)
    if seen.obstacle is not None:
        message.obstacle_m, message.obstacle_bearing_rad = seen.obstacle
    return message


def _points(numbers: Sequence[int]) -> tuple[Point, ...]:
    near = itertools.islice(numbers, 2 * _MAX_POINTS)
    pairs = iter([number / _CM_PER_M for number in near])
    return tuple(zip(pairs, pairs))


def _centimetres(points: Iterable[Point]) -> list[int]:
    return [round(value * _CM_PER_M) for point in points for value in point]
