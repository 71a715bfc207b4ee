"""World file: each solid of site and robot occurs once, with pose and size as in the other simulator."""
# SPDX-License-Identifier: Apache-2.0
import dataclasses
import math
import pathlib
from xml.etree import ElementTree

import mujoco
import numpy as np
import pytest
from mtr_gazebo.world.elements import text_of
from mtr_gazebo.world.hulls import triangles_of
from mtr_gazebo.world.rigid_links import rigid_links
from mtr_gazebo.world.world_file import WorldOptions, world_files, write_world

from mtr_core.errors import ConfigurationError
from mtr_core.se2 import Pose2
from mtr_description.robot_geometry import RobotGeometry
from mtr_description.shipped import shipped_geometry, shipped_urdf
from mtr_simulation.physics.mjcf import model_xml
from mtr_simulation.physics.robot import shipped_robot
from mtr_simulation.site.bodies import bodies_of
from mtr_simulation.site.cables import Cable
from mtr_simulation.site.scenario import SCENARIOS
from mtr_simulation.site.shapes import Hull

FOLDER = pathlib.Path("/worlds/one")
WITHOUT_PERSON = sorted(name for name, scenario in SCENARIOS.items() if scenario.person is None)


def world_of(name, options=None):
    files = world_files(FOLDER, SCENARIOS[name], shipped_geometry(), options or WorldOptions())
    return ElementTree.fromstring(files["site.world"]).find("world"), files


def numbers(element, path):
    return [float(word) for word in element.find(path).text.split()]


def mujoco_model(name):
    scenario = SCENARIOS[name]
    model = mujoco.MjModel.from_xml_string(model_xml(scenario, shipped_robot(), scenario.start_in_world(1), 0.005, 6.0))
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    return model, data


def turned(x, y, heading):
    return np.array([[math.cos(heading), -math.sin(heading)], [math.sin(heading), math.cos(heading)]]) @ [x, y]


def solids_of_gazebo(world):
    """Return (kind, sizes, x, y, z in world) of every box and cylinder of the site."""
    found = []
    for model in world.findall("model"):
        if model.get("name") in ("robot", "ground"):
            continue
        x, y, _, _, _, heading = numbers(model, "pose")
        for collision in model.find("link").findall("collision"):
            px, py, pz, *_ = numbers(collision, "pose")
            place = (*(turned(px, py, heading) + [x, y]), pz)
            geometry = collision.find("geometry")
            if geometry.find("box") is not None:
                found.append(("box", *[0.5 * side for side in numbers(geometry, "box/size")], *place))
            elif geometry.find("cylinder") is not None:
                found.append(("cylinder", float(geometry.find("cylinder/radius").text),
                              0.5 * float(geometry.find("cylinder/length").text), 0.0, *place))
    return sorted(found)


def solids_of_mujoco(name):
    """Return the same solids of MuJoCo's model."""
    model, data = mujoco_model(name)
    kinds = {int(mujoco.mjtGeom.mjGEOM_BOX): "box", int(mujoco.mjtGeom.mjGEOM_CYLINDER): "cylinder"}
    return sorted((kinds[int(kind)], *model.geom_size[index], *data.geom_xpos[index])
                  for index, kind in enumerate(model.geom_type) if kind in kinds and model.geom_group[index] != 2)


@pytest.mark.parametrize("name", WITHOUT_PERSON)
def test_every_solid_of_the_site_stands_once_where_mujoco_has_it(name):
    world, _ = world_of(name)
    ours, theirs = solids_of_gazebo(world), solids_of_mujoco(name)
    assert [each[0] for each in ours] == [each[0] for each in theirs]
    assert np.allclose([each[1:] for each in ours], [each[1:] for each in theirs], atol=2e-4)


@pytest.mark.parametrize("name", WITHOUT_PERSON)
def test_each_hull_is_one_mesh_with_its_file(name):
    world, files = world_of(name)
    uris = [element.text for element in world.iterfind("model/link/collision/geometry/mesh/uri")]
    hulls = [part.form for body in bodies_of(SCENARIOS[name]) for part in body.parts if isinstance(part.form, Hull)]
    assert sorted(uris) == sorted(f"file:///worlds/one/meshes/{hull.name}.stl" for hull in hulls)
    assert {uri.replace("file:///worlds/one/", "") for uri in uris} == set(files) - {"site.world"}


