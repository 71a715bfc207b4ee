"""Robots that drive control supports, and agreement of its mass parameters with the URDF."""
# SPDX-License-Identifier: Apache-2.0
import math
import re
from pathlib import Path
from types import SimpleNamespace
from xml.etree import ElementTree

import mtr_drive_control_core as core
import pytest

from mtr_description.shipped import shipped_urdf

PACKAGES = Path(__file__).resolve().parents[3]
HEADERS = PACKAGES / "mtr_drive_control" / "include" / "mtr_drive_control"
URDF = ElementTree.fromstring(shipped_urdf())
LINKS = {link.get("name"): link for link in URDF.findall("link")}
JOINTS = {joint.find("child").get("link"): joint for joint in URDF.findall("joint")}
BASE_HEIGHT_M = 0.0635
KEY_AT_LOWER_STOP_M, KEY_AT_UPPER_STOP_M = 0.35, 1.55


def default(name):
    """Return the default value of a parameter in the C++ header."""
    text = (HEADERS / "parameters.hpp").read_text(encoding="utf-8")
    return float(re.search(rf"double {name} = (-?[\d.]+);", text).group(1))


def numbers(element, attribute):
    return [float(value) for value in (element.get(attribute, "0 0 0") if element is not None else "0 0 0").split()]


def place_of(link):
    """Return the position of a link in base_link, with the lift down; all joints are parallel to base_link, except for
    turns."""
    place = [0.0, 0.0, 0.0]
    while link in JOINTS:
        place = [a + b for a, b in zip(place, numbers(JOINTS[link].find("origin"), "xyz"))]
        link = JOINTS[link].find("parent").get("link")
    return place


def masses():
    """Yield mass, centre of mass and lift flag of each link."""
    for name, link in LINKS.items():
        inertial = link.find("inertial")
        if inertial is not None:
            origin = numbers(inertial.find("origin"), "xyz")
            yield (float(inertial.find("mass").get("value")), [a + b for a, b in zip(place_of(name), origin)],
                   name in ("carriage", "key"))


def centre_of_mass(key_height_m):
    """Return x in base_link and z above ground."""
    raised = key_height_m - KEY_AT_LOWER_STOP_M
    total = sum(mass for mass, _, _ in masses())
    x = sum(mass * place[0] for mass, place, _ in masses()) / total
    z = sum(mass * (place[2] + (raised if lifts else 0.0)) for mass, place, lifts in masses()) / total
    return x, z + BASE_HEIGHT_M


def sent_ahead(range_m):
    """Return the first decision to drive ahead while both LiDARs see objects all around."""
    now_ns, beams = 1_000_000_000, 720
    sweep = SimpleNamespace(
        stamp_ns=now_ns, angle_min_rad=-0.75 * math.pi, angle_increment_rad=1.5 * math.pi / (beams - 1),
        time_increment_s=0.0, range_min_m=0.1, range_max_m=30.0, ranges_m=[range_m] * beams)
    standing = SimpleNamespace(x_m=0.0, y_m=0.0, heading_rad=0.0, linear_mps=0.0, angular_radps=0.0)
    level = SimpleNamespace(angular_velocity=(0.0, 0.0, 0.0), acceleration=(0.0, 0.0, 9.81))
    control = core.DriveControl(shipped_urdf())
    return control.step(now_ns, planner=(0.2, 0.0), front=sweep, rear=sweep, odometry=standing, imu=level)


def test_robot_of_mtr_description_is_served():
    free = sent_ahead(5.0)
    assert (free.source, free.message) == ("planner", "") and free.linear_mps > 0.0
    # From the described LiDAR positions, that is too close to the footprint for a start.
    blocked = sent_ahead(0.3)
    assert blocked.linear_mps == 0.0 and "obstacle" in blocked.message


@pytest.mark.parametrize("wrong, sentence", [
    (('"front_lidar"', '"lidar"'),
     "The robot_description has no link front_lidar; allowed are descriptions in which it hangs on base_link."),
    (('"0 0 3.141592653589793"', '"3.141592653589793 0 3.141592653589793"'),
     "The roll of rear_lidar in robot_description is 3.14159 rad; allowed is -0.0349066 to 0.0349066 rad."),
    (('"0 0 3.141592653589793"', '"0 0 1"'),
     "The turn of rear_lidar from straight back in robot_description is -2.14159 rad; allowed is -0.785398 to 0.785398 "
     "rad."),
    (('size="0.508 0.43 0.06"', 'size="0.508 1.43 0.06"'),
     "The footprint's half width in robot_description is 0.715 m; allowed is 0.1 to 0.6 m."),
], ids=["missing LiDAR", "LiDAR upside down", "rear LiDAR looks aside", "too wide"])
def test_robot_that_cannot_be_served_is_refused(wrong, sentence):
    assert wrong[0] in shipped_urdf()
    with pytest.raises(RuntimeError) as refused:
        core.DriveControl(shipped_urdf().replace(*wrong))
    assert str(refused.value) == sentence


@pytest.mark.parametrize("limits, sentence", [
    ({"centre_of_mass_m": 0.3}, "Parameter centre_of_mass_m is 0.3 m; allowed by the robot_description is 0.261287 to "
                                "0.271287 m."),
    ({"key_raised_m": 1.2}, "Parameter key_raised_m is 1.2 m; allowed by the robot_description is 1.545 to 1.555 m."),
    ({"tip_lever_across_m": 0.25}, "Parameter tip_lever_across_m is 0.25 m; allowed by the robot_description is 0.1815 "
                                   "to 0.1915 m."),
])
def test_parameter_that_contradicts_the_urdf_is_refused(limits, sentence):
    with pytest.raises(RuntimeError) as refused:
        core.DriveControl(shipped_urdf(), limits=limits)
    assert str(refused.value) == sentence


def test_rear_lidar_that_is_not_there_is_not_asked_for():
    urdf = shipped_urdf().replace('"rear_lidar"', '"box"')
    core.DriveControl(urdf, rear_lidar=False)
    with pytest.raises(RuntimeError, match="no link rear_lidar"):
        core.DriveControl(urdf, rear_lidar=True)


@pytest.mark.parametrize("key_height_m", [KEY_AT_LOWER_STOP_M, KEY_AT_UPPER_STOP_M])
def test_centre_of_mass_is_that_of_the_urdf_at_each_height_of_the_key(key_height_m):
    assumed = default("centre_of_mass_m") + default("centre_of_mass_rise") * key_height_m
    assert assumed == pytest.approx(centre_of_mass(key_height_m)[1], abs=0.002)


def test_levers_are_the_distances_of_the_centre_of_mass_from_the_wheels():
    x, _ = centre_of_mass(KEY_AT_LOWER_STOP_M)
    wheel_x, wheel_y, _ = place_of("front_left_wheel_link")
    assert default("tip_lever_along_m") == pytest.approx(wheel_x - abs(x), abs=0.002)
    assert default("tip_lever_across_m") == pytest.approx(wheel_y, abs=0.002)


def test_raised_key_is_the_one_at_the_upper_stop():
    assert default("key_raised_m") == KEY_AT_UPPER_STOP_M
    assert math.isclose(place_of("key")[2] + BASE_HEIGHT_M, KEY_AT_LOWER_STOP_M)
