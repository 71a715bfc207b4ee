"""LiDAR poses of the description compared with those of the base or a driver."""
# SPDX-License-Identifier: Apache-2.0
import math

import pytest

from mtr_commissioning.preflight.expected import Setup
from mtr_commissioning.preflight.mounts import CHECK, MAX_APART_M, MAX_TURN_RAD, OWN_PUBLISHER, mount_findings
from mtr_commissioning.preflight.records import RobotRecord, SaidTransform
from mtr_commissioning.preflight.report import standing_findings
from mtr_core import names
from mtr_description.robot_geometry import RobotGeometry
from mtr_description.shipped import shipped_base, shipped_geometry, shipped_urdf

JACKAL = Setup(rear_lidar=False, frames={names.FRONT_LIDAR: "front_laser"})
BASE_NODE = "/jackal/robot_state_publisher"
FRONT = shipped_geometry().mount(names.FRONT_LIDAR)


def turned(yaw_rad=0.0, pitch_rad=0.0):
    """Return a quaternion about z or y."""
    if pitch_rad:
        return 0.0, math.sin(pitch_rad / 2), 0.0, math.cos(pitch_rad / 2)
    return 0.0, 0.0, math.sin(yaw_rad / 2), math.cos(yaw_rad / 2)


def at(x, y, z, quaternion=(0.0, 0.0, 0.0, 1.0)):
    return SaidTransform((x, y, z), quaternion)


def jackal(forward_m=0.0, up_m=0.0, quaternion=(0.0, 0.0, 0.0, 1.0), node=BASE_NODE):
    """Return the transforms of a stock Jackal, whose LiDAR deviates from the description's by this offset."""
    x, y, z = FRONT.position
    return {(names.BASE, "chassis_link", node): at(0.0, 0.0, 0.0),
            ("chassis_link", "front_laser_mount", node): at(x, y, z - 0.05),
            ("front_laser_mount", "front_laser", node): at(forward_m, 0.0, 0.05 + up_m, quaternion)}


def findings(said, setup=JACKAL, geometry=None):
    return mount_findings(RobotRecord(said=said), setup, geometry or shipped_geometry())


def test_jackal_that_says_the_same_is_good_and_named():
    found, = findings(jackal(0.01))
    assert not found.is_bad and (found.check, found.subject) == (CHECK, "front_laser")
    assert found.text == (f"It is where robot_description has front_lidar, within 2 cm and 1 deg (from {BASE_NODE}).")
    assert found.value == pytest.approx(0.01)


@pytest.mark.parametrize(("said", "apart"), [
    (jackal(0.05), "5.0 cm and 0.0 deg apart"), (jackal(-0.021), "2.1 cm and 0.0 deg apart"),
    (jackal(up_m=0.03), "3.0 cm and 0.0 deg apart"), (jackal(quaternion=turned(math.radians(1.5))), "1.5 deg apart"),
    (jackal(quaternion=turned(pitch_rad=math.radians(-3.0))), "3.0 deg apart"),
    (jackal(quaternion=turned(math.pi)), "0.0 cm and 180.0 deg apart")])
def test_lidar_that_the_base_has_elsewhere_is_bad_with_both_places_and_the_difference(said, apart):
    found, = findings(said)
    assert found.is_bad and found.subject == "front_laser" and apart in found.text
    for part in (f"{BASE_NODE} has front_laser at (", "robot_description has front_lidar at (0.120, 0.000, 0.236) m",
                 "allowed are 2 cm and 1 deg", "measure where this LiDAR is, and correct the file that robot_file:="):
        assert part in found.text, found.text


@pytest.mark.parametrize(("said", "value", "limit", "unit"), [
    (jackal(0.05, quaternion=turned(0.1)), 0.05, MAX_APART_M, "m"),
    (jackal(0.01, quaternion=turned(0.1)), 0.1, MAX_TURN_RAD, "rad")])
