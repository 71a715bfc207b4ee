"""Slopes, slippery ground and a cable: wheel loads, stopping distances, and contacts with a wall."""
# SPDX-License-Identifier: Apache-2.0
import math
import multiprocessing
from dataclasses import dataclass
from typing import Dict, List, NamedTuple, Sequence, Tuple

from mtr_core.se2 import Pose2
from mtr_simulation.physics.robot import shipped_robot
from mtr_simulation.site.cables import Cable
from mtr_simulation.site.scenario import Scenario
from mtr_simulation.site.surroundings import Wall

from ..harness.rows import Requirement, Row
from .options import MotionOptions
from .rig import FRONT_M, STOPPED, TICK_S, Rig

ROBOT = shipped_robot()
FAR_AWAY = Pose2(60.0, 0.0, 0.0)
FAST_MPS = 2.0
DRIVING_S, STOPPING_S, PATIENCE_S = 2.5, 2.0, 20.0
STANDING_MPS = 0.01
PLANNER, HAND, DEAD = "planner", "hand", "dead"
LIFTS_M = {"low": 0.0, "raised": ROBOT.key.lift_travel_m}
# Direction of downhill in world; the robot faces along x.
DOWNHILL = {"downhill": 0.0, "uphill": math.pi, "across": 0.5 * math.pi}
SLOPES_DEG, STEEPER_DEG = (2.0, 3.0), (4.0, 6.0)
FRICTIONS = (0.3, 0.2, 0.15, 0.1)
# Lowest friction at which the tyres transmit the stop that drive control plans before a wall: 0.15 of the weight plus a
# margin.
PROMISED_FRICTION = 0.2
WALL_M, WALL_THICKNESS_M = 3.0, 0.2
# Walls along the path, so that both LiDARs have returns.
SIDE_M, SIDE_LENGTH_M = 6.0, 16.0
CABLE_M, CABLE_SPEEDS_MPS = 0.8, (0.2, 0.4, 0.7)

SLOPE = Requirement("load of the lightest wheel, stops on slopes of 2 and 3 deg", "N", must=1.0, at_least=True)
CLIMB = Requirement("load of the lightest wheel, stops by hand on slopes of 4 and 6 deg", "N", must=1.0, at_least=True)
WAY = Requirement("shortest way of these drives", "m", must=0.25, at_least=True)
STEEP_WAY = Requirement("way that the planner drives on a slope of 6 deg", "m", must=0.02)
DEAD_STOP = Requirement("load of the lightest wheel, drive control dies on 2 and 3 deg (stated)", "N", at_least=True)
CONTACTS = Requirement("contacts with a wall ahead, friction 0.2 and 0.3", "(count)", must=0.0)
SLIPPERY_CONTACTS = Requirement("contacts with a wall ahead, friction 0.1 and 0.15 (stated)", "(count)")
SLIPPERY_STOP = Requirement("longest emergency stop, friction 0.1 (stated)", "m")
CABLE_STOPS = Requirement("stops at a cable of 15 mm", "(count)", must=0.0)
CABLE_TILT = Requirement("largest tilt over a cable of 15 mm", "deg", must=8.0)
CABLE_LOAD = Requirement("load of the lightest wheel over a cable of 15 mm (stated)", "N", at_least=True)


class Drive(NamedTuple):
    """Drive of a robot that is then stopped.

    Attributes:
        key: low or raised.
        speed_mps: commanded speed along x.
        driver: planner, hand, or dead: drive control dies instead of receiving a lock.
        slope_deg, way: slope of the ground, and direction of downhill.
        obstacle: none, wall or cable; without a commanded stop if there is an obstacle.
    """

    key: str
    speed_mps: float = FAST_MPS
    driver: str = PLANNER
    slope_deg: float = 0.0
    way: str = "downhill"
    friction: float = 0.5
    obstacle: str = ""
    seed: int = 1

    @property
    def name(self) -> str:
        """Name of the drive in the file."""
        ground = f"{self.slope_deg:g} deg {self.way}" if self.slope_deg else f"friction {self.friction:g}"
        way = "fast" if self.speed_mps > 0.0 else "back"
        speed = way if abs(self.speed_mps) == FAST_MPS else f"{self.speed_mps:g} m/s"
        return " ".join(filter(None, (self.obstacle, self.driver, speed, f"key {self.key}", ground)))


