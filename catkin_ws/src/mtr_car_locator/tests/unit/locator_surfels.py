"""Surfels of boxes and a guess of the Car, for tests."""
# SPDX-License-Identifier: Apache-2.0
import math

import numpy as np

from mtr_car_locator.find.prior import Prior
from mtr_car_locator.parameters import LocatorParameters
from mtr_car_locator.rectangle import Rectangle
from mtr_car_locator.surfels import Surfels, surfels_from
from mtr_core.se2 import Pose2

PARAMETERS = LocatorParameters()
ORIGIN = Pose2(0.0, 0.0, 0.0)
LENGTH_M, WIDTH_M, STEP_M, SIGMA_M = 4.5, 1.8, 0.1, 0.003
SIDES = {"front": (1.0, 0.0), "rear": (-1.0, 0.0), "left": (0.0, 1.0), "right": (0.0, -1.0)}


def box(pose=ORIGIN, sides=tuple(SIDES), length=LENGTH_M, width=WIDTH_M, seed=1):
    """Return rows of surfels on the sides of a box."""
    rng = np.random.default_rng(seed)
    rows = []
    for name in sides:
        nx, ny = SIDES[name]
        span = width if nx else length
        for along in np.arange(-0.5 * span + 0.5 * STEP_M, 0.5 * span, STEP_M):
            out = (0.5 * length if nx else 0.5 * width) + rng.normal(0.0, SIGMA_M)
            x, y = pose.apply(nx * out - ny * along, ny * out + nx * along)
            rows.append((x, y, math.atan2(ny, nx) + pose.heading, STEP_M, SIGMA_M, 50))
    return rows


def surfels(*things) -> Surfels:
    """Return all rows as surfels."""
    return surfels_from(np.array([row for rows in things for row in rows]))


def prior(x=0.0, y=0.0, heading=0.0):
    """Return a guess of the Car, from a robot at its front left corner."""
    pose = Pose2(x, y, heading)
    return Prior(Rectangle(pose, LENGTH_M, WIDTH_M), pose @ PARAMETERS.car_from_start)
