"""Options of a recorded drive, with the simulated robot and site that they describe."""
# SPDX-License-Identifier: Apache-2.0
import math
from dataclasses import dataclass, replace
from typing import Optional

from mtr_core import sensor_figures as figures
from mtr_core.errors import ConfigurationError
from mtr_core.parameters import ParameterSet, number
from mtr_simulation.sensors.imu import ImuParameters
from mtr_simulation.sensors.lidar import LidarParameters
from mtr_simulation.sensors.scan_errors import ScanErrors
from mtr_simulation.sim import Sim, SimParameters
from mtr_simulation.site.car_shape import CAR_SHAPES, CarShape
from mtr_simulation.site.scenario import Scenario, named_scenario
from mtr_simulation.site.surroundings import Walk

from .random_car import neighbour_of, random_car

# Path of the person to the right of the Car: beyond all axes, and no radial of the pattern leads there.
PERSON_BESIDE_M, PERSON_REACH_M = 3.7, 5.0
# Value of `car` for a random shape.
RANDOM = "random"


@dataclass(frozen=True)
class DriveOptions(ParameterSet):
    """Options of one drive; a scene and a seed give the same drive on every machine.

    Attributes:
        scene: named scenario of the simulator.
        car: named shape of the simulator; random: shape from the seed, and the Car is only mapped.
        lidar_height_m: height of the LiDAR plane above the ground.
        range_noise_m: 1 sigma; default: the largest value in data sheets of LiDARs of this class.
        range_bias_m: constant error of all ranges.
        opposed_bias_m: constant error of the front LiDAR's ranges; the rear one has the opposite error.
        tilt_deg: root mean square of the ground's slope.
        mount_tilt_deg: pitch of the LiDARs' mounting, which is unknown to the system.
        beams, field_deg: beams and field of view of each LiDAR; the field is centred on its x axis.
        gyro_scale_error: relative.
        friction: friction of the tyres.
        echo_share: share of the beams that hit a raindrop.
        mixed_pixel_share: share of mixed pixels among the beams at an edge.
        dropout_share: share of the beams without a return.
        rear: the rear LiDAR is recorded too.
        person: a person walks to and fro next to the Car.
        kidnap: after the loop, a person lifts the robot and puts it down 2 m aside; no axes, no radials.
        abduct: after the loop, the robot wanders, is carried to a random place, and wanders on; no axes, no radials.
        duration_s: axes and radials are repeated for this time; 0: once.
        sweeps_apart: only one in this number of LiDAR sweeps is recorded.
    """

    scene: str = "lot"
    car: str = "hatchback"
    lidar_height_m: float = number(0.3, 0.1, 0.6, "m")
    seed: int = number(1, 0, 2**31 - 1)
    range_noise_m: float = number(*figures.WORST_RANGE_NOISE_M)
    range_bias_m: float = number(*figures.SIMULATED_RANGE_BIAS_M)
    opposed_bias_m: float = number(*figures.SIMULATED_RANGE_BIAS_M)
    tilt_deg: float = number(0.0, 0.0, 5.0, "deg")
    mount_tilt_deg: float = number(0.0, -5.0, 5.0, "deg")
    dropout_share: float = number(*figures.SIMULATED_DROPOUT_SHARE._replace(value=0.005))
    beams: int = number(720, 2, 4000, "beams")
    field_deg: float = number(270.0, 10.0, 360.0, "deg")
    gyro_scale_error: float = number(*figures.COMPARED_GYRO_SCALE_ERROR)
    friction: float = number(0.5, 0.1, 1.2, "(Coulomb)")
    echo_share: float = number(*figures.SIMULATED_ECHO_SHARE)
    mixed_pixel_share: float = number(*figures.SIMULATED_MIXED_PIXEL_SHARE._replace(value=0.3))
    rear: bool = False
    person: bool = False
    kidnap: bool = False
    abduct: bool = False
    duration_s: float = number(0.0, 0.0, 86_400.0, "s")
    sweeps_apart: int = number(1, 1, 100, "sweeps")

    def __post_init__(self) -> None:
        super().__post_init__()
        named_scenario(self.scene)
        if self.car not in (RANDOM, *CAR_SHAPES):
            raise ConfigurationError(f"Parameter car is '{self.car}'; allowed is {', '.join(CAR_SHAPES)}, {RANDOM}.")
        if self.kidnap and self.abduct:
            raise ConfigurationError("Parameters kidnap and abduct are both true; a robot is carried away in one way "
                                     "only.")

    @property
    def shape(self) -> CarShape:
        """Shape of the Car."""
        return random_car(self.seed).shape if self.car == RANDOM else CAR_SHAPES[self.car]

    @property
    def neighbour(self) -> Optional[str]:
        """Side of the Car on which another one is parked; None: no other Car."""
        return random_car(self.seed).neighbour if self.car == RANDOM else None

    def scenario(self) -> Scenario:
        """Return the site with this Car and the person."""
        site = named_scenario(self.scene)
        if self.neighbour:
            beside = neighbour_of(self.seed, self.shape, self.neighbour, site.world_from_car)
            site = replace(site, parked_cars=(*site.parked_cars, beside))
        return replace(site, car=self.shape, friction=self.friction, ground_tilt_rad=math.radians(self.tilt_deg),
                       person=self._walk(site) if self.person else None)

    def sim(self) -> Sim:
        """Return the simulated robot at its start."""
        errors = ScanErrors(range_bias_m=self.range_bias_m, opposed_bias_m=self.opposed_bias_m,
                            echo_share=self.echo_share,
                            mixed_pixel_share=self.mixed_pixel_share, dropout_share=self.dropout_share)
        lidar = LidarParameters(height_m=self.lidar_height_m, noise_m=self.range_noise_m, beams=self.beams,
                                field_of_view_rad=math.radians(self.field_deg),
                                pitch_rad=math.radians(self.mount_tilt_deg), errors=errors)
        imu = ImuParameters(gyro_scale_error=self.gyro_scale_error)
        return Sim(self.seed, self.scenario(), SimParameters(rear_lidar=self.rear, lidar=lidar, imu=imu))

    def _walk(self, site: Scenario) -> Walk:
        y = -0.5 * self.shape.width_m - PERSON_BESIDE_M
        begin, end = (site.world_from_car.apply(x, y) for x in (-PERSON_REACH_M, PERSON_REACH_M))
        return Walk(begin, end)
