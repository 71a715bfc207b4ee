"""Convex hulls as triangle files, which Gazebo loads; other simulators compute the hull themselves."""
# SPDX-License-Identifier: Apache-2.0
from typing import TYPE_CHECKING, List

import numpy as np
from scipy.spatial import ConvexHull

from mtr_simulation.site.shapes import Hull

if TYPE_CHECKING:
    from numpy.typing import NDArray


def stl_of(hull: Hull) -> str:
    """Return the STL text of the hull's surface in m, with triangles counterclockwise as seen from outside."""
    lines = [f"solid {hull.name}"]
    for corners in triangles_of(hull):
        normal = np.cross(corners[1] - corners[0], corners[2] - corners[0])
        lines.append(f" facet normal {_numbers(normal / np.linalg.norm(normal))}\n  outer loop")
        lines += [f"   vertex {_numbers(corner)}" for corner in corners]
        lines.append("  endloop\n endfacet")
    return "\n".join([*lines, f"endsolid {hull.name}", ""])


def triangles_of(hull: Hull) -> "List[NDArray[np.float64]]":
    """Return the corners (3, 3) of the triangles."""
    points = np.array(hull.points)
    found = ConvexHull(points)
    triangles = []
    for corners, (*outwards, _) in zip(points[found.simplices], found.equations):
        normal = np.cross(corners[1] - corners[0], corners[2] - corners[0])
        triangles.append(corners if normal @ np.array(outwards) > 0.0 else corners[::-1])
    return triangles


def _numbers(values: "NDArray[np.float64]") -> str:
    return " ".join(f"{value:.6f}" for value in values)