class DriveEnd(NamedTuple):
    """Result of a drive.

    Attributes:
        least_load_n: least load of any wheel.
        stop_m: distance from the stop to standstill.
        way_m: total displacement.
        fastest_mps: highest true speed.
        tilt_deg: largest tilt of base_link.
        touched: the robot touched something other than the ground.
        stops: number of stops by drive control.
    """

    least_load_n: float
    stop_m: float
    way_m: float
    fastest_mps: float
    tilt_deg: float
    touched: bool
    stops: int


@dataclass(frozen=True)
class GroundFigures:
    """Figures of all drives; the names are those in the file. ends: result of each drive, by its name."""

    slope_load_n: float
    climb_load_n: float
    slope_way_m: float
    steep_way_m: float
    dead_stop_load_n: float
    contacts: int
    slippery_contacts: int
    slippery_stop_m: float
    cable_stops: int
    cable_tilt_deg: float
    cable_load_n: float
    ends: Dict[str, Dict[str, float]]

    def rows(self) -> List[Row]:
        """Return the rows: limits first, then figures for information."""
        return [Row(SLOPE, self.slope_load_n), Row(CLIMB, self.climb_load_n), Row(WAY, self.slope_way_m),
                Row(STEEP_WAY, self.steep_way_m), Row(DEAD_STOP, self.dead_stop_load_n), Row(CONTACTS, self.contacts),
                Row(SLIPPERY_CONTACTS, self.slippery_contacts), Row(SLIPPERY_STOP, self.slippery_stop_m),
                Row(CABLE_STOPS, self.cable_stops), Row(CABLE_TILT, self.cable_tilt_deg),
                Row(CABLE_LOAD, self.cable_load_n)]


def slopes(degrees: Sequence[float], driver: str) -> List[Drive]:
    """Return stops on slopes, forwards and backwards in all directions, with both key heights."""
    return [Drive(key, sign * FAST_MPS, driver, slope, way) for slope in degrees for way in DOWNHILL for key in LIFTS_M
            for sign in ((1.0, -1.0) if way == "downhill" else (1.0,))]


def drives() -> List[Drive]:
    """Return all drives."""
    return [
        *slopes(SLOPES_DEG, PLANNER), *slopes(STEEPER_DEG, HAND), *slopes((6.0,), PLANNER),
        *(Drive("raised", FAST_MPS, DEAD, slope) for slope in SLOPES_DEG),
        *(Drive(key, friction=friction, obstacle=obstacle) for friction in FRICTIONS for key in LIFTS_M
          for obstacle in ("", "wall")),
        *(Drive(key, speed, obstacle="cable") for key in LIFTS_M for speed in CABLE_SPEEDS_MPS)]


def measure(options: MotionOptions) -> GroundFigures:
    """Simulate all drives."""
    wanted = [each._replace(seed=options.seed) for each in drives()]
    with multiprocessing.Pool(options.jobs) as pool:
        return figures(wanted, pool.map(simulate, wanted, chunksize=1))


def figures(wanted: Sequence[Drive], ends: Sequence[DriveEnd]) -> GroundFigures:
    """Return the figures of these drives."""
    pairs = list(zip(wanted, ends))

    def of(driver: str, degrees: Sequence[float]) -> List[DriveEnd]:
        return [end for drive, end in pairs if drive.driver == driver and drive.slope_deg in degrees]

    def at(obstacle: str, frictions: Sequence[float]) -> List[DriveEnd]:
        return [end for drive, end in pairs
                if not drive.slope_deg and drive.obstacle == obstacle and drive.friction in frictions]
    slippery = [friction for friction in FRICTIONS if friction < PROMISED_FRICTION]
    cable = at("cable", (0.5,))
    return GroundFigures(
        _least(of(PLANNER, SLOPES_DEG)), _least(of(HAND, STEEPER_DEG)),
        min(abs(end.way_m) for end in (*of(PLANNER, SLOPES_DEG), *of(HAND, STEEPER_DEG))),
        max(abs(end.way_m) for end in of(PLANNER, (6.0,))), _least(of(DEAD, SLOPES_DEG)),
        sum(end.touched for end in at("wall", [each for each in FRICTIONS if each >= PROMISED_FRICTION])),
        sum(end.touched for end in at("wall", slippery)), max(end.stop_m for end in at("", (0.1,))),
        sum(end.stops for end in cable), max(end.tilt_deg for end in cable), _least(cable),
        {drive.name: {key: round(float(value), 3) for key, value in end._asdict().items()} for drive, end in pairs})


