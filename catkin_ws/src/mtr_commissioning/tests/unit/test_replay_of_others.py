"""Program replay with bags of other robots: its conversion of them, and the comparison of their sensors."""
# SPDX-License-Identifier: Apache-2.0
import math

import numpy as np
import pytest
import rosbag
import rospy
import yaml
from geometry_msgs.msg import TransformStamped
from nav_msgs.msg import Odometry
from scipy.spatial.transform import Rotation
from sensor_msgs.msg import LaserScan
from tf2_msgs.msg import TFMessage

from mtr_commissioning.calibration.command_line import main as calibrate
from mtr_localization import replay

# Hall with a pillar, without rotational symmetry.
WALLS = ((-4.0, -3.0, 6.0, -3.0), (6.0, -3.0, 6.0, 4.0), (6.0, 4.0, -4.0, 5.0), (-4.0, 5.0, -4.0, -3.0),
         (2.0, 1.0, 2.6, 1.0), (2.6, 1.0, 2.6, 1.8), (2.6, 1.8, 2.0, 1.8), (2.0, 1.8, 2.0, 1.0))
BEAMS, FIRST_RAD, STEP_RAD = 540, -0.75 * math.pi, 1.5 * math.pi / 540
LIDAR_M, SPEED_MPS, TURN_RADPS, RATE_HZ, TURNS_FROM_S, END_S = 0.3, 0.4, 0.5, 10.0, 4.0, 12.0


def ranges_at(x, y, heading, angles):
    """Return the distances to the walls from a pose, in the directions of the beams."""
    directions = heading + angles
    nearest = np.full(len(angles), np.inf)
    for ax, ay, bx, by in WALLS:
        along = np.array([bx - ax, by - ay])
        dx, dy = np.cos(directions), np.sin(directions)
        cross = dx * along[1] - dy * along[0]
        with np.errstate(divide="ignore", invalid="ignore"):
            distance = ((ax - x) * along[1] - (ay - y) * along[0]) / cross
            share = ((ax - x) * dy - (ay - y) * dx) / cross
        hit = (distance > 0.0) & (share >= 0.0) & (share <= 1.0)
        nearest = np.where(hit, np.minimum(nearest, distance), nearest)
    return nearest


def drive(path, told_rpy, hangs=False):
    """Write a bag of a LiDAR that faces ahead; told_rpy: rotation in its transform. hangs: it is upside down."""
    x = y = heading = 0.0
    angles = FIRST_RAD + STEP_RAD * np.arange(BEAMS)
    noise = np.random.default_rng(1)
    with rosbag.Bag(str(path), "w") as bag:
        for number in range(round(END_S * RATE_HZ)):
            time_s = 100.0 + number / RATE_HZ
            stamp, turn = rospy.Time.from_sec(time_s), TURN_RADPS * (number / RATE_HZ > TURNS_FROM_S)
            odometry = Odometry(child_frame_id="base")
            odometry.header.stamp = stamp
            odometry.pose.pose.position.x, odometry.pose.pose.position.y = x, y
            odometry.pose.pose.orientation.z = math.sin(0.5 * heading)
            odometry.pose.pose.orientation.w = math.cos(0.5 * heading)
            bag.write("/odom", odometry, stamp)
            mount = TransformStamped(child_frame_id="laser")
            mount.header.frame_id, mount.header.stamp, mount.transform.translation.x = "base", stamp, LIDAR_M
            rotation = mount.transform.rotation
            rotation.x, rotation.y, rotation.z, rotation.w = Rotation.from_euler("xyz", told_rpy).as_quat()
            bag.write("/tf", TFMessage([mount]), stamp)
            place = x + LIDAR_M * math.cos(heading), y + LIDAR_M * math.sin(heading)
            ranges = ranges_at(*place, heading, -angles if hangs else angles) + noise.normal(0.0, 0.01, BEAMS)
            scan = LaserScan(angle_min=FIRST_RAD, angle_increment=STEP_RAD, angle_max=float(angles[-1]), range_min=0.05,
                             range_max=20.0, ranges=list(ranges))
            scan.header.frame_id, scan.header.stamp = "laser", stamp
            bag.write("/laser", scan, stamp)
            speed = SPEED_MPS if not turn else 0.5 * SPEED_MPS
            x, y = x + speed / RATE_HZ * math.cos(heading), y + speed / RATE_HZ * math.sin(heading)
            heading += turn / RATE_HZ
    return path


