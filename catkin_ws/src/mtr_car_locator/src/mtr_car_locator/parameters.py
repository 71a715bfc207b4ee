"""Parameters of the car locator."""
# SPDX-License-Identifier: Apache-2.0
import math
from dataclasses import dataclass, field

from mtr_core.errors import ConfigurationError
from mtr_core.parameters import ParameterSet, number
from mtr_core.se2 import Pose2

# Largest inset of a body in the scan plane behind its widest part, on each side.
MAX_INSET_M = 0.06
# Deviation from a data sheet's sizes and overhang by number plates, load and trim levels.
DATA_SHEET_SIGMA_M = 0.005
# Ordinary sizes, from a small car to a delivery van, are equally likely without a data sheet; others soon impossible.
ORDINARY_LENGTH_M, ORDINARY_WIDTH_M = (3.0, 6.0), (1.4, 2.2)


@dataclass(frozen=True)
class DataSheet(ParameterSet):
    """Prior knowledge about the Car; zero means unknown.

    Attributes:
        expected_length_m: length of an ordinary Car.
        expected_width_m: width of an ordinary Car.
        size_tolerance_m: largest deviation of length or width from the expected one.
        known_length_m: length from the Car's data sheet; it is published, because distances refer to the widest parts,
            and compared with the length in the scan plane.
        known_width_m: width without mirrors from the data sheet, used in the same way.
        front_overhang_m: front axle to the tip of the front, from the data sheet; if the tyres are seen, it determines
            the front, and together with the length the rear.
        wheelbase_m: distance of the axles, from the data sheet; it makes the axles more accurate and unambiguous.
        side_inset_m: distance of the surfaces in the scan plane from the Car's widest part, on each side; used if the
            width is not known.
        side_inset_sigma_m: 1 sigma of the error of side_inset_m, if the width is not known. The default is the root
            mean square of an inset that is uniformly distributed from 0 to MAX_INSET_M, because the mean is not
            corrected (docs/accuracy.md, Limits).
        front_inset_sigma_m: sigma of the half-normal prior of the front's inset in the scan plane: in 95 % of all cars,
            the inset is below 2 sigma (docs/accuracy.md, Limits).
        rear_inset_sigma_m: the same for the rear.
    """

    expected_length_m: float = number(4.5, 2.0, 10.0, "m")
    expected_width_m: float = number(1.8, 1.0, 3.0, "m")
    size_tolerance_m: float = number(1.5, 0.1, 3.0, "m")
    known_length_m: float = number(0.0, 0.0, 10.0, "m")
    known_width_m: float = number(0.0, 0.0, 3.0, "m")
    front_overhang_m: float = number(0.0, 0.0, 2.0, "m")
    wheelbase_m: float = number(0.0, 0.0, 4.0, "m")
    side_inset_m: float = number(0.0, 0.0, 0.2, "m")
    side_inset_sigma_m: float = number(round(MAX_INSET_M / math.sqrt(3.0), 3), 0.0, 0.1, "m")
    front_inset_sigma_m: float = number(0.11, 0.0, 0.5, "m")
    rear_inset_sigma_m: float = number(0.075, 0.0, 0.5, "m")

    @property
    def length_m(self) -> float:
        """Best guess of the length."""
        return self.known_length_m or self.expected_length_m

    @property
    def width_m(self) -> float:
        """Best guess of the width."""
        return self.known_width_m or self.expected_width_m