def test_value_is_that_which_is_too_large(said, value, limit, unit):
    found, = findings(said)
    assert (found.value, found.limit, found.unit) == (pytest.approx(value), limit, unit)


def test_nothing_is_compared_where_nobody_else_says_where_the_lidar_is():
    x, y, z = FRONT.position
    assert findings({}) == []
    assert findings({("other", "front_laser", BASE_NODE): at(1.0, 0.0, 0.0)}) == []
    assert findings({(names.BASE, names.FRONT_LIDAR, OWN_PUBLISHER): at(x, y, z)}, Setup(rear_lidar=False)) == []


def test_own_publisher_that_was_started_with_another_description_is_bad():
    found, = findings({(names.BASE, names.FRONT_LIDAR, OWN_PUBLISHER): at(0.2, 0.0, 0.2)}, Setup(rear_lidar=False))
    assert found.is_bad and found.text.startswith(f"{OWN_PUBLISHER} has front_lidar at (0.200, 0.000, 0.200) m")


def test_driver_that_hangs_its_frame_on_the_descriptions_is_compared_through_it():
    x, y, z = FRONT.position
    own = {(names.BASE, names.FRONT_LIDAR, OWN_PUBLISHER): at(x, y, z)}
    good, = findings({**own, (names.FRONT_LIDAR, "front_laser", "/driver"): at(0.0, 0.0, 0.0)})
    bad, = findings({**own, (names.FRONT_LIDAR, "front_laser", "/driver"): at(0.0, 0.0, 0.0, turned(0.5))})
    assert not good.is_bad and "(from /driver)" in good.text
    assert bad.is_bad and bad.text.startswith("/driver, /robot_state_publisher has front_laser at (")


def test_worst_of_several_nodes_counts_and_circles_end():
    circle = {("front_laser", "front_laser_mount", "/odd"): at(0.0, 0.0, 0.0)}
    found, = findings({**jackal(), **jackal(0.2, node="/other"), **circle})
    assert found.is_bad and "20.0 cm" in found.text and "/other" in found.text


def test_turned_parent_turns_what_hangs_on_it():
    x, y, z = FRONT.position
    said = {(names.BASE, "mast", BASE_NODE): at(0.0, 0.0, 0.0, turned(math.pi / 2)),
            ("mast", "front_laser", BASE_NODE): at(y, -x, z, turned(-math.pi / 2))}
    found, = findings(said)
    assert not found.is_bad and found.value == pytest.approx(0.0, abs=1e-9)


@pytest.mark.parametrize("broken", [at(math.nan, 0.0, 0.0), at(0.0, 0.0, 0.0, (0.0, 0.0, 0.0, 0.0)),
                                    at(0.0, 0.0, 0.0, (0.0, 0.0, 0.0, math.nan))])
def test_numbers_that_are_no_transform_are_not_compared(broken):
    assert findings({(names.BASE, "front_laser", BASE_NODE): broken}) == []


def test_both_lidars_are_compared_and_the_rear_one_only_where_there_is_one():
    said = {(names.BASE, frame, "/driver"): at(1.0, 0.0, 0.0) for frame in (names.FRONT_LIDAR, names.REAR_LIDAR)}
    assert [found.subject for found in findings(said, Setup())] == [names.FRONT_LIDAR, names.REAR_LIDAR]
    assert [found.subject for found in findings(said, Setup(rear_lidar=False))] == [names.FRONT_LIDAR]


def test_description_without_the_lidar_is_told_elsewhere():
    geometry = RobotGeometry(shipped_urdf().replace("front_lidar", "elsewhere"))
    assert findings(jackal(0.5), geometry=geometry) == []


def test_standing_checks_of_a_preflight_tell_it():
    found = standing_findings(RobotRecord(said=jackal(0.05)), JACKAL, shipped_geometry(), shipped_base())
    assert [each.subject for each in found if each.check == CHECK and each.is_bad] == ["front_laser"]
