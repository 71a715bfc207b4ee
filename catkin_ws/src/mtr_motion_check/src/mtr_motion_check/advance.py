"""Straight paths: compares wheels, LiDARs and accelerometer, and identifies the wrong one."""
# SPDX-License-Identifier: Apache-2.0
import math
from typing import List, NamedTuple, Optional, Tuple

from mtr_core import names
from mtr_core.se2 import wrap_angle
from mtr_description.mounts import LidarMounts

from .directions import FRONT, MIN_DISTANCE_M, REAR, Direction, Lidar, direction, distance_m, wheels_distance_m
from .finding import Finding, bad, good, needs_more
from .inertia import Thrust
from .steps import Step
from .swap import lever_says_swapped

# A wheel's radius varies by 0.5 % with mounting and inflation; 5 % means another tyre or another robot's configuration.
MAX_SCALE_ERROR = 0.05
# Maximum of two standard errors of a valid comparison, so that errors of 10 % are found.
MAX_DOUBT = 0.04
# A LiDAR with this rotation error displaces a wall 10 m away by 0.9 m; scan matching is accurate to 0.5 deg.
MAX_DIRECTION_RAD = math.radians(5.0)
# Wheels that report less than this share of the distance do not work at all.
MIN_WHEELS_SHARE = 0.1
CHECK = "motion.forward"
ODOMETRY = names.WHEEL_ODOMETRY


class Witnesses(NamedTuple):
    """References for or against the wheels, in addition to the LiDARs.

    Attributes:
        thrust: of the accelerometer; None if undecided.
        wheels_turn_back: the wheels' rotation has the wrong sign, too.
    """

    thrust: Optional[Thrust]
    wheels_turn_back: bool


Told = List[Tuple[Lidar, Direction]]


def advance_findings(steps: List[Step], mounts: LidarMounts, witnesses: Witnesses) -> List[Finding]:
    """Check the odometry's sign and scale, and the LiDARs' directions, with the usable LiDARs."""
    lidars = [FRONT, *([REAR] if mounts.rear else [])]
    missing = [finding for lidar in lidars for finding in unusable(lidar, steps)]
    told = [(lidar, seen) for lidar in lidars if not unusable(lidar, steps)
            for seen in (direction(steps, lidar.sensor),) if seen]
    # A fault of both LiDARs is reported once.
    return list(dict.fromkeys(missing)) + judged(told, steps, mounts, witnesses)


def judged(told: Told, steps: List[Step], mounts: LidarMounts, witnesses: Witnesses) -> List[Finding]:
    """Evaluate the usable LiDARs; empty without any."""
    if not told:
        return []
    coarse = [finding for lidar, seen in told for finding in too_coarse(lidar, seen)]
    if coarse:
        return coarse
    if all(seen.points_to(0.0, MAX_DIRECTION_RAD) for _, seen in told):
        return [scale_finding(told)]
    if is_turned_about([seen for _, seen in told], mounts):
        return [which_is_reversed([lidar for lidar, _ in told], steps, mounts, witnesses)]
    return [finding for lidar, seen in told for finding in mount_findings(lidar, seen)]


def unusable(lidar: Lidar, steps: List[Step]) -> List[Finding]:
    """Return the reasons why a LiDAR cannot be compared; empty if it can."""
    seen_m, wheels_m = distance_m(steps, lidar.sensor), wheels_distance_m(steps, lidar.sensor)
    driven_m = sum(abs(step.wheels.x) for step in steps)
    if seen_m >= MIN_DISTANCE_M:
        if wheels_m >= MIN_WHEELS_SHARE * seen_m:
            return []
        return [bad(CHECK, ODOMETRY, f"The wheels say {wheels_m:.2f} m where {lidar.frame} saw {seen_m:.2f} m of way; "
                    "they have to agree within 5 %: look for what keeps the base from counting its wheels.",
                    wheels_m, seen_m, unit="m")]
    if driven_m < MIN_DISTANCE_M:
        return [needs_more(ODOMETRY, f"The way was {driven_m:.2f} m; at least {MIN_DISTANCE_M:.1f} m on straight lines "
                    "are needed: drive 1 m forward and back.", driven_m, MIN_DISTANCE_M, unit="m")]
    return [needs_more(lidar.topic, f"Its scans tell {seen_m:.2f} m of a way of {driven_m:.2f} m; at least "
                f"{MIN_DISTANCE_M:.1f} m are needed: look for what covers the LiDAR, or drive where more than a bare "
                "wall stands around the robot, on straight lines.", seen_m, MIN_DISTANCE_M, unit="m")]


def too_coarse(lidar: Lidar, seen: Direction) -> List[Finding]:
    """Report a LiDAR so inaccurate that a faulty robot would pass."""
    if 2.0 * seen.scale_sigma <= MAX_DOUBT * seen.scale and 2.0 * seen.angle_sigma_rad <= MAX_DIRECTION_RAD:
        return []
    percent = 200.0 * seen.scale_sigma / max(seen.scale, 1e-9)
    return [needs_more(lidar.topic, f"Its scans tell the way to {percent:.0f} % only; {100.0 * MAX_DOUBT:.0f} % are "
                       "needed: drive on, or where more stands around the robot and nobody walks about.", percent,
                       100.0 * MAX_DOUBT, unit="%")]


