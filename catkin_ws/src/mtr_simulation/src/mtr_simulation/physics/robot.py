"""The simulated robot's shape and masses, from its URDF.

The base follows the published URDF and controller configuration of a Clearpath Jackal. Lengths in m, masses in kg,
positions in base_link (REP-103) unless they say otherwise.
"""
# SPDX-License-Identifier: Apache-2.0
from dataclasses import dataclass
from typing import Any, List, Optional, Tuple

from mtr_core import names
from mtr_core.errors import ConfigurationError
from mtr_description.mounts import KeyMount, Mount
from mtr_description.robot_geometry import RobotGeometry
from mtr_description.shipped import shipped_geometry
from mtr_description.urdf_tree import UrdfTree

Vector = Tuple[float, float, float]

WHEELS = ("front_left", "front_right", "rear_left", "rear_right")


@dataclass(frozen=True)
class Box:
    """Collision box: centre in its link, and its sides."""

    centre: Vector
    size: Vector


@dataclass(frozen=True)
class Masses:
    """Mass, centre of mass in its link, and moments of inertia about it: xx, yy, zz, xy, xz, yz in kg m2."""

    mass_kg: float
    centre: Vector
    inertia_kgm2: Tuple[float, ...]


@dataclass(frozen=True)
class RobotModel:
    """Data of the robot for the physics.

    Attributes:
        wheel_positions: in the order of WHEELS.
        wheel_width_m: width of the tyres.
        base_height_m: height of base_link above ground.
        chassis: boxes of the chassis, the fenders last.
        front_lidar, rear_lidar: mounts; rear_lidar is None if there is none.
        lidar_size: radius and height of a LiDAR's cylinder.
        mast_foot: position of the mast's foot.
        carriage_z_m: height above the mast's foot, with the lift at its lower stop.
    """

    wheel_radius_m: float
    wheel_width_m: float
    wheel_positions: Tuple[Vector, ...]
    wheel: Masses
    base_height_m: float
    chassis: Tuple[Box, ...]
    base: Masses
    front_lidar: Mount
    rear_lidar: Optional[Mount]
    lidar_size: Tuple[float, float]
    lidar_mass_kg: float
    mast_foot: Vector
    mast: Box
    mast_mass_kg: float
    carriage_z_m: float
    arm: Box
    carriage_mass_kg: float
    key_box: Box
    key_mass_kg: float
    key: KeyMount

    @property
    def half_track_m(self) -> float:
        """Distance from the middle line to the centre of a wheel."""
        return self.wheel_positions[0][1]

    @property
    def half_wheelbase_m(self) -> float:
        """Distance from base_link to an axle."""
        return self.wheel_positions[0][0]

    def key_in_base(self, lift_m: float) -> Vector:
        """Return the key's position with the lift at a height above its lower stop."""
        return self.key.x_m, self.key.y_m, self.key.min_height_m - self.base_height_m + lift_m


def robot_model(geometry: RobotGeometry, needs_rear_lidar: bool = True) -> RobotModel:
    """Return the robot of a URDF with the links of mtr_description.

    Raises:
        ConfigurationError: a required link is missing.
    """
    tree, wheels = geometry.tree, geometry.wheels()
    has_rear = needs_rear_lidar or any(link.name == names.REAR_LIDAR for link in tree.links)
    rear = geometry.mount(names.REAR_LIDAR) if has_rear else None
    front = geometry.mount(names.FRONT_LIDAR)
    for lidar in filter(None, (front, rear)):
        lidar.level()
    cylinder = _shapes(tree, names.FRONT_LIDAR, "Cylinder")[0]
    carriage_z = tree.place("carriage").position - tree.place("mast").position
    return RobotModel(
        wheels.radius_m, float(_shapes(tree, "front_left_wheel_link", "Cylinder")[0].geometry.length),
        tuple(_position(tree, f"{name}_wheel_link") for name in WHEELS), _masses(tree, "front_left_wheel_link"),
        geometry.base_height_m(), _boxes(tree, "chassis"), _masses(tree, "chassis"), front, rear,
        (float(cylinder.geometry.radius), float(cylinder.geometry.length)), _masses(tree, names.FRONT_LIDAR).mass_kg,
        _position(tree, "mast"), _boxes(tree, "mast")[0], _masses(tree, "mast").mass_kg, float(carriage_z[2]),
        _boxes(tree, "carriage")[0], _masses(tree, "carriage").mass_kg, _boxes(tree, names.KEY)[0],
        _masses(tree, names.KEY).mass_kg, geometry.key())


def shipped_robot() -> RobotModel:
    """Return the robot of mtr_description."""
    return robot_model(shipped_geometry())


def _link(tree: UrdfTree, name: str) -> Any:
    for link in tree.links:
        if link.name == name:
            return link
    raise ConfigurationError(f"The robot_description has no link {name}; the simulation needs the links of "
                             "mtr_description.")


def _shapes(tree: UrdfTree, name: str, kind: str) -> List[Any]:
    """Return the collisions with that kind of geometry; at least one."""
    found = [each for each in _link(tree, name).collisions if type(each.geometry).__name__ == kind]
    if not found:
        raise ConfigurationError(f"The collision geometry of {name} in robot_description has no {kind.lower()}; the "
                                 "simulation needs one.")
    return found


def _boxes(tree: UrdfTree, name: str) -> Tuple[Box, ...]:
    return tuple(Box(_vector(each.origin.xyz if each.origin is not None else (0.0, 0.0, 0.0)),
                     _vector(each.geometry.size)) for each in _shapes(tree, name, "Box"))


def _masses(tree: UrdfTree, name: str) -> Masses:
    inertial = _link(tree, name).inertial
    if inertial is None or inertial.inertia is None:
        raise ConfigurationError(f"The link {name} in robot_description has no mass; the simulation needs one.")
    centre, tensor = inertial.origin.xyz if inertial.origin is not None else (0.0, 0.0, 0.0), inertial.inertia
    return Masses(float(inertial.mass), _vector(centre),
                  (tensor.ixx, tensor.iyy, tensor.izz, tensor.ixy, tensor.ixz, tensor.iyz))


def _position(tree: UrdfTree, name: str) -> Vector:
    return _vector(tree.place(name).position)


def _vector(values: Any) -> Vector:
    x, y, z = (float(value) for value in values)
    return x, y, z
