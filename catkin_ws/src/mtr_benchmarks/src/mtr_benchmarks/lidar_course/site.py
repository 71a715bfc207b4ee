"""Site with a wall and a pole on the robot's path, and the robot's distance from them. No ROS inside."""
# SPDX-License-Identifier: Apache-2.0
import math
import pathlib
from typing import Dict, List, NamedTuple

import shapely.affinity
import shapely.geometry
import yaml

from mtr_description.shipped import shipped_geometry
from mtr_simulation.site.scenario import named_scenario

POLE_RADIUS_M = 0.05
WALL_LENGTH_M, WALL_THICKNESS_M = 2.0, 0.2
# The obstacle is in the middle of each leg, at this distance from its start.
HALF_LEG_M = 3.5
# Distance of the legs from the Car's x axis: outside the mapping path, inside the obstacles of the lot.
ASIDE_M = 5.0
FOOTPRINT = shapely.geometry.Polygon(shipped_geometry().footprint().corners)


class Leg(NamedTuple):
    """Straight leg in frame car with an obstacle in its middle; start and end as x, y and heading, m and rad."""

    start: "Place"
    end: "Place"
    obstacle: shapely.geometry.Polygon


class Place(NamedTuple):
    """Pose of base_link in frame car, m and rad."""

    x_m: float
    y_m: float
    heading_rad: float


def _leg(y_m: float, obstacle: shapely.geometry.Polygon) -> Leg:
    return Leg(Place(HALF_LEG_M, y_m, math.pi), Place(-HALF_LEG_M, y_m, math.pi), obstacle)


LEGS: Dict[str, Leg] = {
    "pole": _leg(-ASIDE_M, shapely.geometry.Point(0.0, -ASIDE_M).buffer(POLE_RADIUS_M)),
    "wall": _leg(ASIDE_M, shapely.geometry.box(-0.5 * WALL_THICKNESS_M, ASIDE_M - 0.5 * WALL_LENGTH_M,
                                               0.5 * WALL_THICKNESS_M, ASIDE_M + 0.5 * WALL_LENGTH_M)),
}


def clearance_m(leg: Leg, place: Place) -> float:
    """Return the distance of the robot's outline from the obstacle of a leg; 0 for a contact."""
    turned = shapely.affinity.rotate(FOOTPRINT, place.heading_rad, origin=(0.0, 0.0), use_radians=True)
    return float(shapely.affinity.translate(turned, place.x_m, place.y_m).distance(leg.obstacle))


def write_site(path: pathlib.Path) -> None:
    """Write the shipped lot with the obstacles as a scenario file for the simulator."""
    lot = named_scenario("lot")
    car = lot.world_from_car
    pole = car.apply(0.0, -ASIDE_M)
    wall = car.apply(0.0, ASIDE_M)
    content = {
        "poles": [*([each.x_m, each.y_m, each.radius_m] for each in lot.poles), [*pole, POLE_RADIUS_M]],
        "walls": [*(_wall(each.pose.x, each.pose.y, each.pose.heading, each.length_m) for each in lot.walls),
                  _wall(*wall, car.heading + 0.5 * math.pi, WALL_LENGTH_M)],
        "parked_cars": [{"pose": [each.pose.x, each.pose.y, math.degrees(each.pose.heading)]}
                        for each in lot.parked_cars],
    }
    path.write_text(yaml.safe_dump(content), encoding="utf-8")


def _wall(x_m: float, y_m: float, heading_rad: float, length_m: float) -> List[float]:
    return [x_m, y_m, math.degrees(heading_rad), length_m, WALL_THICKNESS_M]
