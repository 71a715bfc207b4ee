"""LiDAR errors beyond white noise follow their parameters and are absent when switched off."""
# SPDX-License-Identifier: Apache-2.0
import dataclasses
import math

import numpy as np
import pytest

from mtr_core.se2 import Pose2
from mtr_simulation.noise import stream
from mtr_simulation.physics.robot import shipped_robot
from mtr_simulation.sensors.lidar import LidarParameters
from mtr_simulation.sensors.scan_errors import EDGE_M, ScanErrors, with_errors
from mtr_simulation.sim import Sim, SimParameters
from mtr_simulation.site.scenario import Scenario

ROBOT = shipped_robot()
LIDAR_HEIGHT_M = ROBOT.base_height_m + ROBOT.front_lidar.z_m
BESIDE = Scenario(start_in_car=Pose2(0.0, 2.3, -math.pi / 2.0), start_offset_m=0.0, start_offset_rad=0.0)
FIELD = dataclasses.replace(BESIDE, start_in_car=Pose2(20.0, 0.0, 0.0))
# A near wall of 100 beams between two far walls, then beams without a return.
RANGES = np.concatenate([np.full(300, 8.0), np.full(100, 2.0), np.full(300, 8.0), np.full(100, np.inf)])
EDGES = (299, 399)


def disturbed(**errors):
    return with_errors(RANGES, ScanErrors(**errors), stream(1, "test"))


def scans(count, scenario=BESIDE, **lidar):
    """Front scans of a stationary robot."""
    sim = Sim(1, scenario, SimParameters(rear_lidar=False, lidar=LidarParameters(**lidar)))
    return [sim.step() and sim.step().front_scan for _ in range(count)]


def test_no_errors_change_nothing():
    assert np.array_equal(disturbed(), RANGES)


def test_range_bias_moves_every_return():
    seen = disturbed(range_bias_m=0.02)
    finite = np.isfinite(RANGES)
    assert np.allclose(seen[finite] - RANGES[finite], 0.02)
    assert np.all(np.isinf(seen[~finite]))


@pytest.mark.parametrize("rear, sign", [(False, 1.0), (True, -1.0)])
def test_opposed_bias_moves_the_lidars_apart(rear, sign):
    finite = np.isfinite(RANGES)
    seen = with_errors(RANGES, ScanErrors(opposed_bias_m=0.01), stream(1, "test"), rear)
    assert np.allclose(seen[finite] - RANGES[finite], sign * 0.01)


def test_opposed_bias_reaches_each_lidar():
    plain, opposed = (Sim(1, BESIDE, SimParameters(lidar=LidarParameters(noise_m=0.0, errors=ScanErrors(
        opposed_bias_m=bias_m)))) for bias_m in (0.0, 0.01))
    both = [sim.step() and sim.step() for sim in (plain, opposed)]
    for name, bias_m in (("front_scan", 0.01), ("rear_scan", -0.01)):
        true, seen = (getattr(sensors, name).ranges_m for sensors in both)
        finite = np.isfinite(true) & np.isfinite(seen)
        assert np.count_nonzero(finite) > 20
        assert np.median(seen[finite] - true[finite]) == pytest.approx(bias_m, abs=1e-5)


def test_range_bias_reaches_the_scans():
    plain, biased = (scans(1, noise_m=0.0, errors=ScanErrors(range_bias_m=bias))[0].ranges_m for bias in (0.0, 0.02))
    both = np.isfinite(plain)
    assert np.allclose(biased[both] - plain[both], 0.02, atol=1e-5)


def test_mixed_pixels_lie_between_both_sides_of_an_edge_and_nowhere_else():
    seen = disturbed(mixed_pixel_share=1.0)
    changed = np.flatnonzero(seen != RANGES)
    assert tuple(changed) == EDGES
    assert all(2.0 < seen[edge] < 8.0 for edge in EDGES)
    assert EDGE_M < 6.0


def test_dropouts_see_nothing_in_their_share_of_the_beams():
    seen = np.concatenate([with_errors(RANGES, ScanErrors(dropout_share=0.1), stream(seed, "x")) for seed in range(20)])
    finite = np.isfinite(np.tile(RANGES, 20))
    assert np.mean(np.isinf(seen[finite])) == pytest.approx(0.1, abs=0.01)


def test_drops_of_rain_come_in_their_share_and_hide_nothing_nearer():
    noise = stream(1, "rain")
    seen = np.stack([with_errors(RANGES, ScanErrors(echo_share=0.05), noise) for _ in range(50)])
    changed = seen != RANGES
    assert np.mean(changed[:, -100:]) == pytest.approx(0.05, abs=0.01)
    assert np.all(seen <= RANGES)


def test_drops_of_rain_are_elsewhere_in_the_next_sweep():
    noise = stream(1, "rain")
    first, second = (with_errors(RANGES, ScanErrors(echo_share=0.05), noise) != RANGES for _ in range(2))
    assert np.any(first)
    assert np.mean(first & second) < 0.5 * np.mean(first)


def test_lidar_that_looks_down_sees_the_ground_where_its_height_says():
    pitch = math.radians(2.0)
    scan = scans(1, FIELD, noise_m=0.0, pitch_rad=pitch)[0]
    ahead = scan.ranges_m[len(scan.ranges_m) // 2]
    assert ahead == pytest.approx(LIDAR_HEIGHT_M / math.sin(pitch), rel=0.05)
    assert np.isinf(scan.ranges_m[0])


def test_lidar_that_rolls_to_its_left_sees_the_ground_on_its_right():
    scan = scans(1, FIELD, noise_m=0.0, roll_rad=math.radians(2.0))[0]
    quarter = len(scan.ranges_m) // 3
    middle = len(scan.ranges_m) // 2
    assert np.isfinite(scan.ranges_m[middle - quarter])
    assert np.isinf(scan.ranges_m[middle + quarter])
