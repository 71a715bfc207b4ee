"""Recordings of real robots: the fit to an independent truth, both halves of a bag, and the table."""
# SPDX-License-Identifier: Apache-2.0
import collections
import math
from types import SimpleNamespace

import numpy as np
import pytest
import rosbag
import rospy
from geometry_msgs.msg import PoseStamped, TransformStamped
from nav_msgs.msg import Odometry
from sensor_msgs.msg import LaserScan
from tf2_msgs.msg import TFMessage

from mtr_benchmarks.localization.drives.pose_track import compose, pose_track
from mtr_benchmarks.real import one_bag
from mtr_benchmarks.real.__main__ import main, report
from mtr_benchmarks.real.halves import halves_of, truth_in
from mtr_benchmarks.real.one_bag import Off, Outcome, off
from mtr_benchmarks.real.truth_fit import errors_m, fit
from mtr_core import names
from mtr_core.se2 import Pose2
from mtr_localization.any_bag.sources import Asked

STAMPS_S = np.arange(0.0, 25.0, 0.04)
TRUTH_S = np.arange(1.0, 24.0, 0.125)
FRAME, LEVER, DELAY_S = Pose2(3.0, -2.0, 0.7), (0.2, -0.05), 0.04


def drive(off_m=0.0):
    """Return a drive on a circle of 2 m, with an error that grows to off_m."""
    angle = 0.25 * STAMPS_S
    poses = np.stack([2.0 * np.sin(angle) + off_m * STAMPS_S / 25.0, 2.0 - 2.0 * np.cos(angle), angle], axis=1)
    return pose_track(STAMPS_S, poses)


def truth(noise_m=0.0, seed=1):
    """Return the truth of a sensor at the lever, in its own frame and on its own clock."""
    angle = 0.25 * (TRUTH_S - DELAY_S)
    poses = compose(FRAME, np.stack([2.0 * np.sin(angle), 2.0 - 2.0 * np.cos(angle), angle], axis=1))
    cos, sin = np.cos(poses[:, 2]), np.sin(poses[:, 2])
    places = poses[:, :2] + np.stack([cos * LEVER[0] - sin * LEVER[1], sin * LEVER[0] + cos * LEVER[1]], axis=1)
    return places + np.random.default_rng(seed).normal(0.0, noise_m, places.shape)


def test_frame_of_the_truth_is_fitted_and_a_perfect_drive_has_no_error():
    found = fit(drive(), TRUTH_S, truth())
    assert errors_m(found, drive(), TRUTH_S, truth()).max() < 1e-4


def test_outliers_of_the_truth_do_not_move_the_fit():
    places = truth(0.002)
    places[::12] += 1.0
    off_m = errors_m(fit(drive(), TRUTH_S, places), drive(), TRUTH_S, truth())
    assert off_m.max() < 0.02


def test_error_of_a_track_is_scored_on_places_that_it_was_not_fitted_to():
    assert off(drive(), drive(), TRUTH_S, truth(0.003)).rms_mm == pytest.approx(3.0 * math.sqrt(2.0), rel=0.25)
    assert off(drive(), drive(0.1), TRUTH_S, truth()).rms_mm > 20.0
    assert off(drive(), drive(), TRUTH_S, truth()).places == len(TRUTH_S) // 2
    assert off(drive(), drive(), TRUTH_S[:10], truth()[:10]) is None


def written(path):
    """Write a short drive with one LiDAR and a truth."""
    with rosbag.Bag(str(path), "w") as bag:
        for number in range(40):
            stamp = rospy.Time.from_sec(10.0 + 0.1 * number)
            odometry = Odometry(child_frame_id="base")
            odometry.header.stamp, odometry.pose.pose.orientation.w = stamp, 1.0
            odometry.pose.pose.position.x = 0.05 * number
            mount = TransformStamped(child_frame_id="laser")
            mount.header.frame_id, mount.header.stamp, mount.transform.rotation.w = "base", stamp, 1.0
            scan = LaserScan(ranges=[float(number)], angle_increment=0.1, range_max=100.0)
            scan.header.frame_id, scan.header.stamp = "laser", stamp
            pose = PoseStamped()
            pose.header.stamp, pose.pose.position.y = stamp, float(number)
            for topic, message in (("/odom", odometry), ("/tf", TFMessage([mount])), ("/scan", scan), ("/true", pose)):
                bag.write(topic, message, stamp)
    return path


def test_sweeps_go_by_turns_into_two_bags_and_everything_else_into_both(tmp_path):
    halves = halves_of(written(tmp_path / "a.bag"), tmp_path, Asked())
    ranges = {}
    for path in (halves.even, halves.odd):
        counts = collections.Counter()
        with rosbag.Bag(str(path)) as bag:
            for topic, message, _ in bag.read_messages():
                counts[topic] += 1
                if topic == names.FRONT_SCAN:
                    ranges.setdefault(path.stem, []).append(message.ranges[0])
        assert counts[names.WHEEL_ODOMETRY] == counts[names.IMU_DATA] == 40 and counts["/tf_static"] == 1
    assert ranges == {"even": list(np.arange(0.0, 40.0, 2.0)), "odd": list(np.arange(1.0, 40.0, 2.0))}
    assert halves.odometry.poses[-1, 0] == pytest.approx(1.95) and list(halves.mounts) == [names.FRONT_SCAN]


def test_truth_is_read_where_there_is_any(tmp_path):
    path = written(tmp_path / "a.bag")
    stamps_s, places = truth_in(path, "/true")
    assert len(stamps_s) == 40 and places[7, 1] == pytest.approx(7.0)
    assert not len(truth_in(path, "/odom")[0]) and not len(truth_in(path, "/none")[0])


def test_bag_that_cannot_be_used_says_why_and_fails_nothing(tmp_path):
    bad = tmp_path / "bad.bag"
    bad.write_bytes(b"no bag")
    assert "cannot be read" in one_bag.measure(bad, "/true", None, Asked()).refused
    assert main([str(tmp_path), "--out", str(tmp_path / "out")]) == 0
    assert (tmp_path / "out" / "real.json").exists()


def test_folder_without_bags_is_a_sentence(tmp_path, capsys):
    with pytest.raises(SystemExit):
        main([str(tmp_path)])
    assert "has no bags" in capsys.readouterr().err


@pytest.mark.parametrize(("ours_mm", "is_met"), [(19.0, True), (30.0, False)])
def test_mrpt_is_what_must_be_reached(ours_mm, is_met):
    found = Outcome("a.bag", "", 0.9, 0.4, Off(ours_mm, 30.0, 50), Off(24.0, 40.0, 50))
    rows = report([found]).rows
    row, = [each for each in rows if "off the truth" in each.requirement.name]
    assert row.is_met is is_met and row.requirement.goal == pytest.approx(0.8 * 24.0)
    assert SimpleNamespace(**row.as_json()).mrpt_mm == 24.0
