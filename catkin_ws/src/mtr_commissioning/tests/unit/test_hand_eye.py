"""Mounts of LiDARs, scales and delay from a drive: estimated if the drive determines them, else unchanged."""
# SPDX-License-Identifier: Apache-2.0
import math

import numpy as np
import pytest

from mtr_commissioning.calibration import hand_eye
from mtr_commissioning.calibration.hand_eye import Odometry, Pairs, calibrated
from mtr_commissioning.calibration.readings import ReadingsUnusable
from mtr_core.se2 import Pose2
from mtr_core.sensor_figures import ASSUMED_GYRO_SCALE

FRONT, REAR = Pose2(0.12, 0.0, 0.0), Pose2(-0.2, 0.0, math.pi)
RATE_HZ, END_S = 100.0, 60.0
GYRO = ASSUMED_GYRO_SCALE.value


def driven(turns, noise):
    """Return times, poses of base_link (n, 3) and odometry of a drive ahead and back, optionally with turns. The gyro
    has a bias of 1 mrad/s; the wheels report 1 % too little."""
    times = np.arange(0.0, END_S, 1.0 / RATE_HZ)
    speed = 0.5 * np.sign(np.sin(0.35 * times)) * np.minimum(1.0, 4.0 * np.abs(np.sin(0.35 * times)))
    rate = turns * np.sin(0.5 * times + 0.4)
    heading = np.cumsum(rate) / RATE_HZ
    x, y = np.cumsum(speed * np.cos(heading)) / RATE_HZ, np.cumsum(speed * np.sin(heading)) / RATE_HZ
    way = np.cumsum(speed / 1.01 + noise.normal(0.0, 0.01, len(times))) / RATE_HZ
    turn = np.cumsum(rate + 1e-3 + noise.normal(0.0, 0.001, len(times))) / RATE_HZ
    return times, np.stack([x, y, heading], axis=1), Odometry(times, way, turn)


def seen(track, mounts, delay_s, noise):
    """Return the LiDAR's sweeps on a track (times, poses); it is described at mounts[0], but located at mounts[1], and
    its stamps are late."""
    (times, poses), (told, true), noise_m = track, mounts, 0.004
    begin = np.arange(1.0, END_S - 2.0, 0.5)
    motions = []
    for start_s in begin:
        at = [Pose2(*(float(np.interp(time_s, times, poses[:, column])) for column in range(3)))
              for time_s in (start_s, start_s + 0.5)]
        moved = (at[0] @ true).inverse() @ (at[1] @ true)
        motions.append((moved.x, moved.y, moved.heading))
    motions = np.array(motions) + noise.normal(0.0, 1.0, (len(begin), 3)) * (noise_m, noise_m, 0.5 * noise_m)
    return Pairs(told, begin + delay_s, begin + 0.5 + delay_s, motions)


def found_in(seed, turns=0.6, delay_s=0.03):
    """Front LiDAR 6 mm to the side and 0.8 degrees turned, rear one as described."""
    noise = np.random.default_rng(seed)
    times, poses, odometry = driven(turns, noise)
    true = FRONT @ Pose2(0.0, 0.006, math.radians(0.8))
    lidars = [seen((times, poses), (FRONT, true), delay_s, noise),
              seen((times, poses), (REAR, REAR), 0.0, noise)]
    return calibrated(lidars, odometry, GYRO)


TRUTH = {"y_m": 0.006, "yaw_rad": math.radians(0.8), "delay_s": 0.03}


def test_mount_scale_bias_and_delay_are_found():
    found = found_in(1)
    front, rear = found.lidars
    for name, true in TRUTH.items():
        assert front[name].is_told and front[name].value == pytest.approx(true, abs=4.0 * front[name].sigma)
    assert front["yaw_rad"].sigma < math.radians(0.2) and abs(rear["yaw_rad"].value) < 4.0 * rear["yaw_rad"].sigma
    assert found.base["wheel_scale"].is_told and found.base["wheel_scale"].value == pytest.approx(0.01, abs=0.003)
    assert found.base["gyro_bias_radps"].value == pytest.approx(1e-3, abs=5e-4) and found.steps > 80


def test_sigmas_are_what_the_estimates_scatter_by():
    squares = [((found.lidars[0][name].value - true) / found.lidars[0][name].sigma) ** 2
               for found in map(found_in, range(2, 22)) for name, true in TRUTH.items()]
    # Mean of 60 squares of unit normals; its sigma is 0.18.
    assert 0.4 < np.mean(squares) < 1.7


def test_drive_without_turns_does_not_tell_where_a_lidar_sits_and_says_so():
    front = found_in(1, turns=0.0).lidars[0]
    assert front["yaw_rad"].is_told and not front["x_m"].is_told and not front["y_m"].is_told
    assert abs(front["x_m"].value) < front["x_m"].prior_sigma


def test_point_about_which_tracks_turn_is_none_of_the_lidars():
    # A shift of both LiDARs ahead cannot be distinguished from a base that turns about another point.
    assert not found_in(1).lidars[0]["x_m"].is_told


def test_few_wrong_matches_change_little():
    noise = np.random.default_rng(3)
    times, poses, odometry = driven(0.6, noise)
    pairs = seen((times, poses), (FRONT, FRONT), 0.0, noise)
    pairs.motions[::10] += 0.3
    found, = calibrated([pairs], odometry, GYRO).lidars
    assert abs(found["yaw_rad"].value) < math.radians(0.3) and abs(found["y_m"].value) < 0.01


def test_short_drive_is_refused():
    noise = np.random.default_rng(3)
    times, poses, odometry = driven(0.6, noise)
    pairs = seen((times, poses), (FRONT, FRONT), 0.0, noise)
    short = Pairs(FRONT, pairs.begin_s[:9], pairs.end_s[:9], pairs.motions[:9])
    with pytest.raises(ReadingsUnusable, match="9 steps .* at least 20"):
        calibrated([short], odometry, GYRO)
    assert hand_eye.MIN_STEPS == 20
