"""SDF model of the robot from its URDF: rigid links, joints, and tyres with friction."""
# SPDX-License-Identifier: Apache-2.0
from typing import List, Optional
from xml.etree.ElementTree import Element

import numpy as np

from mtr_core.errors import ConfigurationError
from mtr_core.se2 import Pose2
from mtr_description.robot_geometry import RobotGeometry
from mtr_description.urdf_tree import Place

from .elements import add
from .rigid_links import RigidLink, Solid, rigid_links

ROBOT = "robot"
JOINT_TYPES = {"continuous": "revolute", "prismatic": "prismatic"}
# Contact parameters of a tyre, per contact point: a robot of 24 kg sinks by 0.3 mm without bouncing.
CONTACT_STIFFNESS_NPM, CONTACT_DAMPING_NSPM = 1e5, 1e3


def add_robot(world: Element, geometry: RobotGeometry, world_from_base: Pose2, friction: float) -> Element:
    """Add the model at the start pose of the scenario; the wheels slide by ODE's friction."""
    model = add(world, "model", name=ROBOT)
    pose = world_from_base
    add(model, "pose", (pose.x, pose.y, geometry.base_height_m(), 0.0, 0.0, pose.heading))
    for link in rigid_links(geometry.tree):
        _add_link(model, link, friction)
        if link.joint is not None:
            _add_joint(model, link)
    return model


def _add_link(model: Element, link: RigidLink, friction: float) -> None:
    element = add(model, "link", name=link.name)
    add(element, "pose", _pose(link.place))
    inertial = add(element, "inertial")
    add(inertial, "pose", (*link.inertia.centre, 0.0, 0.0, 0.0))
    add(inertial, "mass", link.inertia.mass_kg)
    moments = add(inertial, "inertia")
    for row, column, name in ((0, 0, "ixx"), (0, 1, "ixy"), (0, 2, "ixz"), (1, 1, "iyy"), (1, 2, "iyz"), (2, 2, "izz")):
        add(moments, name, float(link.inertia.tensor[row, column]))
    is_wheel = link.joint is not None and link.joint.type == "continuous"
    for index, solid in enumerate(link.solids):
        _add_solid(element, f"{solid.name}_{index}", solid, friction if is_wheel else None)


def _add_solid(link: Element, name: str, solid: Solid, friction: Optional[float]) -> None:
    collision, visual = add(link, "collision", name=name), add(link, "visual", name=name)
    for holder in (collision, visual):
        add(holder, "pose", _pose(solid.place))
        _add_geometry(add(holder, "geometry"), solid)
    if friction is not None:
        surface = add(collision, "surface")
        ode = add(add(surface, "friction"), "ode")
        add(ode, "mu", friction)
        add(ode, "mu2", friction)
        contact = add(add(surface, "contact"), "ode")
        add(contact, "kp", CONTACT_STIFFNESS_NPM)
        add(contact, "kd", CONTACT_DAMPING_NSPM)


def _add_geometry(element: Element, solid: Solid) -> None:
    geometry, kind = solid.geometry, type(solid.geometry).__name__
    if kind == "Box":
        add(add(element, "box"), "size", [float(side) for side in geometry.size])
    elif kind == "Cylinder":
        cylinder = add(element, "cylinder")
        add(cylinder, "radius", float(geometry.radius))
        add(cylinder, "length", float(geometry.length))
    elif kind == "Sphere":
        add(add(element, "sphere"), "radius", float(geometry.radius))
    else:
        raise ConfigurationError(f"The collision geometry of {solid.name} in robot_description is a {kind.lower()}; "
                                 "allowed are box, cylinder and sphere.")


def _add_joint(model: Element, link: RigidLink) -> None:
    joint = link.joint
    if joint.type not in JOINT_TYPES:
        raise ConfigurationError(f"The joint {joint.name} in robot_description is {joint.type}; allowed are fixed "
                                 "joints, the wheels' and the lift's.")
    element = add(model, "joint", name=joint.name, type=JOINT_TYPES[joint.type])
    add(element, "parent", link.parent)
    add(element, "child", link.name)
    axis = add(element, "axis")
    # In both URDF and SDF, the axis is in the child's frame.
    add(axis, "xyz", [float(value) for value in joint.axis or (1.0, 0.0, 0.0)])
    if joint.type == "prismatic":
        limit = add(axis, "limit")
        add(limit, "lower", float(joint.limit.lower))
        add(limit, "upper", float(joint.limit.upper))


def _pose(place: Place) -> List[float]:
    return [float(value) for value in (*np.round(place.position, 9), *place.rpy())]