@dataclass(frozen=True)
class RefinementParameters(ParameterSet):
    """Timing of repeated observations, limits of frame corrections, and limits of the self-check.

    Attributes:
        look_s: duration of one observation while the robot is stationary.
        refine_least_m: lowest shift of the Car that changes its frame.
        refine_least_rad: lowest turn that changes its frame.
        refine_most_m: largest shift that is corrected; above it, the Car was moved.
        refine_most_rad: largest turn that is corrected.
        check_limit_m: shift of the Car's centre or side at which the self-check fails.
        check_limit_rad: turn of the Car at which the self-check fails.
        check_distance_m: distance from the Car at which the self-check observes it.
    """

    look_s: float = number(0.4, 0.1, 5.0, "s")
    refine_least_m: float = number(0.01, 0.002, 0.5, "m")
    refine_least_rad: float = number(math.radians(0.3), 0.001, 0.2, "rad")
    refine_most_m: float = number(0.10, 0.02, 0.5, "m")
    refine_most_rad: float = number(math.radians(2.0), 0.005, 0.2, "rad")
    check_limit_m: float = number(0.02, 0.005, 0.5, "m")
    check_limit_rad: float = number(math.radians(0.5), 0.001, 0.2, "rad")
    check_distance_m: float = number(1.6, 1.0, 5.0, "m")


@dataclass(frozen=True)
class LocatorParameters(ParameterSet):
    """Parameters of the Car locator.

    Attributes:
        start_x_m: where the Operator puts the robot, in the Car's frame.
        start_y_m: the same, to the Car's left.
        start_heading_rad: the robot's heading there; towards the Car's centre by default.
        position_tolerance_m: largest distance of the Car's centre from its position by the starting place.
        heading_tolerance_rad: largest deviation of the Car's heading.
        prior_margin_m: added around the expected Car, for the planner, before it has been seen.
        seen_margin_m: added after the first sides have been seen.
        ring_distance_m: distance from the Car at which the robot drives round it.
        arrival_m: distance from a place of the ring at which the robot continues to the next one.
        blocked_limit_s: waiting time for an obstacle before the robot drives round the other way.
        look_first_s: stationary observation of the Car before the path round it is planned.
        look_limit_s: time limit for seeing the Car from the starting place.
        map_limit_s: time limit for the adjustment of the map by localization; its failure is reported at once. At a
            load of 15 on two cores the adjustment lasted more than 15 s.
        rear_lidar: the robot has a rear LiDAR.
        time_increment_s: time between beams if the scans do not state it; 0: all beams are simultaneous.
        memory_folder: folder of the file with which a restarted node resumes within the same run; empty for none.
    """

    start_x_m: float = number(4.0, -20.0, 20.0, "m")
    start_y_m: float = number(2.6, -20.0, 20.0, "m")
    start_heading_rad: float = number(math.atan2(-2.6, -4.0), -math.pi, math.pi, "rad")
    sheet: DataSheet = field(default_factory=DataSheet)
    refinement: RefinementParameters = field(default_factory=RefinementParameters)
    position_tolerance_m: float = number(1.5, 0.1, 3.0, "m")
    heading_tolerance_rad: float = number(math.radians(25.0), 0.01, 0.7, "rad")
    prior_margin_m: float = number(0.5, 0.0, 2.0, "m")
    seen_margin_m: float = number(0.3, 0.0, 2.0, "m")
    ring_distance_m: float = number(1.6, 1.0, 5.0, "m")
    arrival_m: float = number(0.5, 0.05, 1.0, "m")
    blocked_limit_s: float = number(10.0, 1.0, 120.0, "s")
    look_first_s: float = number(1.0, 0.3, 10.0, "s")
    look_limit_s: float = number(8.0, 0.5, 60.0, "s")
    map_limit_s: float = number(60.0, 1.0, 600.0, "s")
    rear_lidar: bool = True
    time_increment_s: float = number(0.0, 0.0, 0.001, "s")
    memory_folder: str = ""

    def __post_init__(self) -> None:
        super().__post_init__()
        beyond = (abs(self.start_x_m) - 0.5 * self.sheet.length_m, abs(self.start_y_m) - 0.5 * self.sheet.width_m)
        if min(beyond) <= 0.0:
            raise ConfigurationError(
                f"Parameters start_x_m and start_y_m are {self.start_x_m:g} and {self.start_y_m:g} m; the starting "
                "place has to lie before a corner of the Car, so that a long side and an end are seen from it.")

    @property
    def car_from_start(self) -> Pose2:
        """Start pose of the robot in the Car's frame."""
        return Pose2(self.start_x_m, self.start_y_m, self.start_heading_rad)