def test_names_of_models_are_their_own_and_everything_but_the_robot_is_static():
    world, _ = world_of("lot")
    models = world.findall("model")
    assert len({model.get("name") for model in models}) == len(models)
    assert [model.get("name") for model in models if model.findtext("static") != "true"] == ["robot"]


def test_triangles_enclose_the_hull_and_look_outwards():
    hull = next(part.form for body in bodies_of(SCENARIOS["cones"]) for part in body.parts
                if isinstance(part.form, Hull) and part.form.name == "cone_0")
    triangles = triangles_of(hull)
    # Divergence theorem; the volume of an inverted hull is negative.
    volume = sum(np.dot(a, np.cross(b, c)) for a, b, c in triangles) / 6.0
    foot, top, height, corners = 0.18, 0.03, 0.75, 16
    share = corners / 2.0 * math.sin(2.0 * math.pi / corners)
    assert volume == pytest.approx(share * height / 3.0 * (foot**2 + foot * top + top**2), rel=1e-6)


def test_robot_starts_where_mujoco_has_it_and_stands_on_its_wheels():
    world, _ = world_of("lot", WorldOptions(seed=1))
    model, data = mujoco_model("lot")
    robot = world.find("model[@name='robot']")
    x, y, z, roll, pitch, heading = numbers(robot, "pose")
    assert np.allclose((x, y, z), data.xpos[model.body("base_link").id], atol=1e-6) and roll == pitch == 0.0
    base = data.xmat[model.body("base_link").id].reshape(3, 3)
    assert heading == pytest.approx(math.atan2(base[1, 0], base[0, 0]), abs=1e-6)
    other, _ = world_of("lot", WorldOptions(seed=2))
    assert numbers(other.find("model[@name='robot']"), "pose") != numbers(robot, "pose")


def test_robot_has_its_moving_links_with_the_masses_of_the_urdf():
    robot = world_of("open")[0].find("model[@name='robot']")
    masses = {link.get("name"): float(link.findtext("inertial/mass")) for link in robot.findall("link")}
    assert set(masses) == {"base_link", "front_left_wheel_link", "front_right_wheel_link", "rear_left_wheel_link",
                           "rear_right_wheel_link", "carriage"}
    listed = sum(link.inertial.mass for link in shipped_geometry().tree.links if link.inertial)
    assert sum(masses.values()) == pytest.approx(listed)
    joints = {joint.get("name"): (joint.get("type"), joint.findtext("parent"), joint.findtext("child"))
              for joint in robot.findall("joint")}
    assert joints["lift"] == ("prismatic", "base_link", "carriage")
    assert joints["rear_left_wheel"] == ("revolute", "base_link", "rear_left_wheel_link")


def test_fixed_links_weigh_and_resist_turning_as_mujoco_says():
    model, data = mujoco_model("open")
    total = model.body_subtreemass[model.body("base_link").id]
    links = rigid_links(shipped_geometry().tree)
    assert sum(link.inertia.mass_kg for link in links) == pytest.approx(total)
    centre = sum(link.inertia.mass_kg * (link.place.position + link.inertia.centre) for link in links) / total
    base = model.body("base_link").id
    expected = data.xmat[base].reshape(3, 3).T @ (data.subtree_com[base] - data.xpos[base])
    # A box with the mass of the arm has its centre as in the URDF; MuJoCo computes it from the arm's box.
    assert np.allclose(centre, expected, atol=2e-3)
    for link in links:
        moments = np.linalg.eigvalsh(link.inertia.tensor)
        assert moments[0] > 0.0 and moments[2] <= moments[0] + moments[1] + 1e-9


