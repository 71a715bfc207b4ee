"""All bodies on a site as solids, from which each physics engine builds its world."""
# SPDX-License-Identifier: Apache-2.0
import math
from typing import List

from mtr_core.se2 import Pose2

from .car_body import car_body, parked_car_body
from .scenario import Scenario
from .shapes import Body, Box, Cylinder, Hull, Part
from .surroundings import Cone, Pole, Wall

POLE_HEIGHT_M, WALL_HEIGHT_M, CONE_HEIGHT_M = 1.2, 2.0, 0.75
CONE_CORNERS = 16
# Body name of the poles, cones and walls together.
SURROUNDINGS = "surroundings"


def bodies_of(scenario: Scenario) -> List[Body]:
    """Return the Car, parked cars, and the surroundings with parts placed in world; people are not included."""
    things = (*map(_pole, scenario.poles), *(_cone(index, cone) for index, cone in enumerate(scenario.cones)),
              *map(_wall, scenario.walls))
    return [car_body("car", scenario.car, scenario.world_from_car),
            *(parked_car_body(f"parked_{index}", each.shape, each.pose)
              for index, each in enumerate(scenario.parked_cars)),
            Body(SURROUNDINGS, Pose2(0.0, 0.0, 0.0), things)]


def _pole(pole: Pole) -> Part:
    half = POLE_HEIGHT_M / 2.0
    return Part(Cylinder(pole.radius_m, half), (pole.x_m, pole.y_m, half))


def _cone(index: int, cone: Cone) -> Part:
    angles = [2.0 * math.pi * corner / CONE_CORNERS for corner in range(CONE_CORNERS)]
    points = tuple((radius * math.cos(angle), radius * math.sin(angle), z)
                   for z, radius in ((0.0, cone.foot_radius_m), (CONE_HEIGHT_M, cone.top_radius_m)) for angle in angles)
    return Part(Hull(f"cone_{index}", points), (cone.x_m, cone.y_m, 0.0))


def _wall(wall: Wall) -> Part:
    half = WALL_HEIGHT_M / 2.0
    return Part(Box((wall.length_m / 2.0, wall.thickness_m / 2.0, half)), (wall.pose.x, wall.pose.y, half),
                wall.pose.heading)
