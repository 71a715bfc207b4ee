"""Values from the robot's URDF, and sentences about invalid URDFs."""
# SPDX-License-Identifier: Apache-2.0
import csv
import math
import pathlib

import pytest

from mtr_core.errors import ConfigurationError
from mtr_core.se2 import Pose2
from mtr_description.outline import convex_hull
from mtr_description.robot_geometry import RobotGeometry
from mtr_description.shipped import shipped_geometry, shipped_urdf

WRONG_ROBOTS = pathlib.Path(__file__).parent / "wrong_robots.tsv"


def cases():
    lines = [line for line in WRONG_ROBOTS.read_text(encoding="utf-8").splitlines() if not line.startswith("#")]
    return list(csv.reader(lines, delimiter="\t", quoting=csv.QUOTE_NONE))


def ask(urdf, question):
    geometry = RobotGeometry(urdf)
    word, _, frame = question.partition(" ")
    if word == "level":
        return geometry.mount(frame).level()
    return getattr(geometry, word)(*filter(None, [frame]))


def test_lidars_look_forward_and_back():
    assert shipped_geometry().mount("front_lidar").level() == Pose2(0.12, 0.0, 0.0)
    assert shipped_geometry().mount("rear_lidar").level() == Pose2(-0.2, 0.0, math.pi)
    assert shipped_geometry().mount("rear_lidar").position == (-0.2, 0.0, 0.2365)


def test_footprint_reaches_to_the_key_and_the_fenders():
    footprint = shipped_geometry().footprint()
    assert (footprint.front_m, footprint.rear_m, footprint.half_width_m) == (0.27, 0.254, 0.215)


def test_hull_starts_at_the_rearmost_corner_and_runs_counterclockwise_past_points_on_its_sides():
    points = [(0.25, 0.0), (0.5, 0.5), (0.0, 0.5), (0.5, 0.0), (0.0, 0.0), (0.0, 0.25), (0.25, 0.25), (0.5, 0.0)]
    assert convex_hull(points) == ((0.0, 0.0), (0.5, 0.0), (0.5, 0.5), (0.0, 0.5))


def test_shape_without_an_area_is_refused():
    with pytest.raises(ConfigurationError, match="has no area from above; allowed are boxes"):
        convex_hull([(0.0, 0.1), (0.2, 0.1), (0.1, 0.1)])


def test_a_turn_on_the_spot_sweeps_as_far_as_the_fenders_corners():
    footprint = shipped_geometry().footprint()
    assert footprint.radius_m() == math.hypot(0.254, 0.215)
    assert footprint.radius_m(-0.006) == pytest.approx(math.hypot(0.26, 0.215))


def test_key_has_lever_height_and_travel():
    key = shipped_geometry().key()
    assert (key.x_m, key.y_m, key.min_height_m, key.max_height_m) == (0.25, 0.0, 0.35, 1.55)


def test_wheels_stand_on_the_ground():
    wheels = shipped_geometry().wheels()
    assert (wheels.base_m, wheels.track_m, wheels.radius_m) == (0.262, 0.37559, 0.098)
    assert shipped_geometry().base_height_m() == 0.0635


def test_turned_mount_on_a_turned_mount_is_composed():
    tip = ('<link name="hub"/><joint name="hub_mount" type="fixed"><parent link="base_link"/><child link="hub"/>'
           '<origin xyz="-0.18 0.126 0" rpy="0 0 1.5707963267948966"/></joint>'
           '<link name="tip"/><joint name="tip_mount" type="fixed"><parent link="hub"/><child link="tip"/>'
           '<origin xyz="0.1 0 0" rpy="0.3 0 0"/></joint></robot>')
    mount = RobotGeometry(shipped_urdf().replace("</robot>", tip)).mount("tip")
    assert mount.position == (-0.18, 0.226, 0.0)
    assert (mount.roll_rad, mount.pitch_rad, mount.yaw_rad) == pytest.approx((0.3, 0.0, math.pi / 2.0))


@pytest.mark.parametrize("old, by, question, sentence", [pytest.param(*case[1:], id=case[0]) for case in cases()])
def test_what_cannot_be_served_is_refused_with_one_sentence(old, by, question, sentence):
    urdf = shipped_urdf()
    assert old in urdf
    with pytest.raises(ConfigurationError) as refused:
        ask(urdf.replace(old, by) if old else urdf, question)
    assert str(refused.value) == sentence


def test_text_that_is_no_urdf_is_refused():
    with pytest.raises(ConfigurationError, match=r"^Parameter robot_description cannot be read; allowed is a URDF \("):
        RobotGeometry("robot")
