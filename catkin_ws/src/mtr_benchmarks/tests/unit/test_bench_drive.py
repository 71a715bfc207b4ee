"""The benchmark's robot drives around the Car as planned, and its recording contains sensors and truth."""
# SPDX-License-Identifier: Apache-2.0
import itertools
import math
from dataclasses import replace

import numpy as np
import pytest
import rosbag

from mtr_benchmarks.localization.drives.legs import (
    LegFollower,
    LiftLeg,
    PathLeg,
    StandLeg,
    StraightLeg,
    TurnLeg,
    leg_name,
)
from mtr_benchmarks.localization.drives.options import DriveOptions
from mtr_benchmarks.localization.drives.pattern import DrivePlan, outline_distance, pieces
from mtr_benchmarks.localization.drives.record import main, record
from mtr_benchmarks.localization.drives.selection import (
    CAMPAIGN,
    CARS,
    KIDNAP,
    LIDAR_KINDS,
    LIDAR_SCENES,
    OPPOSED,
    PITCHED,
    PLAIN,
    RANGE_BIAS,
    SCENES,
    TILT,
    all_drives,
    options,
)
from mtr_benchmarks.localization.drives.truth import read_truth
from mtr_core import names
from mtr_core.errors import ConfigurationError
from mtr_core.se2 import Pose2, wrap_angle
from mtr_simulation.site.car_shape import CAR_SHAPES

TICK_S = 0.02
START = Pose2(4.0, 2.6, math.atan2(-2.6, -4.0))
EIGHTHS = tuple(math.pi / 4.0 * step for step in range(8))


def follow(leg, pose):
    """Return the poses of a robot that follows commands immediately, until the leg is finished."""
    follower, poses, done = LegFollower(leg, pose, TICK_S), [pose], False
    while not done:
        (speed, turning), done = follower.update(poses[-1])
        poses.append(poses[-1] @ Pose2(speed * TICK_S, 0.0, turning * TICK_S))
        assert len(poses) < 20_000
    return poses


def whole_way(shape, plan):
    """Return all poses of the pattern."""
    poses = [START]
    for piece in pieces(shape, START, plan):
        poses += follow(piece.leg, poses[-1])
    return poses


@pytest.mark.parametrize("name", ["hatchback", "van"])
def test_no_place_of_the_pattern_is_nearer_to_the_car_than_its_axes_end(name):
    shape = CAR_SHAPES[name]
    poses = whole_way(shape, DrivePlan(EIGHTHS, EIGHTHS[:5], 10.0))
    beyond = [math.hypot(max(abs(pose.x) - 0.5 * shape.length_m, 0.0), max(abs(pose.y) - 0.5 * shape.width_m, 0.0))
              for pose in poses]
    assert min(beyond) > 0.6


def test_axis_is_driven_facing_the_car_both_ways():
    shape = CAR_SHAPES["hatchback"]
    poses = [START]
    for piece in pieces(shape, START, DrivePlan((0.0,), (), 10.0)):
        driven = follow(piece.leg, poses[-1])
        if piece.kind == "axis":
            assert all(abs(wrap_angle(pose.heading - math.pi)) < 0.05 for pose in driven)
            assert all(abs(pose.y) < 0.05 for pose in driven)
        poses += driven


def test_radial_reaches_as_far_as_it_is_told():
    shape = CAR_SHAPES["hatchback"]
    poses = whole_way(shape, DrivePlan((), (math.pi / 2.0,), 10.0))
    farthest = max(poses, key=lambda pose: math.hypot(pose.x, pose.y))
    assert math.hypot(farthest.x, farthest.y) - outline_distance(shape, math.pi / 2.0) == pytest.approx(10.0, abs=0.05)


def test_loop_ends_where_it_went_round():
    shape = CAR_SHAPES["hatchback"]
    way = next(piece.leg for piece in pieces(shape, START, DrivePlan((), (), 1.0)) if isinstance(piece.leg, PathLeg))
    assert way.points[0] == way.points[-1]
    turns = [wrap_angle(math.atan2(b[1], b[0]) - math.atan2(a[1], a[0])) for a, b in zip(way.points, way.points[1:])]
    assert sum(turns) == pytest.approx(2.0 * math.pi)


def test_endless_plan_goes_on():
    plan = DrivePlan((0.0,), (), 1.0, endless=True)
    kinds = [piece.kind for piece in itertools.islice(pieces(CAR_SHAPES["sedan"], START, plan), 100)]
    assert kinds.count("loop") == 2
    assert kinds.count("axis") > 30


@pytest.mark.parametrize("leg", [StraightLeg((2.0, 0.0), 0.5), StraightLeg((-2.0, 0.0), 0.5, True),
                                 PathLeg(((2.0, 1.0),), 0.5)])
def test_leg_ends_at_its_goal(leg):
    goal = leg.points[-1] if isinstance(leg, PathLeg) else leg.to
    start = Pose2(0.0, 0.0, math.atan2(goal[1], goal[0]) if isinstance(leg, PathLeg) else 0.0)
    end = follow(leg, start)[-1]
    assert math.hypot(end.x - goal[0], end.y - goal[1]) < 0.03