@pytest.mark.parametrize(("told_rpy", "hangs", "words"), [
    ((0.0, 0.0, 0.0), False, "ok  /odom: The wheels say 1.00"),
    ((math.pi, 0.0, 0.0), True, "ok  /odom: The wheels say 1.00"),
    ((math.pi, 0.0, 0.0), False, "BAD"),
    ((0.0, 0.0, 0.6), False, "BAD"),
    ((0.0, 0.0, math.pi), False, "BAD")])
def test_mount_that_contradicts_what_is_seen_is_named(tmp_path, capsys, told_rpy, hangs, words):
    bag = drive(tmp_path / "theirs.bag", told_rpy, hangs)
    assert replay.main([str(bag), "--out", str(tmp_path / "out"), "--in-motion", "--no-car"]) == 0
    said = capsys.readouterr().out
    assert words in said and ("BAD" in said) is (words == "BAD"), said


def test_drive_calibrates_the_lidar_and_the_record_has_it(tmp_path, capsys):
    bag, record = drive(tmp_path / "theirs.bag", (0.0, 0.0, 0.02)), tmp_path / "robot.yaml"
    options = ["--record", str(record), "--robot", "R", "--by", "Nov\u00e1k"]
    assert calibrate(["lidars", "--bag", str(bag), *options]) == 0
    said = capsys.readouterr().out
    document = yaml.safe_load(record.read_text(encoding="utf-8"))
    yaw = document["terms"]["lidar_yaw_deg"]
    assert "front_lidar at 0.300, 0.000 m, x_m: not told by this drive" in said
    assert yaw["value"] == pytest.approx(-math.degrees(0.02), abs=4.0 * yaw["uncertainty"]) and yaw["uncertainty"] < 0.3
    assert calibrate(["lidars", "--bag", str(tmp_path / "none.bag"), *options]) == 1
    assert "cannot be read" in capsys.readouterr().err
    assert yaml.safe_load(record.read_text(encoding="utf-8")) == document


@pytest.mark.parametrize("arguments", [["lidars"], ["wheels", "--bag", "a.bag"]])
def test_bag_belongs_to_the_lidars(arguments, capsys):
    with pytest.raises(SystemExit):
        calibrate(arguments)
    assert "lidars needs --bag FILE" in capsys.readouterr().err


def test_other_robots_drive_is_tracked_and_written_for_other_tools(tmp_path):
    bag = drive(tmp_path / "theirs.bag", (0.0, 0.0, 0.0))
    options = ["--in-motion", "--no-car", "--loop-end-after", "11"]
    assert replay.main([str(bag), "--out", str(tmp_path / "out"), *options]) == 0
    rows = [line.split() for line in (tmp_path / "out" / "trajectory.tum").read_text(encoding="utf-8").splitlines()[1:]]
    assert len(rows) > 100 and all(len(row) == 8 for row in rows)


def test_bag_that_cannot_be_used_is_a_sentence(tmp_path, capsys):
    bag = tmp_path / "none.bag"
    bag.write_bytes(b"no bag")
    assert replay.main([str(bag), "--out", str(tmp_path / "out")]) == 1
    assert capsys.readouterr().err.startswith(f"{bag} cannot be read: it is not a bag")


def spoil(scan, quirk):
    """Apply a typical fault of other robots' drivers."""
    if quirk == "beams missing":
        scan.ranges = scan.ranges[:-10]
    elif quirk == "clockwise":
        scan.angle_increment, scan.ranges = -scan.angle_increment, scan.ranges[::-1]
    elif quirk == "milliseconds":
        scan.scan_time, scan.time_increment = 100.0, 100.0 / BEAMS
    elif quirk == "limits swapped":
        scan.range_min, scan.range_max = scan.range_max, scan.range_min
    elif quirk == "angles not a number":
        scan.angle_min = math.nan
    return scan


QUIRKS = ("beams missing", "clockwise", "milliseconds", "limits swapped", "angles not a number")


