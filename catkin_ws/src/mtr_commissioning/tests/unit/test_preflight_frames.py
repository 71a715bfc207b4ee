"""Frames against the robot's description, and transforms that two nodes publish."""
# SPDX-License-Identifier: Apache-2.0
from collections import Counter

import pytest

from mtr_commissioning.preflight.expected import Setup
from mtr_commissioning.preflight.frames import frame_findings, lidar_mounts
from mtr_commissioning.preflight.records import RobotRecord, TopicRecord
from mtr_commissioning.preflight.transforms import transform_findings
from mtr_core import names
from mtr_description.robot_geometry import RobotGeometry
from mtr_description.shipped import shipped_geometry, shipped_urdf

SETUP = Setup()
RIGHT = {names.FRONT_SCAN: names.FRONT_LIDAR, names.REAR_SCAN: names.REAR_LIDAR, names.IMU_DATA: names.IMU}


def texts(frames, setup=SETUP, geometry=None):
    """Return sentences of the bad findings for topic -> frame or frames."""
    record = RobotRecord({topic: TopicRecord(frames=Counter([frame] if isinstance(frame, str) else frame))
                          for topic, frame in frames.items()})
    return [finding.text for finding in frame_findings(record, setup, geometry or shipped_geometry())
            if finding.is_bad]


def test_right_frames_are_good():
    assert texts(RIGHT) == []


def test_lidar_on_the_others_topic_is_named():
    found = texts({**RIGHT, names.FRONT_SCAN: names.REAR_LIDAR})
    assert len(found) == 1 and "the LiDAR of /rear/scan is on this topic" in found[0]


def test_frame_that_the_description_lacks_is_said_so():
    found = texts({**RIGHT, names.FRONT_SCAN: "front_laser"})
    assert found == ["It comes in the frame front_laser, allowed is front_lidar, and robot_description has no such "
                     "link: set frame_id in its driver, or tell robot.launch its name (front_frame, rear_frame, "
                     "imu_frame)."]


def test_imu_in_the_frame_of_the_base_is_told():
    assert texts({**RIGHT, names.IMU_DATA: names.BASE}) == [
        "It comes in the frame base_link, allowed is imu: set frame_id in its driver, or tell robot.launch its name "
        "(front_frame, rear_frame, imu_frame)."]


JACKAL = Setup(frames={names.FRONT_LIDAR: "front_laser", names.REAR_LIDAR: "rear_laser", names.IMU: "imu_link"})


def test_frames_of_a_stock_jackal_are_right_where_the_robot_was_started_with_them():
    stock = {names.FRONT_SCAN: "front_laser", names.REAR_SCAN: "rear_laser", names.IMU_DATA: "imu_link"}
    assert texts(stock, JACKAL) == []
    swapped = texts({**stock, names.FRONT_SCAN: "rear_laser"}, JACKAL)
    assert len(swapped) == 1 and "allowed is front_laser: the LiDAR of /rear/scan is on this topic" in swapped[0]
    assert "allowed is front_laser" in texts({**stock, names.FRONT_SCAN: names.FRONT_LIDAR}, JACKAL)[0]


def test_two_frames_on_one_topic_are_told():
    assert "in 2 frames (front_lidar, rear_lidar)" in texts(
        {**RIGHT, names.FRONT_SCAN: [names.FRONT_LIDAR, names.REAR_LIDAR]})[0]


def test_rear_frame_is_not_judged_on_a_robot_without_rear_lidar():
    assert texts({**RIGHT, names.REAR_SCAN: "x"}, Setup(rear_lidar=False)) == []


def test_description_with_a_lidar_upside_down_is_told_and_has_no_mounts():
    mount = 'rpy="0 0 0" xyz="0.12 0 0.2365"'
    assert mount in shipped_urdf()
    geometry = RobotGeometry(shipped_urdf().replace(mount, 'rpy="3.14 0 0" xyz="0.12 0 0.2365"'))
    found = texts(RIGHT, geometry=geometry)
    assert len(found) == 1 and found[0].startswith("The roll of front_lidar in robot_description is 3.14 rad")
    assert lidar_mounts(geometry, Setup()) is None
    assert lidar_mounts(shipped_geometry(), Setup()) is not None


def test_transforms_from_one_node_each_are_good():
    node = {"/localization"}
    assert not transform_findings({("odom", "base_link"): node, ("map", "odom"): node})[0].is_bad


@pytest.mark.parametrize("pair, remedy", [(("odom", "base_link"), "publish_odom_tf"), (("map", "odom"), "external"),
                                          (("base_link", "imu"), "elsewhere")])
def test_transform_from_two_nodes_names_both_and_the_remedy(pair, remedy):
    found = transform_findings({pair: {"/localization", "/other"}})
    assert found[0].is_bad and "(/localization, /other)" in found[0].text and remedy in found[0].text


def test_frame_with_two_parents_is_bad():
    found = transform_findings({("odom", "base_link"): {"/base"}, ("map", "base_link"): {"/slam"}})
    assert [finding.subject for finding in found if finding.is_bad] == ["base_link"]
    assert "(map, odom; from /base, /slam)" in found[0].text
