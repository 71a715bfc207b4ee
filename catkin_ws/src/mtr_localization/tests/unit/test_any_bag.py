"""Bags of any robot are converted to the inputs of localization, or one sentence has the reason for the failure."""
# SPDX-License-Identifier: Apache-2.0
import math

import pytest
import rosbag
import rospy
from geometry_msgs.msg import TransformStamped
from nav_msgs.msg import Odometry
from scipy.spatial.transform import Rotation
from sensor_msgs.msg import Imu, LaserScan
from tf2_msgs.msg import TFMessage

from mtr_core import names
from mtr_localization import replay
from mtr_localization.any_bag import conversions
from mtr_localization.any_bag.conversions import convert
from mtr_localization.any_bag.errors import BagUnusable
from mtr_localization.any_bag.sources import NONE, TF, Asked, is_own

BEGIN_S, RATE_HZ, COUNT = 1000.0, 20.0, 60
SPEED_MPS, TURN_RADPS = 0.5, 0.4
MOUNTS = {"laser": (0.4, 0.05, (0.0, 0.0, 0.1)), "laser_behind": (-0.3, 0.0, (math.pi, 0.0, math.pi))}


def transform(parent, child, place, rpy, time_s=BEGIN_S):
    """Return a transform message."""
    message = TransformStamped(child_frame_id=child)
    message.header.frame_id, message.header.stamp = parent, rospy.Time.from_sec(time_s)
    at = message.transform
    at.translation.x, at.translation.y, at.translation.z = place
    at.rotation.x, at.rotation.y, at.rotation.z, at.rotation.w = Rotation.from_euler("xyz", rpy).as_quat()
    return message


