"""Assignment of surfels to the outline of a Car."""
# SPDX-License-Identifier: Apache-2.0
import numpy as np

from mtr_core.arrays import BoolArray, FloatArray

from ..rectangle import Rectangle
from ..surfels import Surfels

# A surfel belongs to the Car if it is this near its outline and faces outwards; sills and round corners are inside.
BEYOND_M, DEPTH_M = 0.08, 0.40
MIN_OUTWARD_COSINE = 0.3


def belongs(in_car: Surfels, car: Rectangle, beyond_m: float = BEYOND_M) -> BoolArray:
    """Return a mask of the surfels, in the Car's frame, that its outline explains."""
    outside = car.outside(in_car.position)
    return (outside <= beyond_m) & (outside >= -DEPTH_M) & (facing(in_car, car) > MIN_OUTWARD_COSINE)


def facing(in_car: Surfels, car: Rectangle) -> FloatArray:
    """Return the cosine between each normal and the direction away from the Car."""
    return np.sum(in_car.normal * car.outwards(in_car.position), axis=1)
