"""Random encounter of the moving robot with one person, simulated with the physics."""
# SPDX-License-Identifier: Apache-2.0
import math
from dataclasses import dataclass, replace
from typing import List, NamedTuple, Tuple

import mtr_drive_control_core as core
import numpy as np

from mtr_core.se2 import Pose2
from mtr_simulation.physics.robot import shipped_robot
from mtr_simulation.site.scenario import Scenario
from mtr_simulation.site.surroundings import Walk

from .rig import PERSON, START_S, STOPPED, TICK_S, Rig, Velocity

ROBOT = shipped_robot()
# Velocities of the planner and their durations.
Wanted = Tuple[Tuple[float, Velocity], ...]
# Speed below which the robot counts as stopped; the wheel encoders show as much at rest.
STANDING_MPS = 0.02
# Time for which the person walks on after the meeting place.
AFTER_S = 2.5
BEYOND_M = 8.0
MAP_HALF_SIDE_M = 15.0
# The front LiDAR sees 135 degrees to each side. Without a rear LiDAR, a person beyond this bearing and within this
# distance of base_link may step from the unseen sector against the robot before it can stop.
WATCHED_TO_RAD, UNSEEN_WITHIN_M = math.radians(125.0), 2.0
RAIN = 0.01
BEARINGS = {"front": (0.0, 35.0), "side": (55.0, 125.0), "rear": (145.0, 180.0)}
# Pose at which the Car is out of sight.
FAR_AWAY = Pose2(60.0, 0.0, 0.0)


class Mover(NamedTuple):
    """Person or object that approaches the robot.

    Attributes:
        figure: figure of mtr_simulation.
        low_mps, high_mps: half of the movers have the higher speed, the others one in between; 0: it does not move.
        clear_m: least initial distance from base_link: the footprint and a foot's length, or half the figure.
        rear_lidar: share of the robots with a rear LiDAR.
        is_localized: the robot is localized on a map that shows free ground.
    """

    figure: str = "person"
    low_mps: float = 0.5
    high_mps: float = 1.5
    clear_m: float = 0.8
    rear_lidar: float = 0.7
    is_localized: bool = False


PERSON_MOVER = Mover()


@dataclass(frozen=True)
class Encounter:
    """One encounter.

    Attributes:
        seed: seed of the sensors' noise.
        motion: forward, backward, arc or spin.
        approach: front, side or rear, relative to the direction of motion.
        rear_lidar: the robot has a rear LiDAR.
        wanted: velocities of the planner and their durations.
        walk: walk of the person.
        rain: share of beams that end on a raindrop.
        lift_m: height of the lift.
        is_localized: the robot is localized on a map that shows free ground.
    """

    seed: int
    motion: str
    approach: str
    rear_lidar: bool
    wanted: Wanted
    walk: Walk
    rain: float
    lift_m: float
    is_localized: bool = False


def draw(seed: int, mover: Mover = PERSON_MOVER) -> Encounter:
    """Return the encounter with that number: the first random one in which the person does not start too close."""
    random = np.random.default_rng([seed, 4])
    encounter = _drawn(seed, random, mover)
    while math.hypot(*encounter.walk.start) < mover.clear_m:
        encounter = _drawn(seed, random, mover)
    return encounter


def _drawn(seed: int, random: np.random.Generator, mover: Mover) -> Encounter:
    rear_lidar = bool(random.random() < mover.rear_lidar)
    motion = str(random.choice(["forward", "backward", "arc", "spin"]))
    approach = str(random.choice(list(BEARINGS)))
    meeting_s = float(random.uniform(1.5, 3.5))
    wanted = _wanted(random, motion, rear_lidar, meeting_s + AFTER_S)
    meeting_s = sum(duration for duration, _ in wanted) - AFTER_S
    place, velocity = _expected(wanted, meeting_s)
    low, high = (math.radians(bearing) for bearing in BEARINGS[approach])
    from_motion = float(random.choice([-1.0, 1.0]) * random.uniform(low, high))
    in_base = from_motion + (math.pi if velocity[0] < 0.0 else 0.0)
    aim = place.apply(*random.uniform(-0.4, 0.4, 2))
    speed = float(random.uniform(mover.low_mps, mover.high_mps) if random.random() < 0.5 else mover.high_mps)
    walk = replace(_walk(random, aim, place.heading + in_base, speed, meeting_s), figure=mover.figure)
    return Encounter(seed, motion, approach, rear_lidar, wanted, walk, float(random.choice([0.0, RAIN])),
                     float(random.choice([0.0, ROBOT.key.lift_travel_m])), mover.is_localized)


