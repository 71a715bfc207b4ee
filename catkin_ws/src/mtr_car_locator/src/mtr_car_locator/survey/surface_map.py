"""Requests to the mapper of localization, and its result."""
# SPDX-License-Identifier: Apache-2.0
import enum
from dataclasses import dataclass

from mtr_core.arrays import FloatArray
from mtr_core.problems import NO_PROBLEM, Problem

from ..scan import NO_BIAS, RangeBias
from ..surfels import Surfels


class MapPhase(enum.IntEnum):
    """Phase of the mapper, as in MappingOrder."""

    IDLE = 0
    COLLECT = 1
    FREEZE = 2


@dataclass(frozen=True)
class SurfaceMap:
    """Adjusted map of localization.

    Attributes:
        map_id: number of its survey.
        revision: number of poses in this map.
        key_frames: rows (time in s, x, y, heading) of base_link.
        message: reason if it is not valid.
        range_bias: constant range errors of the LiDARs, which the surfels are corrected for.
    """

    map_id: int
    revision: int
    valid: bool
    surfels: Surfels
    key_frames: FloatArray
    message: Problem = NO_PROBLEM
    range_bias: RangeBias = NO_BIAS