def rewritten(source, target, change):
    """Return the bag with each scan changed."""
    with rosbag.Bag(str(source)) as read, rosbag.Bag(str(target), "w") as written:
        for topic, message, stamp in read.read_messages():
            written.write(topic, change(message) if topic == "/laser" else message, stamp)
    return target


@pytest.fixture(scope="module", name="plain")
def plain_fixture(tmp_path_factory):
    return drive(tmp_path_factory.mktemp("plain") / "theirs.bag", (0.0, 0.0, 0.0))


@pytest.mark.parametrize("quirk", QUIRKS)
def test_without_a_used_scan_no_pose_is_valid_and_the_reason_comes_first(tmp_path, capsys, plain, quirk):
    bag = rewritten(plain, tmp_path / "theirs.bag", lambda scan: spoil(scan, quirk))
    assert replay.main([str(bag), "--out", str(tmp_path / "out"), "--in-motion", "--no-car"]) == 1
    first, second = capsys.readouterr().out.splitlines()[:2]
    assert first.startswith("120 scans of the front LiDAR (/laser) were refused. A scan"), first
    assert second == "None of the 120 scans was used, so no pose is valid."
    rows = (tmp_path / "out" / "trajectory.csv").read_text(encoding="utf-8").splitlines()
    valid = rows[0].split(",").index("valid")
    assert len(rows) > 100 and {row.split(",")[valid] for row in rows[1:]} == {"0"}


def test_part_of_the_scans_is_refused_and_counted(tmp_path, capsys, plain):
    count = iter(range(1000))
    bag = rewritten(plain, tmp_path / "theirs.bag",
                    lambda scan: spoil(scan, "beams missing" if next(count) % 4 == 0 else ""))
    assert replay.main([str(bag), "--out", str(tmp_path / "out"), "--in-motion", "--no-car"]) == 0
    assert capsys.readouterr().out.startswith("30 scans of the front LiDAR (/laser) were refused.")


def test_times_in_milliseconds_are_replaced_by_the_option(tmp_path, plain):
    bag = rewritten(plain, tmp_path / "theirs.bag", lambda scan: spoil(scan, "milliseconds"))
    options = ["--in-motion", "--no-car", "--time-increment", str(0.1 / BEAMS)]
    assert replay.main([str(bag), "--out", str(tmp_path / "out"), *options]) == 0


def test_bag_that_begins_in_motion_is_advised_its_option(tmp_path, capsys, plain):
    assert replay.main([str(plain), "--out", str(tmp_path / "out"), "--no-car"]) == 1
    assert "Replay the bag with --in-motion" in capsys.readouterr().out.splitlines()[0]


def old_format(path):
    """Write the head of a bag in format 1.2: its version and a file header record."""
    def field(name, value):
        content = name + b"=" + value
        return len(content).to_bytes(4, "little") + content
    fields = field(b"op", b"\x03") + field(b"index_pos", bytes(8)) + field(b"conn_count", bytes(4))
    path.write_bytes(b"#ROSRECORD V1.2\n" + len(fields).to_bytes(4, "little") + fields + bytes(4))


def cut_off(path, share):
    """Write the first part of a recorded bag."""
    content = path.read_bytes()
    path.write_bytes(content[:int(share * len(content))])


@pytest.mark.parametrize(("spoilt", "words"), [
    (old_format, "format 1.2"), (lambda path: cut_off(path, 0.7), "rosbag reindex"),
    (lambda path: cut_off(path, 0.01), "rosbag reindex"),
    (lambda path: path.write_bytes(path.read_bytes()[:5000] + b"\xff" * 5000), "rosbag reindex"),
    (lambda path: rosbag.Bag(str(path), "w").close(), "no ")])
def test_every_reader_of_bags_ends_with_one_sentence(tmp_path, capsys, plain, spoilt, words):
    bag = tmp_path / "theirs.bag"
    bag.write_bytes(plain.read_bytes())
    spoilt(bag)
    out = str(tmp_path / "out")
    for program, arguments in ((replay.main, [str(bag), "--out", out]),
                               (calibrate, ["lidars", "--bag", str(bag), "--record", out, "--robot", "R",
                                            "--by", "N"])):
        assert program(arguments) == 1
        error = capsys.readouterr().err.strip()
        assert "\n" not in error and words in error, error