def scale_finding(told: Told) -> Finding:
    """Check the wheels' scale; all LiDARs agree on forward."""
    scales = [seen.scale for _, seen in told]
    mean, sigma = sum(scales) / len(scales), max(seen.scale_sigma for _, seen in told)
    wheels = 1.0 / max(mean, 1e-9)
    who = " and ".join(lidar.frame for lidar, _ in told)
    apart = abs(scales[0] - scales[-1])
    if apart > MAX_SCALE_ERROR + 2.0 * sigma:
        return bad(CHECK, FRONT.topic, f"{FRONT.frame} saw {scales[0]:.2f} m and {REAR.frame} "
                   f"{scales[-1]:.2f} m for each metre of the wheels; they have to agree within "
                   f"{100.0 * MAX_SCALE_ERROR:.0f} %: look which LiDAR measures ranges wrongly.", apart,
                   MAX_SCALE_ERROR)
    if abs(mean - 1.0) <= MAX_SCALE_ERROR + sigma:
        return good(CHECK, ODOMETRY, f"The wheels say {wheels:.3f} times the way that {who} saw.", wheels,
                    1.0 + MAX_SCALE_ERROR)
    return bad(CHECK, ODOMETRY, f"The wheels say {wheels:.2f} times the way that {who} saw; allowed is "
               f"{1.0 - MAX_SCALE_ERROR:.2f} to {1.0 + MAX_SCALE_ERROR:.2f}: correct the wheels' radius in the "
               "configuration of the base.", wheels, 1.0 + MAX_SCALE_ERROR)


def is_turned_about(found: List[Direction], mounts: LidarMounts) -> bool:
    """Return True if all LiDARs saw the pattern of a wrong sign of the wheels, or of exchanged topics."""
    if all(each.points_to(math.pi, MAX_DIRECTION_RAD) for each in found):
        return True
    if mounts.rear is None or len(found) < 2:
        return False
    between = wrap_angle(mounts.front.heading - mounts.rear.heading)
    return (found[0].points_to(between, MAX_DIRECTION_RAD) and found[-1].points_to(-between, MAX_DIRECTION_RAD))


def which_is_reversed(lidars: List[Lidar], steps: List[Step], mounts: LidarMounts, witnesses: Witnesses) -> Finding:
    """All LiDARs contradict the wheels: decide between them by accelerometer, wheels' rotation and LiDARs' levers."""
    wheels_are_wrong = votes_against_wheels(steps, mounts, witnesses)
    start = "The wheels say forward where the LiDARs see the robot go backward"
    if wheels_are_wrong is None:
        return needs_more(f"{ODOMETRY} or LiDARs", f"{start}: either the odometry has the wrong sign or the LiDARs are "
                   "exchanged; set off and brake more briskly and turn on the spot, so that they can be told apart.",
                   -1.0, 1.0)
    if wheels_are_wrong:
        return bad(CHECK, ODOMETRY, f"{start}, and the other sensors agree with the LiDARs: the odometry has the wrong "
                   "sign; correct the wheels' direction in the configuration of the base.", -1.0, 1.0)
    if len(lidars) < 2:
        swapped = "" if mounts.rear is None else ", or front and rear LiDAR are swapped"
        return bad(CHECK, lidars[0].topic, f"{start}, and the other sensors agree with the wheels: {lidars[0].frame} "
                   f"is turned by 180 deg against robot_description{swapped}; mount or describe it rightly.", 180.0,
                   math.degrees(MAX_DIRECTION_RAD), unit="deg")
    return bad(CHECK, f"{FRONT.topic} and {REAR.topic}", f"{start}, and the other sensors agree with the wheels: front "
               "and rear LiDAR are swapped; exchange their cables or the topics of their drivers.", 180.0, 0.0,
               unit="deg")


def votes_against_wheels(steps: List[Step], mounts: LidarMounts, witnesses: Witnesses) -> Optional[bool]:
    """Return True if the odometry's sign is wrong; None if undecided. The most reliable reference is used first."""
    if witnesses.wheels_turn_back:
        return True
    thrust = witnesses.thrust
    if thrust and abs(thrust.x) > max(0.5, abs(thrust.y)):
        return thrust.x < 0.0
    swapped = lever_says_swapped(steps, mounts)
    return None if swapped is None else not swapped


def mount_findings(lidar: Lidar, seen: Direction) -> List[Finding]:
    """Report a LiDAR whose direction differs from its description."""
    if seen.points_to(0.0, MAX_DIRECTION_RAD):
        return []
    turned = math.degrees(seen.angle_rad)
    return [bad(CHECK, lidar.topic, f"{lidar.frame} saw the robot go {abs(turned):.0f} deg aside of where the wheels "
                f"say; allowed is {math.degrees(MAX_DIRECTION_RAD):.0f} deg: it is turned by {-turned:.0f} deg against "
                "robot_description, or another LiDAR is on its topic.", turned, math.degrees(MAX_DIRECTION_RAD),
                unit="deg")]
