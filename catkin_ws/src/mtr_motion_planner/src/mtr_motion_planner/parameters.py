"""Parameters of the motion planner."""
# SPDX-License-Identifier: Apache-2.0
import math
from dataclasses import dataclass, field
from typing import Tuple

from mtr_core.errors import ConfigurationError
from mtr_core.parameters import ParameterSet, number
from mtr_core.se2 import Pose2

from .limits import MotionLimits

FRAMES = ("car", "map")


@dataclass(frozen=True)
class Slip(ParameterSet):
    """Sideways slip of a skid-steered base in a turn; a value of 0 means no slip.

    The defaults are a fit to the simulation, at up to 0.8 m/s and 1.2 rad/s. The controller compensates most of the
    error of a wrong value, and a correction at the goal the rest.

    Attributes:
        turn_centre_x_m: point of a turn on the spot, ahead of base_link; below the centre of mass.
        curve_slip_s2: outward slip of this point per speed and square of the yaw rate, because the side forces of
            the wheels must turn the motion.
        acceleration_slip_s2: inward slip per acceleration and yaw rate while the robot accelerates, because the
            load moves to the rear wheels.
    """

    turn_centre_x_m: float = number(-0.006, -0.2, 0.2, "m")
    curve_slip_s2: float = number(0.07, 0.0, 1.0, "s2")
    acceleration_slip_s2: float = number(0.09, 0.0, 1.0, "s2")

    @property
    def base_from_centre(self) -> Pose2:
        """Pose of the turn centre in base_link. Plans are for the turn centre, because a turn does not move it."""
        return Pose2(self.turn_centre_x_m, 0.0, 0.0)


@dataclass(frozen=True)
class Margins(ParameterSet):
    """Distances that plans keep.

    Attributes:
        keep_out_m: least distance of the footprint from the Car's outline, which is grown by the uncertainty of Car and
            robot.
        mirror_m: least distance of the foremost part, the key on its arm, from the Car's side. The outline is measured
            at the LiDARs' height, where mirrors are invisible; a mirror protrudes up to 0.25 m from the side. At most
            0.28 m, because the key's front is 0.02 m ahead of the key, and the application's clearance_m of 0.3 m
            refers to the key.
        protrusion_m: the same in front of the Car and behind it, for a spare wheel, a tow bar or an open lid, which
            protrude up to 0.25 m. An end known to 2 cm may be approached up to keep_out_m.
        front_fitting_m: protrusion of a fitting at any height beyond the Car's front, such as a bull bar; it becomes
            part of the Car.
        rear_fitting_m: the same at the rear: a bicycle carrier, a lowered tailgate, a tow bar.
        route_margin_m: lateral gap between the robot and the Car on the route around it.
        geofence_xy: corners x, y, x, y, ... in m of a polygon that contains footprint and stopping distance; empty: no
            bound.
        geofence_frame: frame of these corners, car or map.
    """

    keep_out_m: float = number(0.10, 0.02, 1.0, "m")
    mirror_m: float = number(0.27, 0.0, 1.0, "m")
    protrusion_m: float = number(0.27, 0.0, 1.0, "m")
    front_fitting_m: float = number(0.0, 0.0, 2.0, "m")
    rear_fitting_m: float = number(0.0, 0.0, 2.0, "m")
    route_margin_m: float = number(0.25, 0.02, 2.0, "m")
    geofence_xy: Tuple[float, ...] = ()
    geofence_frame: str = "car"

    def __post_init__(self) -> None:
        super().__post_init__()
        if len(self.geofence_xy) % 2 or len(self.geofence_xy) in (2, 4):
            raise ConfigurationError(f"Parameter geofence_xy has {len(self.geofence_xy)} numbers; allowed is x and y "
                                     "of 3 corners or more.")
        if not all(math.isfinite(value) for value in self.geofence_xy):
            raise ConfigurationError("Parameter geofence_xy holds a number that is not finite; allowed are m.")
        if self.geofence_frame not in FRAMES:
            raise ConfigurationError(f"Parameter geofence_frame is '{self.geofence_frame}'; allowed is car or map.")


@dataclass(frozen=True)
class Arrival(ParameterSet):
    """Tolerances of a reached goal.

    Attributes:
        goal_along_m: tolerance along the goal's heading for REACHED.
        goal_across_m: tolerance across the goal's heading for REACHED.
        goal_heading_rad: heading tolerance for REACHED.
        corrections: attempts to get within these tolerances before the robot stays at its place.
    """

    goal_along_m: float = number(0.015, 0.005, 0.5, "m")
    goal_across_m: float = number(0.015, 0.005, 0.5, "m")
    goal_heading_rad: float = number(math.radians(0.8), 0.003, 0.5, "rad")
    corrections: int = number(3, 0, 20, "attempts")


@dataclass(frozen=True)
class MotionParameters(ParameterSet):
    """Start parameters of the motion planner.

    Attributes:
        run_in_m: straight segment with constant heading before a goal with a given direction of travel.
        longest_reverse_m: limit of a path driven backwards, except for the straight segment to a goal; for a robot that
            does not see behind itself.
        rear_lidar: the robot has a rear LiDAR. Otherwise it drives half a metre straight ahead before it turns after a
            rest, because drive control allows turns only over ground that was seen free.
        degenerate_speed_mps: speed limit while localization reports that its surroundings do not constrain the pose.
        pose_margin_m: limit of stopping distance plus 2 sigma of the robot's position, kept by a lower speed; the usual
            sigma of up to 5 cm does not slow the robot.
        creep_mps: least speed limit at any uncertainty of the position.
        input_age_limit_s: older inputs stop the robot.
        accept_nav_goal: for developers: goals from rviz are accepted while the robot follows waypoints and the Operator
            has set none.
        nav_goal_speed_mps: speed limit for goals from rviz.
    """

    limits: MotionLimits = field(default_factory=MotionLimits)
    slip: Slip = field(default_factory=Slip)
    margins: Margins = field(default_factory=Margins)
    arrival: Arrival = field(default_factory=Arrival)
    run_in_m: float = number(0.3, 0.0, 2.0, "m")
    longest_reverse_m: float = number(50.0, 0.0, 50.0, "m")
    rear_lidar: bool = True
    degenerate_speed_mps: float = number(0.3, 0.05, 2.0, "m/s")
    pose_margin_m: float = number(0.5, 0.1, 2.0, "m")
    creep_mps: float = number(0.1, 0.05, 0.3, "m/s")
    input_age_limit_s: float = number(0.3, 0.1, 2.0, "s")
    accept_nav_goal: bool = False
    nav_goal_speed_mps: float = number(0.5, 0.05, 2.0, "m/s")
