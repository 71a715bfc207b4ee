"""Obstacles of a site as shapes in frame car, and the clearance of places between them."""
# SPDX-License-Identifier: Apache-2.0
import math
from typing import List, NamedTuple, Sequence

import numpy as np

from mtr_core.se2 import Pose2
from mtr_simulation.site.car_shape import CarShape
from mtr_simulation.site.scenario import Scenario
from mtr_simulation.site.surroundings import Walk

# Radius of a walking person with swinging legs; the robot keeps clear of the whole walk.
PERSON_RADIUS_M = 0.4
# Least clearance of base_link where the robot is put down; the robot's circle has a radius of 0.35 m.
PLACE_CLEARANCE_M = 0.6
MIN_JUMP_M, MAX_JUMP_M = 0.5, 8.0
DIRECTIONS_TRIED = 100


class Body(NamedTuple):
    """Rectangle with a rounded rim; poles and cones have no sides, and a walk has no width.

    Attributes:
        own_from_car: transform from frame car to the body's centre and axes.
        radius_m: width of the rim around the rectangle.
    """

    own_from_car: Pose2
    half_length_m: float = 0.0
    half_width_m: float = 0.0
    radius_m: float = 0.0

    def clearance_m(self, x_m: float, y_m: float) -> float:
        """Return the distance from a place in frame car to the rim; negative inside."""
        along, across = self.own_from_car.apply(x_m, y_m)
        beyond, aside = abs(along) - self.half_length_m, abs(across) - self.half_width_m
        return math.hypot(max(beyond, 0.0), max(aside, 0.0)) + min(max(beyond, aside), 0.0) - self.radius_m


class Jump(NamedTuple):
    """Displacement of a carried robot: distance, direction in frame car, and turn."""

    distance_m: float
    direction_rad: float
    turn_rad: float

    def applied(self, pose: Pose2) -> Pose2:
        """Return the pose in frame car at which the robot is put down."""
        return Pose2(pose.x + self.distance_m * math.cos(self.direction_rad),
                     pose.y + self.distance_m * math.sin(self.direction_rad), pose.heading + self.turn_rad)


def site_bodies(site: Scenario) -> List[Body]:
    """Return the Car and then all surrounding bodies."""
    world_from_car = site.world_from_car
    bodies = [_car(site.car, Pose2(0.0, 0.0, 0.0))]
    bodies += [_car(each.shape, each.pose.inverse() @ world_from_car) for each in site.parked_cars]
    bodies += [Body(wall.pose.inverse() @ world_from_car, 0.5 * wall.length_m, 0.5 * wall.thickness_m)
               for wall in site.walls]
    bodies += [Body(Pose2(-pole.x_m, -pole.y_m, 0.0) @ world_from_car, radius_m=pole.radius_m) for pole in site.poles]
    bodies += [Body(Pose2(-cone.x_m, -cone.y_m, 0.0) @ world_from_car, radius_m=cone.foot_radius_m)
               for cone in site.cones]
    return bodies + ([_walk(site.person, world_from_car)] if site.person else [])


def clearance_m(bodies: Sequence[Body], x_m: float, y_m: float) -> float:
    """Return the distance from a place in frame car to the nearest body; negative inside a body."""
    return min(body.clearance_m(x_m, y_m) for body in bodies)


def random_jump(bodies: Sequence[Body], pose: Pose2, chance: np.random.Generator) -> Jump:
    """Return a jump from a pose in frame car to a free place; distance, direction and turn are uniform if possible.

    Raises:
        ValueError: no place is free, which only happens on a site without room.
    """
    for _ in range(DIRECTIONS_TRIED):
        distance_m, turn_rad = float(chance.uniform(MIN_JUMP_M, MAX_JUMP_M)), float(chance.uniform(-math.pi, math.pi))
        # The distance stays fixed while directions are tried; otherwise short jumps would be rare near the Car.
        for direction_rad in chance.uniform(-math.pi, math.pi, DIRECTIONS_TRIED):
            jump = Jump(distance_m, float(direction_rad), turn_rad)
            place = jump.applied(pose)
            if clearance_m(bodies, place.x, place.y) >= PLACE_CLEARANCE_M:
                return jump
    raise ValueError(f"No place within {MAX_JUMP_M:g} m of {pose} has {PLACE_CLEARANCE_M:g} m of room.")


def _car(shape: CarShape, own_from_car: Pose2) -> Body:
    return Body(own_from_car, 0.5 * shape.length_m, 0.5 * shape.width_m)


def _walk(walk: Walk, world_from_car: Pose2) -> Body:
    (x1, y1), (x2, y2) = walk.start, walk.end
    middle = Pose2(0.5 * (x1 + x2), 0.5 * (y1 + y2), math.atan2(y2 - y1, x2 - x1))
    return Body(middle.inverse() @ world_from_car, 0.5 * math.hypot(x2 - x1, y2 - y1), radius_m=PERSON_RADIUS_M)