class Robot:
    """Robot of another user whose bag is written; tests change its contents before.

    Attributes:
        scans: topic -> frame. has_odometry: on a topic, otherwise as a transform. mounts: frames on the base.
    """

    def __init__(self, path):
        self.path = path
        self.scans = {"/scan": "laser", "/hokuyo_behind": "laser_behind"}
        self.mounts = dict(MOUNTS)
        self.has_odometry, self.has_imu, self.wanders = True, False, False
        self.heights_m, self.ranges = {}, {}
        self.speed_mps, self.jump_s, self.scans_later_s = SPEED_MPS, 0.0, 0.0
        self.recorded = lambda stamp: stamp
        self.spoil_odometry = self.spoil_transform = lambda message: None

    def write(self):
        """Write the bag."""
        with rosbag.Bag(str(self.path), "w") as bag:
            for number in range(COUNT):
                self._step(bag, number)
        return self.path

    def _step(self, bag, number):
        time_s = BEGIN_S + number / RATE_HZ + (self.jump_s if number > COUNT // 2 else 0.0)
        stamp = rospy.Time.from_sec(time_s)
        turn = TURN_RADPS if self.speed_mps else 0.0
        heading, radius_m = turn * number / RATE_HZ, SPEED_MPS / TURN_RADPS
        place = (radius_m * math.sin(heading), radius_m * (1.0 - math.cos(heading)), 0.0)
        frames = [transform("base", frame, (x, y + 0.01 * number * self.wanders, self.heights_m.get(frame, 0.2)),
                            rpy, time_s) for frame, (x, y, rpy) in self.mounts.items()]
        if self.has_odometry:
            odometry = Odometry(child_frame_id="base")
            odometry.header.stamp = stamp
            odometry.pose.pose.position.x, odometry.pose.pose.position.y = place[:2]
            odometry.pose.pose.orientation.z = math.sin(0.5 * heading)
            odometry.pose.pose.orientation.w = math.cos(0.5 * heading)
            self.spoil_odometry(odometry)
            bag.write("/base/odom", odometry, self.recorded(stamp))
        else:
            frames.append(transform("odom", "base", place, (0.0, 0.0, heading), time_s))
        for frame in frames:
            self.spoil_transform(frame)
        bag.write("/tf", TFMessage(frames), stamp)
        if self.has_imu:
            imu = Imu()
            imu.header.stamp, imu.header.frame_id, imu.angular_velocity.y = stamp, "imu", -turn
            bag.write("/imu", imu, stamp)
        for topic, frame in self.scans.items():
            scan = LaserScan(angle_min=-1.0, angle_max=1.0, angle_increment=0.1, range_max=10.0)
            scan.ranges = self.ranges.get(topic, [5.0] * 21)
            scan.header.frame_id = frame
            scan.header.stamp = rospy.Time.from_sec(time_s + self.scans_later_s)
            bag.write(topic, scan, self.recorded(stamp))


@pytest.fixture(name="robot")
def robot_fixture(tmp_path):
    return Robot(tmp_path / "theirs.bag")


@pytest.fixture(name="converted")
def converted_fixture(robot, tmp_path):
    """Return a function that converts the bag and returns topic -> messages."""
    def of(asked=None, needs_motion=True):
        asked = Asked() if asked is None else asked
        out = tmp_path / "ours.bag"
        found = convert(robot.write(), out, asked, needs_motion, lambda _: None)
        messages = {}
        with rosbag.Bag(str(out)) as bag:
            for topic, message, _ in bag.read_messages():
                messages.setdefault(topic, []).append(message)
        return found, messages
    return of


def test_topics_are_found_by_their_types_and_lidars_by_their_places(converted):
    found, messages = converted()
    assert {topic: frame for topic, (frame, _) in found.mounts.items()} == {
        "/scan": "front_lidar", "/hokuyo_behind": "rear_lidar"}
    assert {len(messages[topic]) for topic in (names.FRONT_SCAN, names.REAR_SCAN, names.WHEEL_ODOMETRY)} == {COUNT}
    front, rear = messages["/tf_static"][0].transforms
    assert (front.header.frame_id, front.child_frame_id) == (names.BASE, "front_lidar")
    assert (front.transform.translation.x, front.transform.translation.y) == pytest.approx((0.4, 0.05))
    assert rear.transform.translation.x == pytest.approx(-0.3) and "upside down" in " ".join(found.said)
    assert messages[names.FRONT_SCAN][0].header.frame_id == "front_lidar"


@pytest.mark.parametrize("has_odometry", [True, False])
def test_odometry_comes_from_a_topic_or_from_transforms(robot, converted, has_odometry):
    robot.has_odometry = has_odometry
    found, messages = converted()
    last = messages[names.WHEEL_ODOMETRY][-1]
    assert found.base == "base" and found.odometry == ("/base/odom" if has_odometry else TF)
    assert last.twist.twist.linear.x == pytest.approx(SPEED_MPS, rel=1e-3)
    assert last.twist.twist.angular.z == pytest.approx(TURN_RADPS, rel=1e-6)


def test_wheels_turn_stands_in_for_a_gyro_with_its_noise(converted):
    found, messages = converted()
    gyro = messages[names.IMU_DATA][-1]
    assert gyro.angular_velocity.z == pytest.approx(TURN_RADPS) and gyro.linear_acceleration_covariance[0] == -1.0
    assert found.parameters == conversions.WHEELS_TURN and "turn rate: of the wheels" in " ".join(found.said)


def test_gyro_that_lies_on_its_side_is_turned_upright(robot, converted):
    robot.has_imu = True
    robot.mounts["imu"] = (0.0, 0.0, (-0.5 * math.pi, 0.0, 0.0))
    found, messages = converted()
    assert messages[names.IMU_DATA][-1].angular_velocity.z == pytest.approx(TURN_RADPS)
    assert not found.parameters
    assert converted(Asked(imu=NONE))[0].parameters


def test_stamps_that_are_late_and_sweeps_without_their_time_are_told(converted):
    _, messages = converted(Asked(scan_delay_s=0.04, time_increment_s=1e-4))
    scan = messages[names.FRONT_SCAN][0]
    assert scan.header.stamp.to_sec() == pytest.approx(BEGIN_S - 0.04) and scan.time_increment == pytest.approx(1e-4)
    assert "do not say how long a sweep takes" in " ".join(converted()[0].said)
    assert "do not say" not in " ".join(converted(Asked(time_increment_s=1e-4))[0].said)


def test_lidars_are_those_that_are_named(robot, converted):
    robot.scans["/top"] = "laser"
    found, messages = converted(Asked(front_scan="/hokuyo_behind"))
    assert list(found.mounts) == ["/hokuyo_behind"] and names.REAR_SCAN not in messages


def test_lidar_that_looks_over_everything_is_left_out(robot, converted):
    robot.heights_m["laser"] = 2.0
    found, _ = converted()
    assert list(found.mounts) == ["/hokuyo_behind"]
    assert "/scan is left out: its LiDAR is 1.8 m above the lowest" in " ".join(found.said)


def test_mounts_come_from_a_urdf_where_the_bag_has_none(robot, converted, tmp_path):
    robot.mounts = {}
    urdf = tmp_path / "robot.urdf"
    urdf.write_text('<robot name="r"><link name="base"/><link name="laser"/><link name="laser_behind"/>'
                    '<joint name="a" type="fixed"><parent link="base"/><child link="laser"/>'
                    '<origin xyz="0.5 0 0.2" rpy="0 0 0.2"/></joint>'
                    '<joint name="b" type="fixed"><parent link="base"/><child link="laser_behind"/></joint></robot>',
                    encoding="utf-8")
    found, _ = converted(Asked(urdf=str(urdf)))
    place = found.mounts["/scan"][1]
    assert place[:2, 3] == pytest.approx([0.5, 0.0]) and math.atan2(place[1, 0], place[0, 0]) == pytest.approx(0.2)


@pytest.mark.parametrize(("change", "asked", "words"), [
    ({"scans": {}}, Asked(), "has no scans"),
    ({"scans": {"/a": "laser", "/b": "laser", "/c": "laser"}}, Asked(), "name those of a level LiDAR"),
    ({"scans": {"/a": "laser", "/b": "laser"}}, Asked(), "equally far ahead"),
    ({"mounts": {}}, Asked(), "Nothing says where laser"),
    ({"wanders": True}, Asked(), "not fixed on the robot"),
    ({"speed_mps": 0.0}, Asked(), "does not move"),
    ({"jump_s": 60.0}, Asked(), "time jumps by 60"),
    ({"jump_s": -60.0}, Asked(), "time jumps by 57"),
    ({"scans_later_s": 3600.0}, Asked(), "clocks differ"),
    ({}, Asked(odometry="/odom"), "has no topic /odom"),
    ({}, Asked(imu="/scan"), "is of type sensor_msgs/LaserScan"),
    ({}, Asked(odometry=TF, base_frame="body"), "no odometry of body"),
    ({"has_odometry": False, "mounts": {}}, Asked(), "no odometry")])
def test_what_a_bag_lacks_is_a_sentence(robot, converted, change, asked, words):
    for name, value in change.items():
        setattr(robot, name, value)
    with pytest.raises(BagUnusable, match=words) as caught:
        converted(asked)
    assert str(caught.value).endswith(".")


MM = [1000.0 * (2.0 + 0.1 * beam) for beam in range(21)]


@pytest.mark.parametrize(("ranges", "words"), [
    ([math.nan] * 21, "has an echo between range_min 0 m and range_max 10 m"), ([math.inf] * 21, "has an echo"),
    ([0.0] * 21, "has an echo"), ([-1.0] * 21, "has an echo"), ([65.5] * 21, "has an echo"),
    ([1000.0] * 21, "has an echo"), ([3.4e38] * 21, "has an echo"), ([math.nan] * 10 + [11.0] * 11, "has an echo"),
    (MM, "probably millimetres"), ([0.0] * 5 + MM[5:], "probably millimetres"),
    ([math.nan] * 5 + MM[5:], "probably millimetres"), ([5.0] + MM[1:], "probably millimetres")])
def test_scans_without_an_echo_and_ranges_in_millimetres_are_refused(robot, converted, ranges, words):
    robot.ranges = {topic: ranges for topic in robot.scans}
    with pytest.raises(BagUnusable, match=words) as caught:
        converted()
    assert "/scan" in str(caught.value) and max(len(part.split()) for part in str(caught.value).split(". ")) <= 30


@pytest.mark.parametrize("ranges", [[5.0] + [math.inf] * 20, [3.4e38] * 20 + [5.0], [1000.0] * 20 + [5.0], [9.9] * 21])
def test_few_echoes_are_accepted(robot, converted, ranges):
    robot.ranges = {topic: ranges for topic in robot.scans}
    assert converted()[0].faults == []


def test_one_lidar_without_an_echo_is_named_and_the_other_is_used(robot, converted):
    robot.ranges = {"/hokuyo_behind": [math.inf] * 21}
    faults = converted()[0].faults
    assert len(faults) == 1 and "None of the 60 scans of /hokuyo_behind has an echo" in faults[0]


@pytest.mark.parametrize(("later_s", "words"), [(2.0, "2.00 s late"), (-2.0, "2.00 s early"), (4.5, "4.50 s late")])
def test_stamps_that_differ_from_the_times_of_recording_are_refused(robot, converted, later_s, words):
    robot.scans_later_s = later_s
    with pytest.raises(BagUnusable, match=f"{words} compared with /base/odom.*--scan-delay {later_s:.2f}"):
        converted()
    assert converted(Asked(scan_delay_s=later_s))[0].faults == []
    assert converted(Asked(scan_delay_s=0.0))[0].faults == []


@pytest.mark.parametrize("recorded", [
    lambda stamp: rospy.Time.from_sec(BEGIN_S), lambda stamp: rospy.Time.from_sec(0.1 * stamp.to_sec()),
    lambda stamp: rospy.Time.from_sec(BEGIN_S + 0.2 * (stamp.to_sec() - BEGIN_S))])
def test_times_of_recording_that_do_not_follow_the_stamps_show_nothing(robot, converted, recorded):
    robot.scans_later_s, robot.recorded = 2.0, recorded
    assert converted()[0].faults == []


@pytest.mark.parametrize("later_s", [0.0, 0.1, -0.5])
def test_usual_delays_of_the_recording_are_accepted(robot, converted, later_s):
    robot.scans_later_s, robot.recorded = later_s, lambda stamp: stamp + rospy.Duration.from_sec(3.0)
    assert converted()[0].faults == []


def without_rotation(orientation):
    """Set the quaternion to zero."""
    orientation.x = orientation.y = orientation.z = orientation.w = 0.0


def with_value(target, name, value):
    """Set one attribute."""
    setattr(target, name, value)


@pytest.mark.parametrize(("change", "words"), [
    ({"spoil_odometry": lambda odometry: without_rotation(odometry.pose.pose.orientation)},
     "A pose of /base/odom has no rotation"),
    ({"spoil_odometry": lambda odometry: with_value(odometry.pose.pose.position, "x", math.nan)},
     "A pose of /base/odom is not a number"),
    ({"spoil_odometry": lambda odometry: with_value(odometry.pose.pose.orientation, "w", math.nan)},
     "A pose of /base/odom"),
    ({"spoil_odometry": lambda odometry: with_value(odometry.header, "stamp", rospy.Time(0))},
     "Each of the 60 poses of /base/odom has the stamp 0, "),
    ({"spoil_odometry": lambda odometry: with_value(odometry.header, "stamp", rospy.Time(7))}, "has the stamp 7, "),
    ({"has_odometry": False, "spoil_transform": lambda each: with_value(each.header, "stamp", rospy.Time(0))},
     "Each of the 60 poses of the transforms has the stamp 0, "),
    ({"spoil_transform": lambda each: without_rotation(each.transform.rotation)},
     "A pose of the transform from base to laser has no rotation"),
    ({"spoil_transform": lambda each: with_value(each.transform.translation, "y", math.inf)},
     "A pose of the transform from base to laser is not a number"),
    ({"scans": {"/scan": ""}}, "The scans of /scan have no frame_id"),
    ({"scans": {"/scan": "/"}}, "The scans of /scan have no frame_id"),
    ({"scans": {"/scan": "laser", "/z": ""}}, "The scans of /z have no frame_id")])
def test_part_with_impossible_values_is_named(robot, converted, change, words):
    for name, value in change.items():
        setattr(robot, name, value)
    with pytest.raises(BagUnusable, match=words) as caught:
        converted()
    assert max(len(part.split()) for part in str(caught.value).split(". ")) <= 30


def test_robot_that_stands_may_be_localized_on_a_map(robot, converted):
    robot.speed_mps = 0.0
    assert converted(needs_motion=False)[1][names.FRONT_SCAN]


def test_file_that_is_no_bag_is_a_sentence(robot, tmp_path):
    robot.path.write_bytes(b"no bag")
    with pytest.raises(BagUnusable, match="it is not a bag"):
        convert(robot.path, tmp_path / "out.bag", Asked(), True, lambda _: None)


def test_own_recording_is_replayed_as_it_is():
    own = {names.FRONT_SCAN: "", names.IMU_DATA: "", names.WHEEL_ODOMETRY: ""}
    assert is_own(own, Asked()) and not is_own(own, Asked(imu=NONE)) and not is_own({names.FRONT_SCAN: ""}, Asked())


def test_help_tells_the_options_and_every_parameter_of_the_program(tmp_path, monkeypatch, capsys):
    program = tmp_path / "replay_bag"
    program.write_text("#!/bin/sh\necho 'Usage: as above'\necho\necho '  range_noise_m=0.015  0.001 to 0.1 m'\n",
                       encoding="utf-8")
    program.chmod(0o755)
    monkeypatch.setattr(replay, "find_node", lambda *_: [str(program)])
    with pytest.raises(SystemExit) as ended:
        replay.main(["--help"])
    said = capsys.readouterr().out
    assert ended.value.code in (0, None)
    assert "--begin-at" in said and "  range_noise_m=0.015  0.001 to 0.1 m\n" in said and "as above" not in said


def test_help_without_the_program_tells_what_is_missing(monkeypatch, capsys):
    monkeypatch.setattr(replay, "find_node", lambda *_: [])
    with pytest.raises(SystemExit):
        replay.main(["-h"])
    assert "not built" in capsys.readouterr().out
