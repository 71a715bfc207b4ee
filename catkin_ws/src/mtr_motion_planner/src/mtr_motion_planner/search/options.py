"""Ways to leave a start and to reach a goal: straight out from close to the Car, straight in, or turning there."""
# SPDX-License-Identifier: Apache-2.0
import math
from dataclasses import dataclass
from typing import List, Sequence

import numpy as np

from mtr_core.arrays import FloatArray
from mtr_core.se2 import Pose2
from mtr_core.states import Direction

from .. import problems
from ..geometry.keep_out import ROUNDING_M, KeepOut
from ..geometry.route import moved
from ..parameters import MotionParameters
from ..timing.plan import PlanRefused

STEP_M = 0.05
MAX_STRAIGHT_M = 6.0
# A correction reaches the goal on a straight segment, on which the error across its axis is removed.
CORRECTION_RUN_IN_M = 0.5
SIGNS = {Direction.ANY: (1, -1), Direction.FORWARD: (1,), Direction.BACKWARD: (-1,)}


@dataclass(frozen=True)
class StraightPiece:
    """Straight segment of a length in m at the start or at the goal; sign -1: backwards, 0: none."""

    sign: int = 0
    length: float = 0.0


NONE = StraightPiece()


@dataclass(frozen=True)
class Target:
    """Goal pose of the turn centre; a correction starts nearby."""

    pose: Pose2
    direction: Direction = Direction.ANY
    is_correction: bool = False


def departures(start: Pose2, keep_out: KeepOut) -> List[StraightPiece]:
    """Return NONE if the robot may turn, else the shortest straight ways out; raises PlanRefused without any."""
    if keep_out.turn_distance(start) >= keep_out.pivot_gap_m:
        return [NONE]
    found = [StraightPiece(sign, length) for sign in (-1, 1)
             for length in _free_after(start, sign, keep_out.least_room(start), keep_out)]
    if keep_out.distance(start) >= keep_out.pivot_gap_m:
        found.append(NONE)  # The key may be turned away from the Car.
    if not found:
        raise PlanRefused(problems.HEMMED_IN())
    return found


def arrivals(goal: Target, keep_out: KeepOut, parameters: MotionParameters) -> List[StraightPiece]:
    """Return straight segments into the goal, NONE if the robot may turn there; raises PlanRefused without any."""
    if keep_out.turn_distance(goal.pose) >= keep_out.pivot_gap_m:
        return _after_a_turn(goal, parameters)
    least_room = np.full(2, -ROUNDING_M)
    found = [StraightPiece(sign, length + parameters.run_in_m) for sign in SIGNS[goal.direction]
             for length in _free_after(goal.pose, -sign, least_room, keep_out)]
    if keep_out.distance(goal.pose) >= keep_out.pivot_gap_m:
        found += _after_a_turn(goal, parameters)  # turn of a key next to the Car
    if not found:
        raise PlanRefused(problems.NO_STRAIGHT_PIECE())
    return found


def _after_a_turn(goal: Target, parameters: MotionParameters) -> List[StraightPiece]:
    if goal.is_correction:
        return [StraightPiece(sign, max(parameters.run_in_m, CORRECTION_RUN_IN_M)) for sign in (1, -1)]
    if goal.direction == Direction.ANY:
        return [NONE]
    return [StraightPiece(sign, parameters.run_in_m) for sign in SIGNS[goal.direction]]


def _free_after(pose: Pose2, sign: int, least_room: FloatArray, keep_out: KeepOut) -> Sequence[float]:
    """Return the length of the shortest free straight segment from the pose to a place for a turn, if any."""
    lengths = STEP_M * np.arange(1, math.ceil(MAX_STRAIGHT_M / STEP_M))
    poses = np.column_stack((pose.x + sign * lengths * math.cos(pose.heading),
                             pose.y + sign * lengths * math.sin(pose.heading), np.full_like(lengths, pose.heading)))
    clear = (keep_out.room(poses) >= least_room).all(axis=1)
    for length, is_clear in zip(lengths.tolist(), clear.tolist()):
        if not is_clear:
            return ()
        if keep_out.turn_distance(moved(pose, sign * length)) >= keep_out.route_gap_m:
            return (length,)
    return ()
