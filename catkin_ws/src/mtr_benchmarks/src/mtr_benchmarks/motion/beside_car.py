"""Drives next to the Car and in the rain without a person in the way: every stop is a false one."""
# SPDX-License-Identifier: Apache-2.0
import math
from dataclasses import dataclass, replace
from typing import List, NamedTuple, Tuple

from mtr_core.se2 import Pose2, wrap_angle
from mtr_simulation.physics.robot import shipped_robot
from mtr_simulation.site.car_shape import CarShape
from mtr_simulation.site.scenario import named_scenario

from .rig import FRONT_M, SLOWED, STOPPED, TICK_S, Rig, Velocity

ROBOT = shipped_robot()
MIN_DISTANCE_M, MAX_DISTANCE_M = 0.3, 2.5
# Name, start in frame car, length in m, speed in m/s.
Way = Tuple[str, Pose2, float, float]
MEASURING_MPS = 0.4
LAP_MPS = 0.8
LIMIT_S = 40.0
TURNING_S = 1.0
# Longest reverse drive without a rear LiDAR, except on an axis; robot.launch gives the planner the same limit.
MAX_REVERSE_M = 1.0
HALF_WIDTH_M = 0.215
SITE = replace(named_scenario("lot"), start_offset_m=0.0, start_offset_rad=0.0)


@dataclass(frozen=True)
class StraightDrive:
    """Straight drive from a pose in frame car and back again.

    Attributes:
        name: kind of the drive.
        start: pose in frame car.
        length_m: length of the straight path.
        speed_mps: speed in both directions.
        rain: share of beams that end on a raindrop.
        rear_lidar: the robot has a rear LiDAR.
    """

    name: str
    start: Pose2
    length_m: float
    speed_mps: float
    rain: float
    rear_lidar: bool
    seed: int


def drives(car: CarShape) -> List[StraightDrive]:
    """Return all axes of the Car and paths along its sides, dry and in the rain, and long drives in rain far from the
    Car."""
    places = [*_axes(car), *_sides(car)]
    found = [StraightDrive(name, start, length, speed, rain, rear, seed)
             for seed, (name, start, length, speed) in enumerate(places) for rain in (0.0, 0.01)
             for rear in (True, False)]
    alone = Pose2(6.0, -6.0, math.pi / 2.0)
    return [*found, *(StraightDrive("rain", alone, 8.0, 1.0, 0.02, True, 1000 + seed) for seed in range(10))]


class DriveEnd(NamedTuple):
    """Result of a drive.

    Attributes:
        stops: message of drive control at each stop.
        slowed_s: time for which it was slowed.
        ends: number of reached ends of the path, 0 to 2.
    """

    stops: List[str]
    slowed_s: float
    ends: int


def simulate(drive: StraightDrive) -> DriveEnd:
    """Drive; record the false stops of drive control and the reached ends."""
    rig = Rig(replace(SITE, start_in_car=drive.start), drive.seed, drive.rear_lidar, drive.rain,
              ROBOT.key.lift_travel_m)
    slowed_s, was_blocked = 0.0, False
    ends, sentences = [], []
    begin_m = 0.0 if drive.rear_lidar or drive.name == "axis" else drive.length_m - MAX_REVERSE_M
    for sign in (1.0, -1.0):
        for _ in range(round(LIMIT_S / TICK_S)):
            along, velocity = _wanted(drive, rig.sim.truth().car_from_base, sign)
            if (along >= drive.length_m) if sign > 0.0 else (along <= begin_m):
                ends.append(along)
                break
            decision = rig.step(velocity)
            blocked = decision.zone >= STOPPED
            if blocked and not was_blocked:
                sentences.append(decision.message)
            slowed_s += TICK_S if decision.zone == SLOWED else 0.0
            was_blocked = blocked
        _stand(rig, TURNING_S)
    return DriveEnd(sentences, slowed_s, len(ends))


def _stand(rig: Rig, duration_s: float) -> None:
    for _ in range(round(duration_s / TICK_S)):
        rig.step((0.0, 0.0))


def _wanted(drive: StraightDrive, pose: Pose2, sign: float) -> Tuple[float, Velocity]:
    """Return the position along the line, and the velocity that follows it."""
    off = drive.start.inverse() @ pose
    speed = sign * drive.speed_mps if may_move(off) else 0.0
    turn = -1.5 * wrap_angle(off.heading) - sign * 2.0 * off.y
    return off.x, (speed, max(-0.5, min(0.5, turn)))


def may_move(off: Pose2) -> bool:
    """Return False if the robot has left its line, which would cause contacts by itself."""
    return abs(off.y) < 0.1 and abs(wrap_angle(off.heading)) < 0.2


def _axes(car: CarShape) -> List[Way]:
    """Return axes of all sides and corners, facing the Car, up to the smallest distance of the key."""
    half_length, half_width = car.length_m / 2.0, car.width_m / 2.0
    feet = [(half_length, y, 0.0) for y in (-0.6, 0.0, 0.6)] + [(-half_length, y, math.pi) for y in (-0.6, 0.0, 0.6)]
    feet += [(x, side * half_width, side * math.pi / 2.0) for side in (1.0, -1.0) for x in (-1.5, -0.5, 0.5, 1.5)]
    feet += [(x * half_length, y * half_width, math.atan2(y, x)) for x in (1.0, -1.0) for y in (1.0, -1.0)]
    found = []
    for x, y, outward in feet:
        far = MAX_DISTANCE_M + FRONT_M
        start = Pose2(x + far * math.cos(outward), y + far * math.sin(outward), outward + math.pi)
        found.append(("axis", start, MAX_DISTANCE_M - MIN_DISTANCE_M, MEASURING_MPS))
    return found


def _sides(car: CarShape) -> List[Way]:
    """Return paths along each side, with the footprint at the smallest distance."""
    x, y = car.length_m / 2.0 + MIN_DISTANCE_M + HALF_WIDTH_M, car.width_m / 2.0 + MIN_DISTANCE_M + HALF_WIDTH_M
    return [("along", Pose2(-3.5, y, 0.0), 7.0, LAP_MPS), ("along", Pose2(3.5, -y, math.pi), 7.0, LAP_MPS),
            ("across", Pose2(x, -2.5, math.pi / 2.0), 5.0, LAP_MPS),
            ("across", Pose2(-x, 2.5, -math.pi / 2.0), 5.0, LAP_MPS)]
