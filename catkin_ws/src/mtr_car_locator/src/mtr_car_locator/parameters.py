"""Parameters of the car locator."""
# SPDX-License-Identifier: Apache-2.0
import math
from dataclasses import dataclass, field

from mtr_core.errors import ConfigurationError
from mtr_core.parameters import ParameterSet, number
from mtr_core.se2 import Pose2

# A body may stand back so far in the LiDARs' plane behind its widest part, on each side.
MAX_INSET_M = 0.06
# A data sheet's sizes and overhang differ from this Car's by number plates, load and trim levels.
DATA_SHEET_SIGMA_M = 0.005
# Cars without a data sheet: from a small one to a delivery van each size is as likely, and beyond that soon none is.
ORDINARY_LENGTH_M, ORDINARY_WIDTH_M = (3.0, 6.0), (1.4, 2.2)


@dataclass(frozen=True)
class DataSheet(ParameterSet):
    """What is known of the Car before it is measured; zeros mean that it is not known.

    Attributes:
        expected_length_m: length of an ordinary Car.
        expected_width_m: width of an ordinary Car.
        size_tolerance_m: a length or width farther from the expected one is not believed.
        known_length_m: length from the Car's data sheet; it is published, for distances count from the widest parts,
            and what the LiDARs' plane shows is compared with it.
        known_width_m: the same of the width without mirrors.
        front_overhang_m: front axle to the front's tip, from the data sheet; where the tyres are seen it tells the
            front, and with the length the rear.
        wheelbase_m: distance of the axles, from the data sheet; it makes the axles more exact and unambiguous.
        side_inset_m: how far the surfaces in the LiDAR's plane lie inside of the Car's widest part, on each side; used
            when the width is not known.
        side_inset_sigma_m: 1 sigma of what side_inset_m leaves out, as long as the width is not known. By default that
            of an inset of which nothing is known but that it is 0 to MAX_INSET_M: the root of the mean square, for the
            mean is not corrected (docs/accuracy.md, Limits).
        front_inset_sigma_m: 1 sigma of the normal distribution whose positive half is the prior of how far the front
            stands back in the LiDARs' plane: 95 % of all cars by less than twice as much (docs/accuracy.md, Limits).
        rear_inset_sigma_m: the same of the rear.
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
    """When the Car is observed again, what changes its frame, and what the self-check allows.

    Attributes:
        look_s: scans of one observation, taken while the robot stands.
        refine_least_m: a smaller shift of the Car does not change its frame.
        refine_least_rad: the same for its turn.
        refine_most_m: a larger shift is not a correction: the Car was moved.
        refine_most_rad: the same for its turn.
        check_limit_m: shift of the Car's centre or side at which the self-check fails.
        check_limit_rad: turn of the Car at which it fails.
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
    """What the Car locator is started with.

    Attributes:
        start_x_m: where the Operator puts the robot, in the Car's frame.
        start_y_m: the same, to the Car's left.
        start_heading_rad: the robot's heading there; towards the Car's centre by default.
        position_tolerance_m: the Car's centre is not looked for farther from where the starting place puts it.
        heading_tolerance_rad: the same for its heading.
        prior_margin_m: added around the expected Car, for the planner, before it has been seen.
        seen_margin_m: the same after the first sides have been seen.
        ring_distance_m: distance from the Car at which the robot goes round it.
        arrival_m: so close to a place of the ring the robot is sent to the next one.
        blocked_limit_s: waited for an obstacle on the way round, before the robot goes round the other way.
        look_first_s: observation of the Car, standing, before the way round it is laid.
        look_limit_s: the Car has to be seen from the starting place by then.
        map_limit_s: localization has to have adjusted its map by then; one that dies meanwhile is told at once. At a
            load of 15 on two cores it took more than 15 s.
        rear_lidar: the robot has one.
        time_increment_s: from beam to beam, where the scans do not say it; 0: all are measured at once.
        memory_folder: of the file with which a node that is started again in the same run goes on; empty for none.
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
        """Where the robot starts, in the Car's frame."""
        return Pose2(self.start_x_m, self.start_y_m, self.start_heading_rad)
