"""What the Car's size leaves open: without its data sheet it is as large as the robot's LiDARs see it at their height.

A body may be wider or longer above that height, never narrower; so a distance from its outline may be too long. The
robot's sigma of length and width holds that as a root of the mean square (docs/accuracy.md, Limits).
"""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import math
from typing import Iterable

from ..geometry.ray import Ray
from ..robot_status import CarDimensions

# An inset that is as likely anywhere from 0 to its end has this end for a root of its mean square of 1.
_END_PER_SIGMA = math.sqrt(3.0)
# A data sheet is right to 5 mm, 1 sigma; what is farther off than this was not said by one.
_TOLD_FROM_M = 0.02
_CM_PER_M = 100.0


def size_excess(car: CarDimensions) -> float:
    """How much too long a distance from an end or side may be, in m; 0 where a data sheet says both sizes, or no size
    is known yet."""
    sigmas_m = [sigma_m / 2.0 for sigma_m in (car.length_sigma, car.width_sigma) if not math.isnan(sigma_m)]
    excess_m = _END_PER_SIGMA * max(sigmas_m, default=0.0)
    return excess_m if excess_m > _TOLD_FROM_M else 0.0


def size_cautions(rays: Iterable[Ray], car: CarDimensions) -> tuple[str, ...]:
    """A sentence when distances on one of these lines depend on a size that no data sheet has said."""
    along_m = [abs(ray.direction_x) * car.length_sigma / 2.0 + abs(ray.direction_y) * car.width_sigma / 2.0
               for ray in rays if (ray.origin_x, ray.origin_y) != (0.0, 0.0)]
    excess_m = _END_PER_SIGMA * max((each_m for each_m in along_m if not math.isnan(each_m)), default=0.0)
    if excess_m <= _TOLD_FROM_M:
        return ()
    excess_cm = _CM_PER_M * excess_m
    return (f"Without length and width of the Car's data sheet the distances may be up to {excess_cm:.0f} cm too long: "
            "the Car may be wider above the height at which the LiDARs see it. Start the robot with car_file, and map "
            "the Car again.",)
