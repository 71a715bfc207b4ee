"""The flashed firmware on an emulated board, in lock-step: where the lift goes, how fast, when not; its calibration."""
# SPDX-License-Identifier: Apache-2.0
import math

import pytest
from conftest import HEIGHT_TOLERANCE_M, running_host
from serial_host import calibrate


def settled(host, height_m, limit_s=12.0):
    """True height after the lift has come to rest; None when it does not within the time."""
    host.height_m = height_m
    host.run(0.2)
    for _ in range(int(limit_s / 0.2)):
        seen = host.run(0.2)
        if host.state.lift_state == 0:
            return seen.lift_m
    return None


@pytest.mark.parametrize("heights_m", [(0.06, 0.061, 0.055), (1.2, 0.0), (0.7, 0.3)])
def test_lift_reaches_heights_within_two_millimetres(host, heights_m):
    for height_m in heights_m:
        assert settled(host, height_m) == pytest.approx(height_m, abs=HEIGHT_TOLERANCE_M)
        assert host.state.lift_height_m == pytest.approx(height_m, abs=HEIGHT_TOLERANCE_M)
        assert host.state.fault == 0


def test_lift_keeps_to_its_speed_and_acceleration(host):
    host.log.clear()
    settled(host, 0.6)
    heights = [seen.lift_m for seen in host.log]
    speeds = [(later - earlier) / 0.01 for earlier, later in zip(heights, heights[1:])]
    assert 0.13 < max(speeds) < 0.175
    assert max(abs(later - earlier) for earlier, later in zip(speeds, speeds[10:])) < 0.06


def test_lift_goes_the_other_way_when_the_height_changes_on_the_way(host):
    host.height_m = 0.8
    host.run(2.0)
    assert settled(host, 0.1) == pytest.approx(0.1, abs=HEIGHT_TOLERANCE_M)


def test_nan_holds_the_lift_still(host):
    host.height_m = 0.8
    before = host.run(2.0)
    host.height_m = math.nan
    held = host.run(1.0)
    assert before.lift_m < held.lift_m < before.lift_m + 0.06
    assert host.run(1.0).lift_m == pytest.approx(held.lift_m, abs=1e-4)


@pytest.mark.parametrize("height_m", [-0.01, 1.21, 1e9, math.inf, -math.inf])
def test_impossible_height_is_refused_without_movement(host, height_m):
    before = host.board.probe().lift_m
    host.height_m = height_m
    assert host.run(1.0).lift_m == before
    assert host.healths[-1].refused_commands >= 8 and host.healths[-1].last_refusal == 1


def test_calibration_finds_the_stops_and_outlives_power_off(mcu, tmp_path):
    options = ["--low-mv", "600", "--high-mv", "4200", "--stroke-m", "0.4", "--eeprom", str(tmp_path / "eeprom")]
    with running_host(mcu, options=options) as host:
        host.height_m = 0.1
        host.run(0.5)
        for _ in range(300):
            host.send(calibrate(1, 0.4, host.latest_us))
            host.run(0.2)
            if host.state.calibration_state != 1:
                break
        assert (host.state.calibration_id, host.state.calibration_state) == (1, 2)
        assert settled(host, 0.25) == pytest.approx(0.25, abs=HEIGHT_TOLERANCE_M)
    with running_host(mcu, options=options) as host:
        assert settled(host, 0.25) == pytest.approx(0.25, abs=HEIGHT_TOLERANCE_M)
        assert (host.healths[-1].calibration_copies, host.healths[-1].stroke_mm) == (2, 400)
        assert host.healths[-1].resets == 2
