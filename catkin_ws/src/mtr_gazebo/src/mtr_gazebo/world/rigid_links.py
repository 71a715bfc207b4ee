"""Rigid links: URDF links connected by fixed joints are one body of the physics engine."""
# SPDX-License-Identifier: Apache-2.0
from typing import TYPE_CHECKING, Any, Dict, List, NamedTuple, Tuple

import numpy as np

from mtr_core.errors import ConfigurationError
from mtr_description.urdf_tree import Place, UrdfTree, place_of

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Array = NDArray[np.float64]


class Inertia(NamedTuple):
    """Mass in kg, centre of mass, and moments of inertia (3, 3) about it in kg m2, in the link's frame."""

    mass_kg: float
    centre: "Array"
    tensor: "Array"


class Solid(NamedTuple):
    """Name of the original URDF link, pose in the rigid link, and URDF geometry."""

    name: str
    place: Place
    geometry: Any


class RigidLink(NamedTuple):
    """Attributes:
        name: of the URDF link that defines its frame.
        place: of its frame in the root link, all joints at zero.
        joint: URDF joint that moves it; None for the root.
        parent: name of the rigid link on which it moves; empty for the root.
    """

    name: str
    place: Place
    joint: Any
    parent: str
    inertia: Inertia
    solids: Tuple[Solid, ...]


def rigid_links(tree: UrdfTree) -> List[RigidLink]:
    """Return the rigid links, root first; ConfigurationError for a moving one without mass."""
    heads = {link.name: _head(tree, link.name) for link in tree.links}
    joints = {joint.child: joint for joint in tree.joints}
    return [_rigid(tree, name, joints.get(name), heads) for name in dict.fromkeys(heads.values())]


def seen_from(frame: Place, place: Place) -> Place:
    """Return a place relative to `frame`; both are given in the same frame."""
    back = frame.rotation.T
    return Place(back @ place.rotation, back @ (place.position - frame.position))


def _head(tree: UrdfTree, link: str) -> str:
    """Return the name of the rigid link that contains this link."""
    moving = [joint.child for joint in tree.chain(link) if joint.type != "fixed"]
    return moving[-1] if moving else tree.root


def _rigid(tree: UrdfTree, name: str, joint: Any, heads: Dict[str, str]) -> RigidLink:
    frame = tree.place(name)
    members = [link for link in tree.links if heads[link.name] == name]
    places = [seen_from(frame, tree.place(link.name)) for link in members]
    parts = [_inertia(link, place) for link, place in zip(members, places) if link.inertial is not None]
    if not parts:
        raise ConfigurationError(f"The link {name} in robot_description, and all that is fixed to it, has no mass; the "
                                 "simulation needs one.")
    solids = [Solid(link.name, place @ place_of(collision.origin), collision.geometry)
              for link, place in zip(members, places) for collision in link.collisions]
    return RigidLink(name, frame, joint, heads[joint.parent] if joint else "", _together(parts), tuple(solids))


def _inertia(link: Any, place: Place) -> Inertia:
    """Return the inertia of a link that is fixed at a place."""
    origin, values = place @ place_of(link.inertial.origin), link.inertial.inertia
    tensor = np.array([[values.ixx, values.ixy, values.ixz], [values.ixy, values.iyy, values.iyz],
                       [values.ixz, values.iyz, values.izz]], dtype=float)
    return Inertia(float(link.inertial.mass), origin.position, origin.rotation @ tensor @ origin.rotation.T)


def _together(parts: List[Inertia]) -> Inertia:
    mass = sum(part.mass_kg for part in parts)
    centre = sum((part.mass_kg * part.centre for part in parts), np.zeros(3)) / mass
    tensor = np.zeros((3, 3))
    for part in parts:
        away = part.centre - centre
        # Parallel axis theorem (Steiner).
        tensor = tensor + part.tensor + part.mass_kg * (away @ away * np.eye(3) - np.outer(away, away))
    return Inertia(mass, centre, tensor)
