"""Geometry of the robot from its URDF: mounts, footprint, key and wheels."""
# SPDX-License-Identifier: Apache-2.0
from typing import Any, List

import numpy as np

from mtr_core import names
from mtr_core.errors import ConfigurationError

from .mounts import Footprint, KeyMount, LidarMounts, Mount, Wheels, check_value
from .outline import convex_hull, corners_from_above
from .urdf_tree import DIGITS, UrdfTree

# Tolerance of URDF numbers that must be equal or zero, in m or as a component of a direction.
TOLERANCE = 1e-6
WHEEL_COUNT = 4


class RobotGeometry:
    """Geometry queries for nodes; the C++ equivalent is mtr_description/robot_geometry.hpp.

    Each query raises ConfigurationError if the URDF does not contain the answer. The sentence has the value, its place
    and the allowed range. Parts without a query may be missing.
    """

    def __init__(self, urdf_text: str):
        self.tree = UrdfTree(urdf_text)
        if self.tree.root != names.BASE:
            raise ConfigurationError(f"The root link of robot_description is {self.tree.root}; "
                                     f"allowed is {names.BASE}.")

    def mount(self, frame: str) -> Mount:
        """Return the mount of a frame that is connected to base_link by fixed joints only."""
        for joint in self.tree.chain(frame):
            if joint.type != "fixed":
                raise ConfigurationError(f"The joint {joint.name} between {names.BASE} and {frame} "
                                         f"in robot_description is {joint.type}; allowed is fixed.")
        place = self.tree.place(frame)
        x, y, z = (float(value) for value in place.position)
        return Mount(frame, x, y, z, *place.rpy())

    def lidars(self, has_rear: bool = True) -> LidarMounts:
        """Return the mounts of the LiDARs; ConfigurationError unless they exist and are upright and level."""
        return LidarMounts(self.mount(names.FRONT_LIDAR).level(),
                           self.mount(names.REAR_LIDAR).level() if has_rear else None)

    def footprint(self) -> Footprint:
        """Return the outline of all collision shapes; wheel rotation and lift do not change it."""
        moving = {*(joint.name for joint in self._wheel_joints()), self._lift_of_key().name}
        for joint in self.tree.joints:
            if joint.type != "fixed" and joint.name not in moving:
                raise ConfigurationError(f"The joint {joint.name} in robot_description is {joint.type}; allowed are "
                                         "fixed joints, the wheels' and the lift's.")
        points = [point for shape in self.tree.shapes() for point in corners_from_above(*shape)]
        if not points:
            raise ConfigurationError("The robot_description has no collision geometry; allowed are descriptions that "
                                     "say with which boxes, cylinders and spheres the robot collides.")
        return Footprint(convex_hull(points))

    def key(self) -> KeyMount:
        """Return the remote key, which is on a vertical lift."""
        limit = self._lift_of_key().limit
        x, y, z = (float(value) for value in self.tree.place(names.KEY).position)
        return KeyMount(x, y, round(z + self.base_height_m(), DIGITS), float(limit.upper))

    def wheels(self) -> Wheels:
        """Return the four wheels, which rotate on base_link by continuous joints."""
        wheels = self._wheel_joints()
        places = np.array([self.tree.place(joint.child).position for joint in wheels])
        radii = [self._wheel_radius(joint.child) for joint in wheels]
        for name, values in (("radius", radii), ("height", places[:, 2])):
            _check_equal(name, [joint.child for joint in wheels], values)
        return Wheels(float(np.ptp(places[:, 0])), float(np.ptp(places[:, 1])), radii[0], float(places[0, 2]))

    def base_height_m(self) -> float:
        """Return the height of base_link above level ground."""
        wheels = self.wheels()
        return round(wheels.radius_m - wheels.axle_z_m, DIGITS)

    def _wheel_joints(self) -> List[Any]:
        wheels = [joint for joint in self.tree.joints if joint.type == "continuous" and joint.parent == names.BASE]
        if len(wheels) != WHEEL_COUNT:
            raise ConfigurationError(f"The robot_description has {len(wheels)} continuous joints on {names.BASE}; "
                                     f"allowed is {WHEEL_COUNT}, one for each wheel.")
        return wheels

    def _wheel_radius(self, link: str) -> float:
        radii = [geometry.radius for name, _, geometry in self.tree.shapes()
                 if name == link and type(geometry).__name__ == "Cylinder"]
        if len(radii) != 1:
            raise ConfigurationError(f"The collision geometry of {link} in robot_description has {len(radii)} "
                                     "cylinders; allowed is one, the tyre.")
        return float(radii[0])

    def _lift_of_key(self) -> Any:
        """Return the only joint that moves the key; it is prismatic, vertical, and starts at zero."""
        moving = [joint for joint in self.tree.chain(names.KEY) if joint.type != "fixed"]
        if [joint.type for joint in moving] != ["prismatic"]:
            found = ", ".join(f"{joint.name} ({joint.type})" for joint in moving) or "none"
            raise ConfigurationError(f"The moving joints between {names.BASE} and {names.KEY} in robot_description are "
                                     f"{found}; allowed is one prismatic joint, the lift.")
        lift = moving[0]
        up = float((self.tree.place(lift.child).rotation @ np.array(lift.axis or (1.0, 0.0, 0.0)))[2])
        check_value(f"The upward part of the axis of joint {lift.name}", up, 1.0 - TOLERANCE, 1.0 + TOLERANCE, "")
        lower, upper = (lift.limit.lower, lift.limit.upper) if lift.limit is not None else (0.0, 0.0)
        check_value(f"The lower limit of joint {lift.name}", lower, 0.0, 0.0, "m")
        check_value(f"The upper limit of joint {lift.name}", upper, 0.01, 5.0, "m")
        return lift


def _check_equal(what: str, links: List[str], values: Any) -> None:
    for link, value in zip(links, values):
        check_value(f"The {what} of {link}", float(value), values[0] - TOLERANCE, values[0] + TOLERANCE, "m")