def test_a_dumbbell_of_fixed_links_has_the_inertia_of_two_point_masses():
    mass = ('<inertial><mass value="2"/><inertia ixx="1e-9" iyy="1e-9" izz="1e-9" ixy="0" ixz="0" iyz="0"/>'
            '</inertial>')
    arms = "".join(f'<link name="{name}">{mass}</link><joint name="to_{name}" type="fixed"><parent link="base_link"/>'
                   f'<child link="{name}"/><origin xyz="{x} 0 0" rpy="0 0 {x}"/></joint>'
                   for name, x in (("a", 1), ("b", -1)))
    text = f'<robot name="dumbbell"><link name="base_link"/>{arms}</robot>'
    (link,) = rigid_links(RobotGeometry(text).tree)
    assert link.inertia.mass_kg == 4.0 and np.allclose(link.inertia.centre, 0.0)
    assert np.allclose(link.inertia.tensor, np.diag([0.0, 4.0, 4.0]), atol=1e-6)


def test_sensors_are_where_the_urdf_has_them():
    moved = shipped_urdf().replace('xyz="-0.2 0 0.2365"', 'xyz="-0.17 0.02 0.2365"')
    assert moved != shipped_urdf()
    files = world_files(FOLDER, SCENARIOS["open"], RobotGeometry(moved), WorldOptions())
    plugin = ElementTree.fromstring(files["site.world"]).find("world/model/plugin")
    poses = {lidar.findtext("frame"): numbers(lidar, "pose") for lidar in plugin.findall("lidar")}
    assert np.allclose(poses["front_lidar"], [0.12, 0.0, 0.2365, 0.0, 0.0, 0.0])
    assert np.allclose(poses["rear_lidar"], [-0.17, 0.02, 0.2365, 0.0, 0.0, math.pi])
    assert numbers(plugin, "lift/key") == pytest.approx([0.31, 0.0, 0.0])
    assert sorted(each.text for each in plugin.findall("base/left_joint")) == ["front_left_wheel", "rear_left_wheel"]


def test_without_a_rear_lidar_there_is_none():
    plugin = world_of("open", WorldOptions(has_rear_lidar=False))[0].find("model/plugin")
    assert [lidar.findtext("frame") for lidar in plugin.findall("lidar")] == ["front_lidar"]


def test_sensors_are_out_of_phase_with_each_other_and_with_the_nodes():
    plugin = world_of("open")[0].find("model/plugin")
    sensors = [*plugin.findall("lidar"), plugin.find("imu"), plugin.find("base")]
    phases = [float(each.findtext("phase_ms")) % 20.0 for each in sensors]
    assert len(set(phases)) == len(phases) and 0.0 not in phases
    periods = [float(each.findtext("period_ms")) for each in plugin.findall("lidar")]
    assert periods[0] != periods[1]


def test_tyres_have_the_friction_of_the_scenario():
    scenario = dataclasses.replace(SCENARIOS["open"], friction=0.7)
    files = world_files(FOLDER, scenario, shipped_geometry(), WorldOptions())
    robot = ElementTree.fromstring(files["site.world"]).find("world/model[@name='robot']")
    assert [each.text for each in robot.iterfind("link/collision/surface/friction/ode/mu")] == ["0.7"] * 4


@pytest.mark.parametrize(("change", "expected"), [
    ({"person": SCENARIOS["lot_person"].person}, "has a person"),
    ({"ground_tilt_rad": 0.02}, "ground_tilt_rad is 0.02 rad; allowed in Gazebo is 0 rad"),
    ({"ground_slope_rad": 0.03}, "ground_slope_rad is 0.03 rad; allowed in Gazebo is 0 rad"),
    ({"cables": (Cable(Pose2(0.0, 0.0, 0.0)),)}, "has cables"),
])
def test_what_gazebo_s_world_has_not_is_refused(change, expected):
    with pytest.raises(ConfigurationError, match=expected):
        world_files(FOLDER, dataclasses.replace(SCENARIOS["open"], **change), shipped_geometry(), WorldOptions())


def test_files_are_written_below_a_folder_that_is_made(tmp_path):
    path = write_world(tmp_path / "a" / "b", SCENARIOS["open"], shipped_geometry(), WorldOptions())
    assert path == tmp_path / "a" / "b" / "site.world" and ElementTree.parse(path).getroot().tag == "sdf"
    assert (tmp_path / "a" / "b" / "meshes" / "car_front.stl").read_text().count("facet normal") > 20


def test_numbers_keep_all_digits():
    assert text_of(math.pi) == repr(math.pi) and text_of((1.0, -0.5)) == "1 -0.5" and text_of(True) == "true"
