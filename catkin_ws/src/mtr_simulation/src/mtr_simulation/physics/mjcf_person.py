"""MJCF of figures that walk, roll or lie on a site; their motion is set from outside."""
# SPDX-License-Identifier: Apache-2.0
from ..site.figures import Figure, Leg, figure_named
from .mjcf_site import SOLID


def person_bodies(name: str) -> str:
    """Return torso or vehicle, and the legs; a planar LiDAR sees the parts in its plane."""
    figure = figure_named(name)
    legs = "".join(_leg(figure, leg) for leg in figure.legs)
    return f'<body name="person" mocap="true">{"".join(map(_geom, figure.geoms))}</body>{legs}'


def _geom(geom: str) -> str:
    return f"<geom {geom} {SOLID}/>"


def _leg(figure: Figure, leg: Leg) -> str:
    bone = _geom(f'type="capsule" fromto="0 0 0 0 0 -{figure.leg_length_m}" size="{figure.leg_radius_m}"')
    return f'<body name="{leg.name}" mocap="true" pos="0 {leg.side_m} {figure.hip_height_m}">{bone}</body>'
