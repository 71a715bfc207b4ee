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
    """How a skid-steered base slides sideways when it turns; without a slip a value is 0.

    The defaults are a fit to the simulation, at up to 0.8 m/s and 1.2 rad/s. The controller takes out what a wrong
    value leaves, and a correction at the goal what it cannot.

    Attributes:
        turn_centre_x_m: point, ahead of base_link, about which it turns on the spot; below its centre of mass.
        curve_slip_s2: this point slides outwards at this times speed times the square of the yaw rate: the wheels'
            side forces must turn the motion.
        acceleration_slip_s2: and inwards, while it gets faster, at this times acceleration times yaw rate: the load
            moves to the wheels behind.
    """

    turn_centre_x_m: float = number(-0.006, -0.2, 0.2, "m")
    curve_slip_s2: float = number(0.07, 0.0, 1.0, "s2")
    acceleration_slip_s2: float = number(0.09, 0.0, 1.0, "s2")

    @property
    def base_from_centre(self) -> Pose2:
        """The turn centre, whose way is planned: unlike base_link it stays where it is when the robot turns."""
        return Pose2(self.turn_centre_x_m, 0.0, 0.0)


@dataclass(frozen=True)
class Margins(ParameterSet):
    """How far the robot stays away from things, by plan.

    Attributes:
        keep_out_m: the footprint never gets closer to the Car's outline, grown by its uncertainty and the robot's.
        mirror_m: what is foremost, the key on its arm, never gets closer to the Car's side beside it. The outline is
            that at the LiDARs' height; no LiDAR sees a mirror, which stands up to 0.25 m out of the side. Not more than
            0.28: the key's front is 0.02 m ahead of the key, to which the application's clearance_m of 0.3 m is.
        protrusion_m: the same before the Car's front and behind its rear, for a spare wheel, a tow bar or an open lid,
            which stand out by up to 0.25 m. An end that is known to 2 cm may be approached up to keep_out_m.
        front_fitting_m: what stands out of the Car's front beyond its length at any height, such as a bull bar; it
            is part of the Car then.
        rear_fitting_m: the same of its rear: a bicycle carrier, a lowered tailgate, a tow bar.
        route_margin_m: gap beside the robot on its way around the Car.
        geofence_xy: corners x, y, x, y, ... of the polygon in m that footprint and stopping distance stay in; empty:
            no bound.
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
    """When a goal is reached.

    Attributes:
        goal_along_m: REACHED needs this along the goal's heading.
        goal_across_m: REACHED needs this across the goal's heading.
        goal_heading_rad: REACHED needs this.
        corrections: attempts to get within these tolerances before the robot stays where it is.
    """

    goal_along_m: float = number(0.015, 0.005, 0.5, "m")
    goal_across_m: float = number(0.015, 0.005, 0.5, "m")
    goal_heading_rad: float = number(math.radians(0.8), 0.003, 0.5, "rad")
    corrections: int = number(3, 0, 20, "attempts")


@dataclass(frozen=True)
class MotionParameters(ParameterSet):
    """What the motion planner is started with.

    Attributes:
        run_in_m: straight piece with the heading held before a goal whose direction of travel is given.
        longest_reverse_m: a longer way is not driven backwards, but for the straight piece to a goal; for a robot that
            does not see what is behind it.
        rear_lidar: the robot has one; else it drives half a metre straight ahead before it turns after a rest, as drive
            control lets it turn on ground only that was seen free.
        degenerate_speed_mps: speed limit while localization says that its surroundings do not hold the pose.
        pose_margin_m: stopping distance and 2 sigma of the robot's own position stay within it by a lower speed; at the
            usual sigma of up to 5 cm it does not slow the robot.
        creep_mps: speed that uncertainty of the position always leaves.
        input_age_limit_s: older inputs stop the robot.
        accept_nav_goal: for developers: goals from rviz are taken while the robot follows waypoints and the Operator
            wants none.
        nav_goal_speed_mps: speed limit of those.
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
