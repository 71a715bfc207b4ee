"""Stopping distances that follow from drive control's defaults. No ROS inside."""
# SPDX-License-Identifier: Apache-2.0
from typing import Dict, Tuple

from code_defaults import defaults

RAISED_M, LOW_M = 1.55, 0.35
SPEEDS_MPS = (0.1, 0.2, 0.3, 0.5)
_GRAVITY_MPS2 = 9.81
_CONTROL = "mtr_drive_control"


def value(name: str, where: str = _CONTROL) -> float:
    """The one default of a parameter."""
    (found,) = defaults(where)[name]
    return float(found)


def deceleration_mps2(key_height_m: float) -> float:
    """Emergency deceleration with the key at this height, as `limits_at` of drive control."""
    height_m = value("centre_of_mass_m") + value("centre_of_mass_rise") * key_height_m
    tipping = value("tip_margin") * _GRAVITY_MPS2 * value("tip_lever_along_m") / height_m
    return min(value("emergency_linear_deceleration_mps2"), tipping)


def fastest_mps(key_height_m: float) -> float:
    """Highest speed from which a stop ends within the time for it."""
    return deceleration_mps2(key_height_m) * value("kStopWithinS")


def delays_s(speed_mps: float) -> Dict[str, float]:
    """Time from an event to the decision to stop, at a speed."""
    is_fast = speed_mps > value("fast_mps", "mtr_dispatcher")
    return {"Decision": 0.0, "Silent LiDAR": value("lidar_timeout_s"),
            "Lost link": value("fast_link_timeout_s" if is_fast else "link_timeout_s", "mtr_dispatcher"),
            "Controller that repeats its last message": value("frozen_after_s", "mtr_controller_input")}


def distance_m(speed_mps: float, delay_s: float, key_height_m: float) -> float:
    """Path from the event to standstill on level ground with enough friction."""
    return speed_mps * (delay_s + value("reaction_s")) + speed_mps ** 2 / (2.0 * deceleration_mps2(key_height_m))


def columns() -> Tuple[Tuple[float, float], ...]:
    """Speed and key height of each column."""
    planned_mps = value("max_linear_mps", "mtr_motion_planner/limits.py")
    return (*((speed_mps, RAISED_M) for speed_mps in (*SPEEDS_MPS, planned_mps)),
            *((fastest_mps(height_m), height_m) for height_m in (RAISED_M, LOW_M)))
