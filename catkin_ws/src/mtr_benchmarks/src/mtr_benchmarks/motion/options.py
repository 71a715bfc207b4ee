"""Options of the parts of the motion benchmark."""
# SPDX-License-Identifier: Apache-2.0
from typing import NamedTuple


class MotionOptions(NamedTuple):
    """Options of the motion benchmark.

    Attributes:
        pairs: number of waypoint pairs.
        seed: seed of all random numbers.
        jobs: number of simultaneous processes.
    """

    pairs: int = 200
    seed: int = 1
    jobs: int = 2
