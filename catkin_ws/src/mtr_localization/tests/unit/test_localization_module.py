"""Core of localization as a Python module: the class of the node, with plain readings as inputs."""
# SPDX-License-Identifier: Apache-2.0
import math
from typing import NamedTuple, Tuple

import mtr_localization_core as core
import numpy as np
import pytest

from mtr_description.shipped import shipped_urdf

MS, STEP_MS = 1_000_000, 20
BEGIN_NS = 1_000 * MS
SPEED_MPS = 0.5
DEAD_RECKONING, MAPPING = 0, 1
COLLECT, FREEZE = 1, 2
BEAMS = 720
ROOM_M = 4.0


class Imu(NamedTuple):
    angular_velocity: Tuple[float, float, float]
    acceleration: Tuple[float, float, float]


class Wheels(NamedTuple):
    x_m: float
    y_m: float
    heading_rad: float
    linear_mps: float
    angular_radps: float


class Scan(NamedTuple):
    stamp_ns: int
    ranges_m: np.ndarray
    angle_min_rad: float = -0.75 * math.pi
    angle_increment_rad: float = 1.5 * math.pi / (BEAMS - 1)
    time_increment_s: float = 0.0
    scan_time_s: float = 0.04
    range_min_m: float = 0.1
    range_max_m: float = 30.0


@pytest.fixture
def localizer():
    return core.Localizer(shipped_urdf())


def drive(localizer, seconds, noise, begin_ns=BEGIN_NS, speed_mps=0.0):
    """Drive straight; return the estimates, and time and position of the last readings."""
    estimates, x_m, time_ns = [], 0.0, begin_ns
    for _ in range(round(seconds * 1000 / STEP_MS)):
        time_ns += STEP_MS * MS
        x_m += speed_mps * STEP_MS * 1e-3
        shake = tuple(noise.normal(0.0, 0.002, 3))
        force = (*noise.normal(0.0, 0.02, 2), 9.81 + noise.normal(0.0, 0.02))
        estimates += localizer.step(time_ns, Imu(shake, force), Wheels(x_m, 0.0, 0.0, speed_mps, 0.0))
    return estimates, time_ns, x_m


def room(noise, stamp_ns):
    """Return a sweep in the middle of a square room, with sensor noise."""
    angles = -0.75 * math.pi + np.arange(BEAMS) * 1.5 * math.pi / (BEAMS - 1)
    ranges = ROOM_M / np.maximum(np.abs(np.cos(angles)), np.abs(np.sin(angles)))
    return Scan(stamp_ns, (ranges + noise.normal(0.0, 0.01, BEAMS)).astype(np.float32))


def test_pose_is_valid_once_the_gyros_bias_is_known_and_follows_the_wheels(localizer):
    noise = np.random.default_rng(1)
    standing, time_ns, _ = drive(localizer, 3.0, noise)
    assert not standing[0].valid and standing[0].message and standing[0].problems[0][0].startswith("localization.")
    assert standing[-1].valid and standing[-1].problems == [] and standing[-1].stamp_ns == time_ns
    moving, time_ns, x_m = drive(localizer, 2.0, noise, time_ns, SPEED_MPS)
    assert moving[-1].x_m == pytest.approx(x_m, abs=0.02) and moving[-1].y_m == pytest.approx(0.0, abs=0.02)
    assert moving[-1].mode == DEAD_RECKONING and moving[-1].map_revision == 0
    assert np.reshape(moving[-1].covariance, (3, 3))[0, 0] > np.reshape(standing[-1].covariance, (3, 3))[0, 0]


def test_silent_wheels_are_told(localizer):
    told, = localizer.check_silence(BEGIN_NS)
    assert not told.valid and told.message and told.stamp_ns == BEGIN_NS
    _, time_ns, _ = drive(localizer, 3.0, np.random.default_rng(2))
    assert localizer.check_silence(time_ns + 100 * MS) == []
    silent, = localizer.check_silence(time_ns + 1000 * MS)
    assert not silent.valid and silent.message


def test_scan_that_comes_twice_is_refused_with_a_sentence(localizer):
    scan = room(np.random.default_rng(3), BEGIN_NS)
    assert localizer.add_scan(False, scan) == ""
    assert "not newer" in localizer.add_scan(False, scan)
    assert localizer.add_scan(True, room(np.random.default_rng(4), BEGIN_NS)) == ""


def test_order_to_map_begins_a_map(localizer):
    noise = np.random.default_rng(5)
    _, time_ns, _ = drive(localizer, 3.0, noise)
    localizer.add_order(time_ns, 7, COLLECT)
    for number in range(10):
        localizer.add_scan(False, room(noise, time_ns + number * 40 * MS))
        localizer.add_scan(True, room(noise, time_ns + number * 40 * MS))
        estimates, _, _ = drive(localizer, 0.04, noise, time_ns + number * 40 * MS)
    assert estimates[-1].mode == MAPPING and localizer.take_map() is None


def test_unknown_description_is_refused():
    with pytest.raises(RuntimeError):
        core.Localizer("<robot name='nothing'><link name='base_link'/></robot>")
