"""MuJoCo model of the bodies on the site."""
# SPDX-License-Identifier: Apache-2.0
from typing import List, Sequence

from ..site.bodies import SURROUNDINGS
from ..site.shapes import Body, Box, Cylinder, Hull, Part, Surface

SOLID = 'contype="1" conaffinity="1" group="1" rgba=".25 .3 .6 1"'
# Group 3 is far above the LiDAR plane, so it is not tested for each beam.
SURFACES = {Surface.PAINT: SOLID, Surface.UPPER: SOLID.replace('group="1"', 'group="3"'),
            Surface.RUBBER: 'contype="1" conaffinity="1" group="1" rgba=".1 .1 .1 1"'}


def site_meshes(bodies: Sequence[Body]) -> str:
    """Return the assets of all convex hulls."""
    hulls = [part.form for body in bodies for part in body.parts if isinstance(part.form, Hull)]
    return "".join(f'<mesh name="{hull.name}" vertex="{_points(hull)}"/>' for hull in hulls)


def site_bodies(bodies: Sequence[Body]) -> str:
    """Return the bodies; the parts of the surroundings belong to the world body."""
    return "\n    ".join(_geoms(body) if body.name == SURROUNDINGS else _body(body) for body in bodies)


def _body(body: Body) -> str:
    pose = body.pose
    return (f'<body name="{body.name}" pos="{pose.x:.6f} {pose.y:.6f} 0" euler="0 0 {pose.heading:.9f}">'
            f'{_geoms(body)}</body>')


def _geoms(body: Body) -> str:
    return "".join(map(_geom, body.parts))


def _geom(part: Part) -> str:
    # A mesh geom is placed at the mesh's own frame: MuJoCo re-centres the vertices and keeps the geom's place.
    roll = "1.5707963268" if part.is_lying else "0"
    place = f'pos="{_numbers(part.centre)}" euler="{roll} 0 {part.yaw_rad:.6f}"'
    return f"<geom {_form(part)} {place} {SURFACES[part.surface]}/>"


def _form(part: Part) -> str:
    form = part.form
    if isinstance(form, Box):
        return f'type="box" size="{_numbers(form.half)}"'
    if isinstance(form, Cylinder):
        return f'type="cylinder" size="{_numbers(form)}"'
    return f'type="mesh" mesh="{form.name}"'


def _points(hull: Hull) -> str:
    return " ".join(_numbers(point) for point in hull.points)


def _numbers(values: Sequence[float]) -> str:
    texts: List[str] = [f"{value:.4f}" for value in values]
    return " ".join(texts)
