"""View of the robot for the Operator's picture, reduced in size."""
# SPDX-License-Identifier: Apache-2.0
import math

import numpy as np
import pytest
import rospy
from geometry_msgs.msg import PoseStamped
from nav_msgs.msg import Path
from sensor_msgs.msg import Imu, LaserScan

from mtr_core import names
from mtr_core.se2 import Pose2
from mtr_core.states import CarState
from mtr_description.mounts import LidarMounts
from mtr_dispatcher.sensors import Eyes
from mtr_dispatcher.status.inputs import Inputs
from mtr_dispatcher.status.surroundings import (
    MAX_PATH_POINTS,
    MAX_POINTS,
    Motion,
    Obstacle,
    Surroundings,
    Sweep,
    fill,
    path_of,
    points_of,
)
from mtr_msgs.msg import CarEstimate, DriveStatus, LocalizedPose
from mtr_proto import robot_link_pb2 as link

AT_REST = Motion(10.0, 0.0, 0.0)
BACKWARDS = Pose2(-0.2, 0.0, math.pi)
NO_PATH = np.empty((0, 2))


def sweep(ranges, first_rad=0.0, step_rad=math.pi / 2.0, mount=BACKWARDS, stamp_s=10.0):
    return Sweep(stamp_s, ranges, first_rad, step_rad, 0.1, 30.0, mount)


def test_returns_lie_in_base_link_through_their_mount():
    points = points_of([sweep([2.0, 1.0])], AT_REST)
    assert points == pytest.approx(np.array([[-2.2, 0.0], [-0.2, -1.0]]), abs=1e-9)


def test_no_returns_are_left_out():
    points = points_of([sweep([math.inf, math.nan, 0.01, 30.0, 2.0], step_rad=0.0)], AT_REST)
    assert points == pytest.approx(np.array([[-2.2, 0.0]]), abs=1e-9)


@pytest.mark.parametrize("angles", [(math.nan, 0.1), (0.0, math.inf), (-math.inf, 0.1)])
@pytest.mark.filterwarnings("error")
def test_sweep_whose_angles_are_no_numbers_is_not_shown(angles):
    assert points_of([sweep([2.0, 1.0], *angles)], AT_REST).shape == (0, 2)


def test_returns_are_carried_to_the_time_of_the_pose():
    ahead = points_of([sweep([2.0], mount=Pose2(0.0, 0.0, 0.0), stamp_s=9.9)], Motion(10.0, 1.0, 0.0))
    assert ahead == pytest.approx(np.array([[1.9, 0.0]]), abs=1e-9)
    turned = points_of([sweep([2.0], mount=Pose2(0.0, 0.0, 0.0), stamp_s=9.9)], Motion(10.0, 0.0, math.pi))
    assert np.arctan2(turned[0, 1], turned[0, 0]) == pytest.approx(-0.1 * math.pi)


def test_path_is_the_cars_and_keeps_its_end():
    points = np.column_stack((np.arange(1000.0) / 100.0, np.zeros(1000)))
    path = path_of(points, Pose2(1.0, 0.0, math.pi / 2.0))
    assert len(path) <= MAX_PATH_POINTS
    assert path[-1] == pytest.approx(np.array([1.0, 9.99]))
    assert len(path_of(NO_PATH, Pose2(0.0, 0.0, 0.0))) == 0


def test_a_whole_message_is_below_ten_kilobytes():
    wall = sweep([25.0 + 4.0 * math.sin(index) for index in range(1440)], step_rad=math.radians(0.25))
    seen = Surroundings(points_of([wall, wall], AT_REST), path_of(np.full((5000, 2), -150.0), Pose2(0.0, 0.0, 0.0)),
                        Obstacle(DriveStatus.BLOCKED, 0.4, 0.1))
    message = link.Surroundings()
    fill(message, seen)
    assert 2 * MAX_POINTS >= len(message.points_cm) > MAX_POINTS / 2
    assert len(message.SerializeToString()) < 10_000 / 5 * 2


