"""What the locator asks of localization's mapper, and what it gets."""
# SPDX-License-Identifier: Apache-2.0
import enum
from dataclasses import dataclass

from mtr_core.arrays import FloatArray
from mtr_core.problems import NO_PROBLEM, Problem

from ..scan import NO_BIAS, RangeBias
from ..surfels import Surfels


class MapPhase(enum.IntEnum):
    """What localization's mapper shall do, as in MappingOrder."""

    IDLE = 0
    COLLECT = 1
    FREEZE = 2


@dataclass(frozen=True)
class SurfaceMap:
    """Localization's adjusted map.

    Attributes:
        map_id: number of the survey that it was made for.
        revision: poses with this number are in it.
        key_frames: rows (time in s, x, y, heading) of base_link.
        message: why it is not valid.
        range_bias: constant errors of the LiDARs' ranges, which the surfels are free of.
    """

    map_id: int
    revision: int
    valid: bool
    surfels: Surfels
    key_frames: FloatArray
    message: Problem = NO_PROBLEM
    range_bias: RangeBias = NO_BIAS
