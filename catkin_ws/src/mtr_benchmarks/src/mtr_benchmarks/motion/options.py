"""What the parts of the motion benchmark are given."""
# SPDX-License-Identifier: Apache-2.0
from typing import NamedTuple


class MotionOptions(NamedTuple):
    """Attributes:
        pairs: of waypoints.
        seed: of everything random.
        jobs: processes at the same time.
    """

    pairs: int = 200
    seed: int = 1
    jobs: int = 2
