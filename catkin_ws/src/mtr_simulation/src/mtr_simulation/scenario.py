"""What stands around the robot: the Car, its surroundings, the ground, and where the robot starts."""
# SPDX-License-Identifier: Apache-2.0
import math
from dataclasses import dataclass, replace
from typing import Dict, Optional, Tuple

from mtr_core.errors import ConfigurationError, check_range
from mtr_core.parameters import ParameterSet, number
from mtr_core.se2 import Pose2

from .noise import stream


@dataclass(frozen=True)
class CarShape(ParameterSet):
    """Body of a car; length and width without mirrors are those that the robot is to find.

    Attributes:
        wheelbase_m: distance of the axles, less than length_m - 1.
        clearance_m: gap between ground and body; a LiDAR below it sees only the wheels.
    """

    length_m: float = number(4.5, 3.0, 6.0, "m")
    width_m: float = number(1.8, 1.4, 2.2, "m")
    height_m: float = number(1.45, 1.2, 2.2, "m")
    wheelbase_m: float = number(2.65, 1.5, 5.0, "m")
    wheel_radius_m: float = number(0.32, 0.25, 0.45, "m")
    clearance_m: float = number(0.24, 0.1, 0.4, "m")

    def __post_init__(self) -> None:
        super().__post_init__()
        check_range("wheelbase_m", self.wheelbase_m, 1.5, self.length_m - 1.0, "m")


@dataclass(frozen=True)
class Pole:
    """Upright cylinder, 1.2 m high; x, y in world."""

    x_m: float
    y_m: float
    radius_m: float = 0.05


@dataclass(frozen=True)
class Wall:
    """Upright box, 2 m high, along the x axis of its pose in world."""

    pose: Pose2
    length_m: float
    thickness_m: float = 0.2


@dataclass(frozen=True)
class ParkedCar:
    """Another car; pose of its centre in world."""

    pose: Pose2
    shape: CarShape = CarShape()


@dataclass(frozen=True)
class Walk:
    """A person who walks to and fro between two points in world."""

    start: Tuple[float, float]
    end: Tuple[float, float]
    speed_mps: float = 1.2


@dataclass(frozen=True)
class Scenario(ParameterSet):
    """One test site.

    Attributes:
        car: shape of the Car under test.
        world_from_car: pose of the Car; neither at the origin nor aligned, so that no code gets away with that.
        start_in_car: nominal pose of base_link in frame car.
        start_offset_m: the seed moves the start by up to this in x and y.
        start_offset_rad: and turns it by up to this.
        friction: of tyres on the ground; 0.5 as in the Jackal's description.
    """

    car: CarShape = CarShape()
    world_from_car: Pose2 = Pose2(1.3, -0.7, 0.35)
    start_in_car: Pose2 = Pose2(4.0, 2.6, math.atan2(-2.6, -4.0))
    start_offset_m: float = number(0.3, 0.0, 0.5, "m")
    start_offset_rad: float = number(math.radians(5.0), 0.0, 0.3, "rad")
    friction: float = number(0.5, 0.1, 1.2, "(Coulomb)")
    poles: Tuple[Pole, ...] = ()
    walls: Tuple[Wall, ...] = ()
    parked_cars: Tuple[ParkedCar, ...] = ()
    person: Optional[Walk] = None

    def start_in_world(self, seed: int) -> Pose2:
        """Pose of base_link in world at the start, moved by the seed."""
        x, y, turn = stream(seed, "start").uniform(-1.0, 1.0, 3)
        nominal = self.start_in_car
        return self.world_from_car @ Pose2(nominal.x + self.start_offset_m * x / math.sqrt(2.0),
                                           nominal.y + self.start_offset_m * y / math.sqrt(2.0),
                                           nominal.heading + self.start_offset_rad * turn)


# The test needs about 7 m around the Car's centre; everything in the lot is farther away than 8.5 m.
_LOT = Scenario(
    poles=tuple(Pole(1.3 + 9.5 * math.cos(angle), -0.7 + 9.0 * math.sin(angle))
                for angle in (0.2, 0.9, 1.7, 2.4, 3.3, 4.1, 4.8, 5.7)),
    walls=(Wall(Pose2(0.0, 13.0, 0.0), 24.0), Wall(Pose2(0.0, -14.0, 0.05), 22.0),
           Wall(Pose2(14.0, 0.0, math.pi / 2.0), 18.0)),
    parked_cars=(ParkedCar(Pose2(-10.5, 2.5, math.pi / 2.0)), ParkedCar(Pose2(-10.6, -3.5, -math.pi / 2.0))),
)
SCENARIOS: Dict[str, Scenario] = {
    "lot": _LOT,
    "open": Scenario(),
    "lot_person": replace(_LOT, person=Walk((-5.0, -7.5), (6.0, -8.0))),
    "suv": replace(_LOT, car=CarShape(length_m=4.7, width_m=1.9, height_m=1.7, wheel_radius_m=0.36, clearance_m=0.34)),
}


def named_scenario(name: str) -> Scenario:
    """The scenario of that name."""
    if name not in SCENARIOS:
        raise ConfigurationError(f"Parameter scenario is '{name}'; allowed is {', '.join(SCENARIOS)}.")
    return SCENARIOS[name]
