"""What a message's fields do to numbers on their way between nodes, so that both ways of running the cores agree."""
# SPDX-License-Identifier: Apache-2.0
import functools
import math
from typing import List, Sequence, Tuple

import numpy as np

from mtr_core.arrays import FloatArray
from mtr_core.conversions import stamp_of
from mtr_msgs.msg import DesiredState, Problem
from mtr_simulation.sensors.readings import Scan, WheelOdometry

# Code, text, names and values of a C++ core's problem.
ProblemTuple = Tuple[str, str, List[str], List[str]]
# Columns of a SurfaceMap's surfaces that are float32; the last one, of hits, is a uint16.
_FLOAT_COLUMNS = 5
_MAX_HITS = 65535


@functools.lru_cache(maxsize=256)
def single(value: float) -> float:
    """A number that was float32 for a while."""
    return float(np.float32(value))


# All messages of a tick have its stamp, which nobody changes.
stamp = functools.lru_cache(maxsize=8)(stamp_of)


def scan(made: Scan) -> Scan:
    """A sweep that was a LaserScan."""
    return _as_sent(made[1:-1])._replace(stamp_ns=made.stamp_ns, ranges_m=made.ranges_m)


@functools.lru_cache(maxsize=8)
def _as_sent(numbers: Tuple[float, ...]) -> Scan:
    """What all sweeps of a LiDAR say alike; without stamp and ranges."""
    return Scan._make((0, *map(single, numbers), np.empty(0)))


def odometry(made: WheelOdometry) -> WheelOdometry:
    """Odometry whose heading was a quaternion."""
    z, w = math.sin(made.heading_rad / 2.0), math.cos(made.heading_rad / 2.0)
    return made._replace(heading_rad=math.atan2(2.0 * (w * z), 1.0 - 2.0 * (z * z)))


def surfaces(rows: FloatArray) -> FloatArray:
    """Rows of a map that were columns of a SurfaceMap."""
    rounded = rows.copy()
    rounded[:, :_FLOAT_COLUMNS] = rows[:, :_FLOAT_COLUMNS].astype(np.float32)
    rounded[:, _FLOAT_COLUMNS] = np.clip(rows[:, _FLOAT_COLUMNS], 0, _MAX_HITS)
    return rounded


def desired(made: DesiredState) -> DesiredState:
    """Orders with a press that was a ButtonPress."""
    made.press.strength, made.press.duration_s = float(np.float32(made.press.strength)), single(made.press.duration_s)
    return made


def problems(tuples: Sequence[ProblemTuple]) -> List[Problem]:
    """Problems of a C++ core as messages have them."""
    return [Problem(code=code, text=text, names=names, values=values) for code, text, names, values in tuples]
