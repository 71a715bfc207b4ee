"""Links and joints of a URDF, as places in its root link."""
# SPDX-License-Identifier: Apache-2.0
import math
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Iterator, List, Tuple

import numpy as np
from urdf_parser_py import urdf

from mtr_core.errors import ConfigurationError

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Array = NDArray[np.float64]

# Sums along a chain are rounded to a nanometre, to remove rounding errors.
DIGITS = 9


@dataclass(frozen=True)
class Place:
    """root_from_frame: rotation matrix (3, 3) and position (3,) in m."""

    rotation: "Array"
    position: "Array"

    def __matmul__(self, other: "Place") -> "Place":
        return Place(self.rotation @ other.rotation, self.position + self.rotation @ other.position)

    def rpy(self) -> Tuple[float, float, float]:
        """Roll, pitch and yaw in rad: rotations about the fixed axes x, y, z in this order."""
        r = self.rotation
        return (math.atan2(r[2, 1], r[2, 2]) + 0.0, math.atan2(-r[2, 0], math.hypot(r[0, 0], r[1, 0])) + 0.0,
                math.atan2(r[1, 0], r[0, 0]) + 0.0)


class UrdfTree:
    """A parsed URDF with all joints at zero; ConfigurationError for an invalid text."""

    def __init__(self, text: str):
        try:
            self._robot = urdf.URDF.from_xml_string(text.encode("utf-8"))
            self.root: str = self._robot.get_root()
        except Exception as error:  # The parser passes errors of its XML library and its assertions.
            raise ConfigurationError("Parameter robot_description cannot be read; allowed is a URDF "
                                     f"({' '.join(str(error).split())[:200]}).") from error

    @property
    def links(self) -> List[Any]:
        """All links, in the order of the text."""
        return list(self._robot.links)

    @property
    def joints(self) -> List[Any]:
        """All joints, in the order of the text."""
        return list(self._robot.joints)

    def chain(self, link: str) -> List[Any]:
        """Return the joints from the root to the link; ConfigurationError for an unknown link."""
        if link not in self._robot.link_map:
            raise ConfigurationError(f"The robot_description has no link {link}; allowed are descriptions in which it "
                                     f"hangs on {self.root}.")
        found: List[Any] = []
        while link in self._robot.parent_map:
            name, link = self._robot.parent_map[link]
            found.insert(0, self._robot.joint_map[name])
        return found

    def place(self, link: str) -> Place:
        """Return root_from_link with all joints at zero."""
        place = place_of(None)
        for joint in self.chain(link):
            place = place @ place_of(joint.origin)
        return Place(place.rotation, np.round(place.position, DIGITS) + 0.0)

    def shapes(self) -> Iterator[Tuple[str, Place, Any]]:
        """Yield link, root_from_shape and geometry of all collision shapes."""
        for link in self.links:
            for collision in link.collisions:
                yield link.name, self.place(link.name) @ place_of(collision.origin), collision.geometry


def place_of(origin: Any) -> Place:
    """Return the place of an origin element; a missing one means the identity."""
    xyz = (origin.xyz if origin is not None else None) or (0.0, 0.0, 0.0)
    roll, pitch, yaw = (origin.rpy if origin is not None else None) or (0.0, 0.0, 0.0)
    return Place(_turn(2, yaw) @ _turn(1, pitch) @ _turn(0, roll), np.array(xyz, dtype=float))


def _turn(axis: int, angle_rad: float) -> "Array":
    """Return the rotation matrix about a coordinate axis."""
    cos, sin = math.cos(angle_rad), math.sin(angle_rad)
    matrix = np.eye(3)
    i, j = (axis + 1) % 3, (axis + 2) % 3
    matrix[i, i] = matrix[j, j] = cos
    matrix[i, j], matrix[j, i] = -sin, sin
    return matrix