@pytest.mark.parametrize("heading", [-3.0, -0.5, 0.02, 3.1])
def test_turn_ends_at_its_heading(heading):
    assert abs(wrap_angle(follow(TurnLeg(heading), Pose2(1.0, 1.0, 0.0))[-1].heading - heading)) < 0.02


@pytest.mark.parametrize(("leg", "name"), [
    (StandLeg(1.0), "stand"), (TurnLeg(1.0), "turn"), (StraightLeg((1.0, 0.0), 0.5), "straight"),
    (PathLeg(((1.0, 0.0),), 0.5), "path"), (LiftLeg(1.0, 0.0), "lift")])
def test_leg_has_its_name_in_the_files(leg, name):
    assert leg_name(leg) == name


def test_standing_takes_its_time():
    assert len(follow(StandLeg(1.0), START)) == 51


def test_recording_holds_what_the_live_robot_would_hear_and_the_truth(tmp_path):
    meta = record(DriveOptions(scene="open", seed=3, rear=True, duration_s=2.5), tmp_path)
    with rosbag.Bag(str(tmp_path / "drive.bag")) as bag:
        counts = {topic: each.message_count for topic, each in bag.get_type_and_topic_info().topics.items()}
        scan = next(message for _, message, _ in bag.read_messages(topics=[names.FRONT_SCAN]))
        order = next(message for _, message, _ in bag.read_messages(topics=[names.MAPPING_ORDER]))
    ticks = counts[names.WHEEL_ODOMETRY]
    assert counts[names.IMU_DATA] == ticks
    assert counts[names.FRONT_SCAN] == counts[names.REAR_SCAN] == pytest.approx(ticks / 2.0, abs=1.0)
    assert counts["/tf_static"] == 1
    assert scan.header.frame_id == names.FRONT_LIDAR and len(scan.ranges) == 720
    assert (order.map_car_id, order.phase) == (0, order.IDLE)
    truth = read_truth(tmp_path)
    assert len(truth.track.stamps_s) == ticks
    start = Pose2(*meta["map_from_car"].values()) @ Pose2(*truth.track.poses[0])
    assert (start.x, start.y, start.heading) == pytest.approx((0.0, 0.0, 0.0), abs=1e-3)
    assert truth.standing[50]


def test_each_of_so_many_sweeps_is_recorded_whole(tmp_path):
    record(DriveOptions(scene="open", seed=3, duration_s=1.5, sweeps_apart=4), tmp_path)
    with rosbag.Bag(str(tmp_path / "drive.bag")) as bag:
        stamps = [message.header.stamp.to_nsec() for _, message, _ in bag.read_messages(topics=[names.FRONT_SCAN])]
    assert set(np.diff(stamps)) == {160_000_000}


def test_wrong_option_is_a_sentence_and_no_folder(tmp_path, capsys):
    assert main(["--car", "tractor", "--out", str(tmp_path / "new")]) == 1
    assert "car is 'tractor'; allowed is default, hatchback" in capsys.readouterr().err
    assert not (tmp_path / "new").exists()


def test_wrong_scene_is_named():
    with pytest.raises(ConfigurationError, match="scenario is 'moon'"):
        DriveOptions(scene="moon")


def test_drives_cover_all_shapes_heights_and_persons_in_each_scene():
    plain = [each.options for each in all_drives() if each.variant == PLAIN]
    for scene in SCENES:
        mine = [each for each in plain if each.scene == scene]
        assert len({each.seed for each in mine}) >= 10
        assert {(each.car, each.lidar_height_m) for each in mine} == set(itertools.product(CARS, (0.2, 0.3)))
        assert {each.person for each in mine} == {True, False}


def test_drives_have_names_of_their_own():
    listed = [each.name for each in all_drives()]
    assert len(set(listed)) == len(listed)


@pytest.mark.parametrize("variant", LIDAR_KINDS)
def test_lidars_of_another_kind_are_in_each_of_their_scenes_and_nothing_else_differs(variant):
    drives = [each for each in all_drives() if each.variant == variant]
    assert [each.options.scene for each in drives] == list(LIDAR_SCENES)
    for each in drives:
        kind, twin = LIDAR_KINDS[variant], options(each.options.scene, each.options.seed)
        assert each.options == replace(twin, beams=kind.beams, field_deg=kind.field_deg, rear=kind.rear,
                                       sweeps_apart=kind.sweeps_apart)
        assert each.options != twin


def test_variants_differ_from_a_plain_drive_in_one_error_only():
    every = all_drives()
    plain = {(each.options.scene, each.options.seed): each.options for each in every if each.variant == PLAIN}
    for each in every:
        if each.variant in LIDAR_KINDS:
            continue
        twin = plain[each.options.scene, each.options.seed]
        differing = {name for name in vars(twin) if getattr(twin, name) != getattr(each.options, name)}
        assert differing == {PLAIN: set(), RANGE_BIAS: {"range_bias_m"}, OPPOSED: {"opposed_bias_m"},
                             TILT: {"tilt_deg"}, PITCHED: {"mount_tilt_deg"}, KIDNAP: {"kidnap"},
                             CAMPAIGN: {"duration_s", "sweeps_apart"}}[each.variant]