@pytest.mark.parametrize(("obstacle", "zone", "is_there"), [
    (Obstacle(DriveStatus.CLEAR, math.nan, math.nan), link.STOP_ZONE_CLEAR, False),
    (Obstacle(DriveStatus.SLOWED, 0.8, -0.2), link.STOP_ZONE_SLOWED, True),
    (Obstacle(DriveStatus.BLIND, math.nan, math.nan), link.STOP_ZONE_BLIND, False),
    (Obstacle(9, math.nan, 0.0), link.STOP_ZONE_UNSPECIFIED, False)])
def test_obstacle_is_told_where_there_is_one(obstacle, zone, is_there):
    message = link.Surroundings()
    fill(message, Surroundings(NO_PATH, NO_PATH, obstacle))
    assert (message.zone, message.HasField("obstacle_m")) == (zone, is_there)


def test_numbers_that_are_none_reach_nobody():
    message = link.Surroundings()
    fill(message, Surroundings(np.array([[math.nan, 1.0], [1e9, 0.0], [1.0, 2.0]]), NO_PATH))
    assert list(message.points_cm) == [100, 200]
    assert not message.HasField("zone")


class Bytes:
    """A received AnyMsg."""

    def __init__(self, message):
        import io
        buffer = io.BytesIO()
        message.serialize(buffer)
        self._buff = buffer.getvalue()


@pytest.fixture
def eyes(monkeypatch):
    taken = {}
    monkeypatch.setattr(rospy, "Subscriber", lambda topic, _kind, take, queue_size: taken.setdefault(topic, take))
    made = Eyes(LidarMounts(Pose2(0.0, 0.0, 0.0), None))
    assert set(taken) == {names.FRONT_SCAN, names.MOTION_PATH}
    return made, taken


def test_every_second_status_carries_what_is_seen(eyes):
    looking, taken = eyes
    scan = LaserScan(ranges=[2.0], range_min=0.1, range_max=30.0)
    scan.header.stamp = rospy.Time(10)
    taken[names.FRONT_SCAN](Bytes(scan))
    pose = LocalizedPose(valid=True)
    pose.header.stamp = rospy.Time(10)
    inputs = Inputs(10.0, pose=pose, car=CarEstimate(), drive=DriveStatus(zone=DriveStatus.BLOCKED, obstacle_m=0.5))
    assert looking.look(inputs) is None
    seen = looking.look(inputs)
    assert seen.points == pytest.approx(np.array([[2.0, 0.0]]))
    assert seen.obstacle == (DriveStatus.BLOCKED, 0.5, 0.0)
    assert len(seen.path) == 0


@pytest.mark.parametrize(("frame", "planned", "shown"), [(names.MAP, (10.0, 6.0), (1.0, 0.0)),
                                                         (names.CAR, (1.0, 2.0), (1.0, 2.0))])
def test_path_is_shown_where_it_lies_whichever_frame_it_was_planned_in(eyes, frame, planned, shown):
    looking, taken = eyes
    path = Path(poses=[PoseStamped()])
    path.header.frame_id = frame
    path.poses[0].pose.position.x, path.poses[0].pose.position.y = planned
    taken[names.MOTION_PATH](Bytes(path))
    car = CarEstimate(state=CarState.LOCATED, x=10.0, y=5.0, heading=math.pi / 2.0)
    inputs = Inputs(10.0, pose=LocalizedPose(valid=True), car=car)
    looking.look(inputs)
    assert looking.look(inputs).path[-1] == pytest.approx(np.array(shown))


def test_message_of_another_type_and_an_old_one_are_not_shown(eyes):
    looking, taken = eyes
    pose = LocalizedPose(valid=True)
    pose.header.stamp = rospy.Time(20)
    taken[names.FRONT_SCAN](Bytes(LaserScan(ranges=[2.0], range_max=30.0)))
    taken[names.MOTION_PATH](Bytes(Imu()))
    looking.look(Inputs(20.0, pose=pose))
    assert len(looking.look(Inputs(20.0, pose=pose)).points) == 0
    taken[names.FRONT_SCAN](Bytes(Imu()))
    looking.look(Inputs(20.0, pose=pose))
    assert len(looking.look(Inputs(20.0, pose=pose)).points) == 0