def _least(ends: Sequence[DriveEnd]) -> float:
    return round(min(end.least_load_n for end in ends), 2)


def simulate(drive: Drive) -> DriveEnd:
    """Simulate a drive."""
    rig = Rig(_site(drive), drive.seed, lift_m=LIFTS_M[drive.key])
    seen = _Seen(rig)
    duration_s = {"": DRIVING_S, "wall": PATIENCE_S, "cable": 2.0 * CABLE_M / drive.speed_mps + 1.0}[drive.obstacle]
    for _ in range(round(duration_s / TICK_S)):
        seen.stop(rig.step((drive.speed_mps, 0.0), by_hand=drive.driver == HAND).zone)
        seen.look()
        if drive.obstacle == "wall" and seen.stops and seen.is_still:
            break
    from_x = rig.pose.x
    for _ in range(round((STOPPING_S + (drive.friction < PROMISED_FRICTION) * STOPPING_S) / TICK_S)):
        if drive.driver == DEAD:
            rig.leave_alone()
        else:
            rig.step((0.0, 0.0), locked=True)
        seen.look()
    return seen.end(abs(rig.pose.x - from_x))


class _Seen:
    """Observations of a drive at each tick."""

    def __init__(self, rig: Rig):
        self._rig, self._start_x = rig, rig.pose.x
        self._load, self._fastest, self._tilt, self._touched = math.inf, 0.0, 0.0, False
        self._was_stopped = False
        self.stops = 0

    @property
    def is_still(self) -> bool:
        """True if the robot is stopped."""
        return abs(self._rig.sim.truth().linear_mps) < STANDING_MPS

    def stop(self, zone: int) -> None:
        """Count the beginnings of stops."""
        self.stops += zone >= STOPPED and not self._was_stopped
        self._was_stopped = zone >= STOPPED

    def look(self) -> None:
        """Record the state of the physics."""
        truth = self._rig.sim.truth()
        self._load = min(self._load, *self._rig.sim.wheel_loads_n())
        self._fastest = max(self._fastest, abs(truth.linear_mps))
        self._tilt = max(self._tilt, math.degrees(truth.tilt_rad))
        self._touched = self._touched or bool(self._rig.sim.contacts())

    def end(self, stop_m: float) -> DriveEnd:
        """Return the result of the drive."""
        return DriveEnd(self._load, stop_m, self._rig.pose.x - self._start_x, self._fastest, self._tilt,
                        self._touched, self.stops)


def _site(drive: Drive) -> Scenario:
    walls = tuple(Wall(Pose2(0.0, side * SIDE_M, 0.0), SIDE_LENGTH_M) for side in (1.0, -1.0))
    cables: Tuple[Cable, ...] = ()
    if drive.obstacle == "wall":
        ahead_m = FRONT_M + WALL_M + 0.5 * WALL_THICKNESS_M
        walls = (*walls, Wall(Pose2(ahead_m, 0.0, 0.5 * math.pi), 4.0, WALL_THICKNESS_M))
    if drive.obstacle == "cable":
        cables = (Cable(Pose2(CABLE_M, 0.0, 0.5 * math.pi)),)
    return Scenario(world_from_car=FAR_AWAY, start_in_car=FAR_AWAY.inverse(), start_offset_m=0.0, start_offset_rad=0.0,
                    friction=drive.friction, ground_slope_rad=math.radians(drive.slope_deg),
                    ground_slope_direction_rad=DOWNHILL[drive.way], walls=walls, cables=cables)
