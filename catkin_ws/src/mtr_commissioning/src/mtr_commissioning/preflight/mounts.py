"""Compares the LiDARs' poses in the description with transforms of the base or a driver.

The robot's nodes use only the description. A stock Jackal publishes base_link -> ... -> front_laser from its own
description, which is an independent measurement.
"""
# SPDX-License-Identifier: Apache-2.0
import math
from typing import AbstractSet, Dict, Iterator, List, NamedTuple, Optional, Set, Tuple

import numpy as np

from mtr_core import names
from mtr_core.errors import ConfigurationError
from mtr_description.robot_geometry import RobotGeometry
from mtr_description.urdf_tree import Place
from mtr_motion_check.finding import Finding, bad, good

from .expected import Setup
from .records import RobotRecord, SaidTransform

CHECK = "frame.mount"
# Publisher of robot.launch, whose transforms are the description itself.
OWN_PUBLISHER = "/robot_state_publisher"
# A tape measures to 1 cm; 2 cm and 1 deg (5 cm at 3 m) affect every distance.
MAX_APART_M, MAX_TURN_RAD = 0.02, math.radians(1.0)
# tf2 rejects a quaternion whose norm is farther from 1 than this, and reports it.
MAX_NORM_ERROR = 1e-2
_CM_PER_M = 100.0


class SaidPlace(NamedTuple):
    """base_from_frame by the received transforms, with the nodes that published them."""

    place: Place
    nodes: Set[str]


def mount_findings(record: RobotRecord, setup: Setup, geometry: RobotGeometry) -> List[Finding]:
    """Return a finding for each LiDAR with a pose from another publisher."""
    links = [names.FRONT_LIDAR, names.REAR_LIDAR] if setup.rear_lidar else [names.FRONT_LIDAR]
    found = (mount_finding(link, setup.frames.get(link, link), record, geometry) for link in links)
    return [finding for finding in found if finding is not None]


def mount_finding(link: str, frame: str, record: RobotRecord, geometry: RobotGeometry) -> Optional[Finding]:
    """Compare one LiDAR. link: of the description. frame: of the LiDAR's scans. Return None without a transform from
    another publisher. An outdated transform of the own publisher, from before a change of the description, is compared
    too."""
    try:
        described = geometry.tree.place(link)
    except ConfigurationError:  # description_finding reports it
        return None
    said = list(said_places(frame, record.said))
    if not said:
        return None
    worst = max(said, key=lambda each: excess(each.place, described))
    if excess(worst.place, described) > 1.0:
        return far_finding(link, frame, worst, described)
    others = sorted(set().union(*(each.nodes for each in said)) - {OWN_PUBLISHER})
    if not others:
        return None
    return good(CHECK, frame, f"It is where robot_description has {link}, within {_CM_PER_M * MAX_APART_M:.0f} cm and "
                f"{math.degrees(MAX_TURN_RAD):.0f} deg (from {', '.join(others)}).",
                apart_m(worst.place, described), MAX_APART_M, unit="m")


def far_finding(link: str, frame: str, said: SaidPlace, described: Place) -> Finding:
    """Report two poses that do not agree."""
    distance_m, turn_rad = apart_m(said.place, described), turn_between_rad(said.place, described)
    value = ((turn_rad, MAX_TURN_RAD, "rad") if distance_m <= MAX_APART_M else (distance_m, MAX_APART_M, "m"))
    return bad(CHECK, frame, f"{', '.join(sorted(said.nodes))} has {frame} at {shown(said.place)} in {names.BASE}, "
               f"robot_description has {link} at {shown(described)}: {_CM_PER_M * distance_m:.1f} cm and "
               f"{math.degrees(turn_rad):.1f} deg apart, allowed are {_CM_PER_M * MAX_APART_M:.0f} cm and "
               f"{math.degrees(MAX_TURN_RAD):.0f} deg: measure where this LiDAR is, and correct the file that "
               "robot_file:= names, by which distances are measured, or what that node publishes.",
               value[0], value[1], unit=value[2])


def said_places(frame: str, said: Dict[Tuple[str, str, str], SaidTransform]) -> Iterator[SaidPlace]:
    """Yield the pose of a frame in base_link along each chain of transforms."""
    yield from _ways_up(frame, said, frozenset())


def _ways_up(frame: str, said: Dict[Tuple[str, str, str], SaidTransform], below: AbstractSet[str]
             ) -> Iterator[SaidPlace]:
    for (parent, child, node), transform in sorted(said.items()):
        place = place_of(transform)
        if child != frame or parent in below or place is None:
            continue
        if parent == names.BASE:
            yield SaidPlace(place, {node})
        else:
            for above in _ways_up(parent, said, below | {frame}):
                yield SaidPlace(above.place @ place, above.nodes | {node})


def place_of(transform: SaidTransform) -> Optional[Place]:
    """Return parent_from_child; None for invalid numbers."""
    position, quaternion = np.array(transform.position_m), np.array(transform.quaternion)
    norm = float(np.linalg.norm(quaternion))
    if not np.isfinite(position).all() or not abs(norm - 1.0) < MAX_NORM_ERROR:
        return None
    x, y, z, w = quaternion / norm
    rotation = np.array([[1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
                         [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
                         [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)]])
    return Place(rotation, position)


def excess(said: Place, described: Place) -> float:
    """Return distance or rotation between the two relative to the limits; above 1 is too much."""
    return max(apart_m(said, described) / MAX_APART_M, turn_between_rad(said, described) / MAX_TURN_RAD)


def apart_m(said: Place, described: Place) -> float:
    """Return the distance of the two origins."""
    return float(np.linalg.norm(said.position - described.position))


def turn_between_rad(said: Place, described: Place) -> float:
    """Return the angle of the rotation between the two, about any axis."""
    turn = described.rotation.T @ said.rotation
    axis = np.array([turn[2, 1] - turn[1, 2], turn[0, 2] - turn[2, 0], turn[1, 0] - turn[0, 1]])
    return math.atan2(float(np.linalg.norm(axis)), float(np.trace(turn)) - 1.0)


def shown(place: Place) -> str:
    """Return position and direction for a person."""
    x, y, z = place.position
    roll, pitch, yaw = (math.degrees(angle) for angle in place.rpy())
    return f"({x:.3f}, {y:.3f}, {z:.3f}) m with roll, pitch and yaw ({roll:.1f}, {pitch:.1f}, {yaw:.1f}) deg"
