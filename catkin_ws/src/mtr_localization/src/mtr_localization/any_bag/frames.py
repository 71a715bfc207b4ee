"""Sensor frames of a robot, from the transforms of its bag or from its URDF."""
# SPDX-License-Identifier: Apache-2.0
import math
from typing import Dict, Iterable, List, Optional, Set, Tuple

import numpy as np
from scipy.spatial.transform import Rotation

from mtr_core.arrays import FloatArray
from mtr_description.urdf_tree import UrdfTree, place_of

from .errors import BagUnusable

# Tolerance of a fixed mount, for the rounding of tf; a mount that changes while driving is not reliable.
FIXED_M, FIXED_RAD = 1e-3, 1e-3


def matrix(translation: Iterable[float], quaternion: Iterable[float], source: str) -> FloatArray:
    """Return parent_from_child, 4x4, from a translation in m and a quaternion x, y, z, w.

    Args:
        source: topic or frames, for the sentence of BagUnusable, which is raised for an invalid rotation.
    """
    found = np.eye(4)
    try:
        found[:3, :3] = Rotation.from_quat(list(quaternion)).as_matrix()
    except ValueError:
        raise BagUnusable(f"A pose of {source} has no rotation: its quaternion is zero or not a number. Correct what "
                          "publishes it.") from None
    found[:3, 3] = list(translation)
    if not np.isfinite(found).all():
        raise BagUnusable(f"A pose of {source} is not a number. Correct what publishes it.")
    return found


class FrameTree:
    """Frames with their parents, and which of them move."""

    def __init__(self) -> None:
        self._parents: Dict[str, Tuple[str, FloatArray]] = {}
        self._moving: Set[str] = set()

    def add(self, parent: str, child: str, parent_from_child: FloatArray) -> None:
        """Add a transform; frames are published repeatedly."""
        parent, child = parent.lstrip("/"), child.lstrip("/")
        known = self._parents.get(child)
        if known is None:
            self._parents[child] = (parent, parent_from_child)
        elif known[0] != parent or not _are_same(known[1], parent_from_child):
            self._moving.add(child)

    @property
    def names(self) -> List[str]:
        """All children."""
        return sorted(self._parents)

    def parent_of(self, child: str) -> Optional[str]:
        """Return the parent of a frame; None for a root."""
        known = self._parents.get(child)
        return None if known is None else known[0]

    def is_moving(self, child: str) -> bool:
        """Return True if the frame has moved relative to its parent."""
        return child in self._moving

    def fixed(self, base: str, frame: str) -> FloatArray:
        """Return base_from_frame; BagUnusable if it is unknown or not constant."""
        above, below = self._chain(base), self._chain(frame)
        common = next((each for each in below if each in above), None)
        if common is None:
            raise BagUnusable(f"Nothing says where {frame} is on the robot: the bag has no transforms from {base} to "
                              "it. Name the robot's frame by --base-frame, or its description by --urdf.")
        for child in [*_until(above, common), *_until(below, common)]:
            if self.is_moving(child):
                raise BagUnusable(f"The LiDAR of {frame} is not fixed on the robot: {child} moves in "
                                  f"{self.parent_of(child)}.")
        found: FloatArray = np.linalg.inv(self._from(common, above)) @ self._from(common, below)
        return found

    def _chain(self, frame: str) -> List[str]:
        chain = [frame.lstrip("/")]
        while True:
            parent = self.parent_of(chain[-1])
            if parent is None or parent in chain:
                return chain
            chain.append(parent)

    def _from(self, common: str, chain: List[str]) -> FloatArray:
        found = np.eye(4)
        for child in _until(chain, common):
            found = self._parents[child][1] @ found
        return found


def yaw_of(transform: FloatArray) -> float:
    """Return the direction of the x axis in the plane, rad."""
    return math.atan2(float(transform[1, 0]), float(transform[0, 0]))


def quaternion_of(transform: FloatArray) -> List[float]:
    """Return the quaternion x, y, z, w."""
    return [float(part) for part in Rotation.from_matrix(transform[:3, :3]).as_quat()]


def add_urdf(tree: FrameTree, description: UrdfTree) -> None:
    """Add the fixed joints of a robot description."""
    for joint in description.joints:
        if joint.type == "fixed":
            place = place_of(joint.origin)
            tree.add(joint.parent, joint.child, np.block([[place.rotation, place.position[:, None]],
                                                          [np.array([[0.0, 0.0, 0.0, 1.0]])]]))


def _until(chain: List[str], end: str) -> List[str]:
    return chain[:chain.index(end)]


def _are_same(one: FloatArray, other: FloatArray) -> bool:
    moved = np.linalg.inv(one) @ other
    turned = float(np.linalg.norm(Rotation.from_matrix(moved[:3, :3]).as_rotvec()))
    return float(np.linalg.norm(moved[:3, 3])) <= FIXED_M and turned <= FIXED_RAD
