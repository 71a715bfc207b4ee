"""How far the Remote key may be from where a line wants it, and still be measured."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import math
from dataclasses import dataclass

from ..parameters import CENTIMETRES, DEGREE, KILOMETRES_PER_HOUR, ParameterSet, parameter


@dataclass(frozen=True)
class Tolerances(ParameterSet):
    """Parameters of every scenario.

    The planner keeps the robot within 3 cm and 1 degree of a straight piece. 10 cm beside an axis change the way from
    the key to a receiver 1 m behind the Car's side by 5 mm at most, far below the uncertainty of a distance.
    """

    lateral_tolerance_m: float = parameter(
        0.1, 0.005, 1.0, "m", "How far the Remote key may be beside the line when something is measured.",
        shown=CENTIMETRES)
    heading_tolerance_rad: float = parameter(
        5.0, 0.5, 45.0, "deg", "How far the robot may be turned from the line when something is measured.",
        file_key="heading_tolerance_deg", si_per_unit=math.pi / 180.0, shown=(DEGREE, 1.0))
    height_tolerance_m: float = parameter(
        0.05, 0.005, 0.5, "m", "How far the Remote key may be from its height while a line is measured.",
        shown=CENTIMETRES)
    speed_tolerance_mps: float = parameter(
        0.1, 0.01, 1.0, "m/s", "How much faster than wanted the robot may be when something is measured.",
        shown=KILOMETRES_PER_HOUR)
