"""Fastest starts, stops and turns with the lift fully up: the load that is left on the lightest wheel."""
# SPDX-License-Identifier: Apache-2.0
from typing import Any, Dict, List, Tuple

import mtr_drive_control_core as core

from mtr_core.se2 import Pose2
from mtr_simulation import robot
from mtr_simulation.scenario import Scenario

from .rig import TICK_S, Rig, Wish

FAR_AWAY = Pose2(60.0, 0.0, 0.0)
FAST, TURN = 2.0, 4.0
# Yaw rate wanted at FAST: radii of 8, 4, 2, 1, 0.5 and 0.25 m.
CURVES = {"very wide": 0.25, "wide": 0.5, "gentle": 1.0, "medium": 2.0, "tight": 4.0, "very tight": 8.0}
DRIVING_S, STOPPING_S = 3.0, 1.0

# What is wanted before, and what then: another wish, or a lock, which is the emergency stop.
MANOEUVRES: Dict[str, Tuple[Wish, Any]] = {
    "emergency stop forwards": ((FAST, 0.0), "lock"),
    "emergency stop backwards": ((-FAST, 0.0), "lock"),
    **{f"emergency stop in a {kind} {side} curve {way}": ((sign * FAST, turn), "lock")
       for kind, yaw in CURVES.items() for side, turn in (("left", yaw), ("right", -yaw))
       for way, sign in (("forwards", 1.0), ("backwards", -1.0))},
    "emergency stop of a turn on the spot": ((0.0, TURN), "lock"),
    "start backwards out of full speed": ((FAST, 0.0), (-FAST, 0.0)),
    "turn in at full speed": ((FAST, 0.0), (FAST, TURN)),
    "from curve to curve": ((FAST, TURN), (FAST, -TURN)),
    "from turn to turn on the spot": ((0.0, TURN), (0.0, -TURN)),
}


def run(_options: Any) -> Dict[str, object]:
    """tip_margin_n: least force of the ground on any wheel, in N, seen every 20 ms."""
    loads = {name: least_load_n(before, then) for name, (before, then) in MANOEUVRES.items()}
    standing = Rig(_site(), 1, lift_m=robot.LIFT_STROKE_M)
    return {
        "tip_margin_n": round(min(loads.values()), 2),
        "least_load_n": {name: round(load, 2) for name, load in loads.items()},
        "standing_load_n": [round(load, 2) for load in standing.sim.wheel_loads_n()],
        "limits": core.limits_at(robot.KEY_HEIGHT_AT_LOWER_STOP_M + robot.LIFT_STROKE_M),
    }


def least_load_n(before: Wish, then: Any) -> float:
    """Least load of any wheel from the start of the first wish on."""
    rig = Rig(_site(), 1, lift_m=robot.LIFT_STROKE_M)
    loads = _drive(rig, before, DRIVING_S)
    loads += _drive(rig, before, STOPPING_S, locked=True) if then == "lock" else _drive(rig, then, DRIVING_S)
    return min(loads)


def _drive(rig: Rig, wish: Wish, duration_s: float, locked: bool = False) -> List[float]:
    """Least load of each tick."""
    loads = []
    for _ in range(round(duration_s / TICK_S)):
        rig.step(wish, locked)
        loads.append(min(rig.sim.wheel_loads_n()))
    return loads


def _site() -> Scenario:
    return Scenario(world_from_car=FAR_AWAY, start_in_car=FAR_AWAY.inverse(), start_offset_m=0.0, start_offset_rad=0.0)
