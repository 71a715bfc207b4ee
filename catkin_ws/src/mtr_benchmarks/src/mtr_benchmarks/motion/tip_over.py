"""Fastest starts, stops and turns with the lift fully up: remaining load of the lightest wheel."""
# SPDX-License-Identifier: Apache-2.0
from dataclasses import dataclass
from typing import Dict, List, Optional, Tuple

import mtr_drive_control_core as core

from mtr_core.se2 import Pose2
from mtr_simulation.physics.robot import shipped_robot
from mtr_simulation.site.scenario import Scenario

from ..harness.rows import Requirement, Row
from .options import MotionOptions
from .rig import TICK_S, Rig, Velocity

ROBOT = shipped_robot()
FAR_AWAY = Pose2(60.0, 0.0, 0.0)
FAST, TURN = 2.0, 4.0
# Yaw rates at the speed FAST: radii of 8, 4, 2, 1, 0.5 and 0.25 m.
CURVES = {"very wide": 0.25, "wide": 0.5, "gentle": 1.0, "medium": 2.0, "tight": 4.0, "very tight": 8.0}
DRIVING_S, STOPPING_S = 3.0, 1.0
# A wheel without load is in the air.
MARGIN = Requirement("load of the lightest wheel, lift fully up", "N", must=1.0, at_least=True)

# Wanted velocity before, and then either another velocity or a lock (None), which is the emergency stop.
MANOEUVRES: Dict[str, Tuple[Velocity, Optional[Velocity]]] = {
    "emergency stop forwards": ((FAST, 0.0), None),
    "emergency stop backwards": ((-FAST, 0.0), None),
    **{f"emergency stop in a {kind} {side} curve {way}": ((sign * FAST, turn), None)
       for kind, yaw in CURVES.items() for side, turn in (("left", yaw), ("right", -yaw))
       for way, sign in (("forwards", 1.0), ("backwards", -1.0))},
    "emergency stop of a turn on the spot": ((0.0, TURN), None),
    "start backwards out of full speed": ((FAST, 0.0), (-FAST, 0.0)),
    "turn in at full speed": ((FAST, 0.0), (FAST, TURN)),
    "from curve to curve": ((FAST, TURN), (FAST, -TURN)),
    "from turn to turn on the spot": ((0.0, TURN), (0.0, -TURN)),
}


@dataclass(frozen=True)
class TipOverFigures:
    """Figures of all manoeuvres; the names are those in the file. tip_margin_n: least ground force on any wheel,
    sampled every 20 ms."""

    tip_margin_n: float
    least_load_n: Dict[str, float]
    standing_load_n: List[float]
    limits: Dict[str, float]

    def rows(self) -> List[Row]:
        """Return the row of the margin."""
        return [Row(MARGIN, self.tip_margin_n)]


def measure(_options: MotionOptions) -> TipOverFigures:
    """Measure the loads in all manoeuvres and at rest."""
    loads = {name: min_load_n(before, then) for name, (before, then) in MANOEUVRES.items()}
    standing = Rig(_site(), 1, lift_m=ROBOT.key.lift_travel_m)
    return TipOverFigures(
        round(min(loads.values()), 2), {name: round(load, 2) for name, load in loads.items()},
        [round(load, 2) for load in standing.sim.wheel_loads_n()],
        core.limits_at(ROBOT.key.max_height_m))


def min_load_n(before: Velocity, then: Optional[Velocity]) -> float:
    """Return the least load of any wheel from the start of the first motion on."""
    rig = Rig(_site(), 1, lift_m=ROBOT.key.lift_travel_m)
    loads = _drive(rig, before, DRIVING_S)
    loads += _drive(rig, before, STOPPING_S, locked=True) if then is None else _drive(rig, then, DRIVING_S)
    return min(loads)


def _drive(rig: Rig, velocity: Velocity, duration_s: float, locked: bool = False) -> List[float]:
    """Return the least load of any wheel at each tick."""
    loads = []
    for _ in range(round(duration_s / TICK_S)):
        rig.step(velocity, locked)
        loads.append(min(rig.sim.wheel_loads_n()))
    return loads


def _site() -> Scenario:
    return Scenario(world_from_car=FAR_AWAY, start_in_car=FAR_AWAY.inverse(), start_offset_m=0.0, start_offset_rad=0.0)
