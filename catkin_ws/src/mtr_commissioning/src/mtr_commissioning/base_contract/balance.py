"""Parameters of drive control that follow from the masses and positions in a URDF.

Drive control does not read them from the URDF, so that a weighed robot may have different values; it rejects values
that differ by more than AGREEMENT_M. The same sums in C++: mtr_description/robot_geometry.hpp.
"""
# SPDX-License-Identifier: Apache-2.0
from typing import Dict, Iterator, Tuple

from mtr_core.arrays import FloatArray
from mtr_core.errors import ConfigurationError
from mtr_description.robot_geometry import RobotGeometry
from mtr_description.urdf_tree import Place, UrdfTree, place_of

AGREEMENT_M = 0.005


def balance_parameters(geometry: RobotGeometry) -> Dict[str, float]:
    """Return names and values for drive control; ConfigurationError if the URDF has no masses, wheels or key."""
    tree, key, wheels = geometry.tree, geometry.key(), geometry.wheels()
    masses = list(_masses(tree))
    total_kg = sum(mass_kg for _, mass_kg, _ in masses)
    if total_kg <= 0.0:
        raise ConfigurationError("The robot_description has no masses; drive control needs them to know what tips.")
    x_m, y_m, z_m = (sum(mass_kg * float(place[axis]) for _, mass_kg, place in masses) / total_kg for axis in range(3))
    rise = sum(mass_kg for link, mass_kg, _ in masses if _is_lifted(tree, link)) / total_kg
    values = {"centre_of_mass_m": z_m + geometry.base_height_m() - rise * key.min_height_m, "centre_of_mass_rise": rise,
              "tip_lever_along_m": 0.5 * wheels.base_m - abs(x_m),
              "tip_lever_across_m": 0.5 * wheels.track_m - abs(y_m), "key_raised_m": key.max_height_m}
    return {name: round(float(value), 4) for name, value in values.items()}


def _masses(tree: UrdfTree) -> Iterator[Tuple[str, float, FloatArray]]:
    for link in tree.links:
        if link.inertial is not None:
            centre: Place = tree.place(link.name) @ place_of(link.inertial.origin)
            yield link.name, float(link.inertial.mass), centre.position


def _is_lifted(tree: UrdfTree, link: str) -> bool:
    return any(joint.type == "prismatic" for joint in tree.chain(link))
