"""Objects of a site as static SDF models."""
# SPDX-License-Identifier: Apache-2.0
import math
import pathlib
from typing import Iterator, List, Sequence
from xml.etree.ElementTree import Element

from mtr_simulation.site.bodies import SURROUNDINGS
from mtr_simulation.site.shapes import Body, Box, Cylinder, Hull, Part, Surface

from .elements import add

COLOURS = {Surface.PAINT: "0.25 0.3 0.6 1", Surface.UPPER: "0.25 0.3 0.6 1", Surface.RUBBER: "0.1 0.1 0.1 1"}
# The contact has the smaller friction coefficient of both, which is the tyre's.
GROUND_FRICTION = 100.0


def add_ground(world: Element) -> None:
    """Add level ground."""
    model = add(world, "model", name="ground")
    add(model, "static", True)
    link = add(model, "link", name="ground")
    collision = add(link, "collision", name="ground")
    friction = add(add(add(collision, "surface"), "friction"), "ode")
    add(friction, "mu", GROUND_FRICTION)
    add(friction, "mu2", GROUND_FRICTION)
    for holder in (collision, add(link, "visual", name="ground")):
        plane = add(add(holder, "geometry"), "plane")
        add(plane, "normal", (0.0, 0.0, 1.0))
        add(plane, "size", (120.0, 120.0))


def add_body(world: Element, body: Body, meshes: pathlib.Path) -> None:
    """Add a body as a model; separate parts of the surroundings become a model each.

    Beams are tested against the bounding box of a model before its solids.
    """
    for single in _models(body):
        model = add(world, "model", name=single.name)
        add(model, "static", True)
        add(model, "pose", (single.pose.x, single.pose.y, 0.0, 0.0, 0.0, single.pose.heading))
        link = add(model, "link", name="link")
        for index, part in enumerate(single.parts):
            _add_part(link, f"part_{index}", part, meshes)


def hulls_of(bodies: Sequence[Body]) -> List[Hull]:
    """Return all convex hulls of a site."""
    return [part.form for body in bodies for part in body.parts if isinstance(part.form, Hull)]


def mesh_file(meshes: pathlib.Path, hull: Hull) -> pathlib.Path:
    """Return the path of the hull's triangle file."""
    return meshes / f"{hull.name}.stl"


def _models(body: Body) -> Iterator[Body]:
    if body.name != SURROUNDINGS:
        yield body
        return
    for index, part in enumerate(body.parts):
        yield Body(f"{body.name}_{index}", body.pose, (part,))


def _add_part(link: Element, name: str, part: Part, meshes: pathlib.Path) -> None:
    pose = (*part.centre, math.pi / 2.0 if part.is_lying else 0.0, 0.0, part.yaw_rad)
    collision, visual = add(link, "collision", name=name), add(link, "visual", name=name)
    for holder in (collision, visual):
        add(holder, "pose", pose)
        _add_form(add(holder, "geometry"), part, meshes)
    material = add(visual, "material")
    for kind in ("ambient", "diffuse"):
        add(material, kind, COLOURS[part.surface])


def _add_form(geometry: Element, part: Part, meshes: pathlib.Path) -> None:
    form = part.form
    if isinstance(form, Box):
        add(add(geometry, "box"), "size", [2.0 * half for half in form.half])
    elif isinstance(form, Cylinder):
        cylinder = add(geometry, "cylinder")
        add(cylinder, "radius", form.radius_m)
        add(cylinder, "length", 2.0 * form.half_length_m)
    else:
        add(add(geometry, "mesh"), "uri", mesh_file(meshes, form).as_uri())