class EncounterEnd(NamedTuple):
    """Result of an encounter.

    Attributes:
        touched: the person touched the robot.
        moving: the robot moved just before the contact.
        speed_mps: speed of the robot's fastest point at that time.
        stopped: drive control stopped the robot.
        watched: the person was in view all the time.
    """

    touched: bool
    moving: bool
    speed_mps: float
    stopped: bool
    watched: bool


def simulate(encounter: Encounter) -> EncounterEnd:
    """Simulate the encounter."""
    scenario = Scenario(world_from_car=FAR_AWAY, start_in_car=FAR_AWAY.inverse(), start_offset_m=0.0,
                        start_offset_rad=0.0, person=encounter.walk)
    rig = Rig(scenario, encounter.seed, encounter.rear_lidar, encounter.rain, encounter.lift_m)
    rig.site_map = core.empty_map(MAP_HALF_SIDE_M) if encounter.is_localized else None
    stopped, speed_mps, touched, watched = False, 0.0, False, True
    for velocity in _ticks(encounter.wanted):
        speed_mps = rig.corner_speed_mps
        watched = watched and (encounter.rear_lidar or _is_in_view(rig, encounter.walk))
        decision = rig.step(velocity)
        stopped = stopped or decision.zone >= STOPPED
        # After the contact the person pushes the robot.
        if rig.sim.contacts() & PERSON:
            touched = True
            break
    return EncounterEnd(touched, touched and speed_mps > STANDING_MPS, speed_mps, stopped, watched)


def _is_in_view(rig: Rig, walk: Walk) -> bool:
    """Return True if the person is in view of the front LiDAR, or far away."""
    walked = walk.speed_mps * max(0.0, rig.time_s - walk.stands_s) / math.dist(walk.start, walk.end)
    place = [start + walked * (end - start) for start, end in zip(walk.start, walk.end)]
    x, y = rig.pose.inverse().apply(*place)
    bearing = math.atan2(y, x - ROBOT.front_lidar.x_m)
    return math.hypot(x, y) > UNSEEN_WITHIN_M or abs(bearing) < WATCHED_TO_RAD


def _wanted(random: np.random.Generator, motion: str, rear_lidar: bool, duration_s: float) -> Wanted:
    linear, angular = float(random.uniform(0.3, 1.4)), float(random.choice([-1.0, 1.0]) * random.uniform(0.3, 1.0))
    if motion == "forward":
        return ((duration_s, (linear, 0.0)),)
    if motion == "spin":
        return ((duration_s, (0.0, angular)),)
    if motion == "arc":
        return ((duration_s, (0.6 * linear, angular)),)
    # Without a rear LiDAR the robot only reverses onto ground that it has just seen: its own track.
    track: Wanted = () if rear_lidar else ((4.0, (0.7, 0.0)), (1.0, (0.0, 0.0)))
    return (*track, (duration_s, (-linear, 0.0)))


def _walk(random: np.random.Generator, aim: Tuple[float, float], bearing: float, speed: float,
          meeting_s: float) -> Walk:
    """Return the walk of a person who reaches `aim` with the robot; the person comes from afar, or starts nearby after
    a pause."""
    direction = (math.cos(bearing), math.sin(bearing))
    steps_in = bool(random.random() < 0.5)
    distance = min(speed * meeting_s, float(random.uniform(1.2, 2.2))) if steps_in else speed * meeting_s
    start = (aim[0] + distance * direction[0], aim[1] + distance * direction[1])
    stands_s = max(0.0, meeting_s - distance / speed) if speed else 0.0
    end = (aim[0] - BEYOND_M * direction[0], aim[1] - BEYOND_M * direction[1])
    return Walk(start, end, speed, START_S + stands_s)


def _ticks(wanted: Wanted) -> List[Velocity]:
    return [velocity for duration, velocity in wanted for _ in range(round(duration / TICK_S))]


def _expected(wanted: Wanted, meeting_s: float) -> Tuple[Pose2, Velocity]:
    """Return the pose of an undisturbed robot with 1 m/s2 at the meeting, and the planner's velocity then."""
    pose, linear = Pose2(0.0, 0.0, 0.0), 0.0
    for velocity in _ticks(wanted)[:round(meeting_s / TICK_S)]:
        linear += max(-TICK_S, min(TICK_S, velocity[0] - linear))
        pose = pose @ Pose2(linear * TICK_S, 0.0, velocity[1] * TICK_S)
    return pose, velocity
