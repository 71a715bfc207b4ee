"""Test sites: the Car, its surroundings, the ground, and the robot's start."""
# SPDX-License-Identifier: Apache-2.0
import math
from dataclasses import dataclass, replace
from typing import Dict, Optional, Tuple

from mtr_core.errors import ConfigurationError
from mtr_core.parameters import ParameterSet, number
from mtr_core.se2 import Pose2

from ..noise import stream
from .cables import Cable
from .car_shape import CAR_SHAPES, CarShape
from .surroundings import Cone, ParkedCar, Pole, Walk, Wall


@dataclass(frozen=True)
class Scenario(ParameterSet):
    """One test site.

    Attributes:
        car: shape of the Car under test.
        world_from_car: pose of the Car; neither at the origin nor aligned, so that errors of frames show.
        start_in_car: nominal pose of base_link in frame car.
        start_offset_m: largest random displacement of the start in x and y.
        start_offset_rad: largest random rotation of the start.
        friction: friction of tyres on the ground; 0.5 as in the Jackal's description.
        ground_tilt_rad: root mean square of the slope of uneven ground; 0: flat.
        ground_slope_rad: slope of the whole site.
        ground_slope_direction_rad: downhill direction in world.
        cables: cables on the path of the wheels.
    """

    car: CarShape = CarShape()
    world_from_car: Pose2 = Pose2(1.3, -0.7, 0.35)
    start_in_car: Pose2 = Pose2(4.0, 2.6, math.atan2(-2.6, -4.0))
    start_offset_m: float = number(0.3, 0.0, 0.5, "m")
    start_offset_rad: float = number(math.radians(5.0), 0.0, 0.3, "rad")
    friction: float = number(0.5, 0.1, 1.2, "(Coulomb)")
    ground_tilt_rad: float = number(0.0, 0.0, 0.1, "rad")
    ground_slope_rad: float = number(0.0, 0.0, 0.35, "rad")
    ground_slope_direction_rad: float = number(0.0, -math.pi, math.pi, "rad")
    poles: Tuple[Pole, ...] = ()
    cones: Tuple[Cone, ...] = ()
    walls: Tuple[Wall, ...] = ()
    parked_cars: Tuple[ParkedCar, ...] = ()
    person: Optional[Walk] = None
    cables: Tuple[Cable, ...] = ()

    def gravity(self, size_mps2: float) -> Tuple[float, float, float]:
        """Return gravity along x, y, z of world, whose z axis is perpendicular to the ground."""
        along = size_mps2 * math.sin(self.ground_slope_rad)
        return (along * math.cos(self.ground_slope_direction_rad), along * math.sin(self.ground_slope_direction_rad),
                -size_mps2 * math.cos(self.ground_slope_rad))

    def start_in_world(self, seed: int) -> Pose2:
        """Return the pose of base_link in world at the start, displaced by the seed."""
        x, y, turn = stream(seed, "start").uniform(-1.0, 1.0, 3)
        nominal = self.start_in_car
        return self.world_from_car @ Pose2(nominal.x + self.start_offset_m * x / math.sqrt(2.0),
                                           nominal.y + self.start_offset_m * y / math.sqrt(2.0),
                                           nominal.heading + self.start_offset_rad * turn)


# The test needs about 7 m around the Car's centre; everything in the lot is more than 8.5 m away.
_LOT = Scenario(
    poles=tuple(Pole(1.3 + 9.5 * math.cos(angle), -0.7 + 9.0 * math.sin(angle))
                for angle in (0.2, 0.9, 1.7, 2.4, 3.3, 4.1, 4.8, 5.7)),
    walls=(Wall(Pose2(0.0, 13.0, 0.0), 24.0), Wall(Pose2(0.0, -14.0, 0.05), 22.0),
           Wall(Pose2(14.0, 0.0, math.pi / 2.0), 18.0)),
    parked_cars=(ParkedCar(Pose2(-10.5, 2.5, math.pi / 2.0)), ParkedCar(Pose2(-10.6, -3.5, -math.pi / 2.0))),
)
# Only the Car within 20 m of its centre, and a few objects beyond, in the LiDAR's range of 30 m.
_FAR = Scenario(
    poles=tuple(Pole(1.3 + 22.0 * math.cos(angle), -0.7 + 22.0 * math.sin(angle), 0.12)
                for angle in (0.5, 2.2, 3.9, 5.2)),
    walls=(Wall(Pose2(3.0, 23.5, 0.05), 24.0), Wall(Pose2(-23.0, -3.0, math.pi / 2.0 - 0.1), 14.0)),
    parked_cars=(ParkedCar(Pose2(23.0, -9.0, 1.4)),),
)
# Places of an Operator's cones: outside of the radials' 10 m, between the directions of sides and corners.
_CONES = Scenario(cones=tuple(
    Cone(*Scenario.world_from_car.apply(distance * math.cos(angle), distance * math.sin(angle)))
    for distance, angle in ((12.5, 0.38), (11.8, 1.97), (12.2, 3.53), (12.0, 5.08))))
SCENARIOS: Dict[str, Scenario] = {
    "lot": _LOT,
    "far": _FAR,
    "cones": _CONES,
    "open": Scenario(),
    "lot_person": replace(_LOT, person=Walk((-5.0, -7.5), (6.0, -8.0))),
    "suv": replace(_LOT, car=CAR_SHAPES["suv"]),
}


def named_scenario(name: str) -> Scenario:
    """Return the scenario of that name."""
    if name not in SCENARIOS:
        raise ConfigurationError(f"Parameter scenario is '{name}'; allowed is {', '.join(SCENARIOS)}.")
    return SCENARIOS[name]
