"""The simulated sensors measure their environment with the errors of their parameters."""
# SPDX-License-Identifier: Apache-2.0
import dataclasses
import math

import numpy as np
import pytest

from mtr_core.schedule import LIDAR, SIMULATION_START_NS
from mtr_core.se2 import Pose2
from mtr_simulation.physics.robot import shipped_robot
from mtr_simulation.runner import run
from mtr_simulation.sensors.imu import ImuParameters
from mtr_simulation.sensors.lidar import LidarParameters
from mtr_simulation.sim import Sim, SimParameters
from mtr_simulation.site.car_shape import CarShape
from mtr_simulation.site.scenario import Scenario, named_scenario
from mtr_simulation.site.surroundings import Pole, Walk

ROBOT = shipped_robot()
NO_NOISE = SimParameters(lidar=LidarParameters(noise_m=0.0), imu=ImuParameters(0.0, 0.0, 0.0, 0.0, 0.0, 0.0))
# At the Car's left side, facing the Car.
BESIDE = Scenario(start_in_car=Pose2(0.0, 2.3, -math.pi / 2.0), start_offset_m=0.0, start_offset_rad=0.0)


class Constant:
    """Controller that always commands the same velocity."""

    def __init__(self, linear_mps=0.0, angular_radps=0.0):
        self._command = linear_mps, angular_radps

    def update(self, sensors):
        """The constant command."""
        return self._command


def first_scans(sim):
    """Sensors of the tick at which the first sweeps are complete."""
    sim.step()
    return sim.step()


def points(scan, mount, base):
    """Finite returns as points, for a stationary robot at base."""
    x, yaw = mount
    lidar = base @ Pose2(x, 0.0, yaw)
    angles = scan.angle_min_rad + scan.angle_increment_rad * np.arange(len(scan.ranges_m)) + lidar.heading
    seen = np.isfinite(scan.ranges_m)
    ranges = scan.ranges_m[seen]
    return np.stack([lidar.x + ranges * np.cos(angles[seen]), lidar.y + ranges * np.sin(angles[seen])], axis=1)


def front_points_in_car(scenario):
    sim = Sim(1, scenario, NO_NOISE)
    scan = first_scans(sim).front_scan
    return points(scan, (ROBOT.front_lidar.x_m, 0.0), sim.truth().car_from_base)


def test_lidar_sees_the_side_of_the_car_where_it_is():
    seen = front_points_in_car(BESIDE)
    sill = seen[np.abs(seen[:, 0]) < 0.8]
    assert np.allclose(sill[:, 1], 0.88, atol=0.01)


def test_lidar_sees_a_gap_between_sill_and_tyre():
    along = np.abs(front_points_in_car(BESIDE)[:, 0])
    assert not np.any((along > 0.935) & (along < 0.995))
    assert np.any((along > 1.0) & (along < 1.6))


def test_lidar_sees_a_tyre_s_tread_inside_the_arch():
    seen = front_points_in_car(BESIDE)
    tread = seen[np.abs(np.abs(seen[:, 0]) - 1.005) < 0.01]
    assert len(tread) > 2
    assert np.all(tread[:, 1] < 0.88)


def test_lidar_sees_the_bumper_at_the_car_s_full_length():
    ahead = dataclasses.replace(BESIDE, start_in_car=Pose2(4.0, 0.0, math.pi))
    seen = front_points_in_car(ahead)
    assert np.max(seen[:, 0]) == pytest.approx(2.25, abs=0.01)


def test_lidar_sees_beneath_a_car_with_high_clearance():
    high = dataclasses.replace(BESIDE, car=CarShape(clearance_m=0.34))
    seen = front_points_in_car(high)
    assert len(seen[np.abs(seen[:, 0]) < 0.9]) == 0
    assert len(seen[np.abs(seen[:, 0]) > 1.0]) > 0


def test_rear_lidar_sees_what_is_behind():
    turned = dataclasses.replace(BESIDE, start_in_car=Pose2(0.0, 2.3, math.pi / 2.0))
    sim = Sim(1, turned, NO_NOISE)
    scan = first_scans(sim).rear_scan
    seen = points(scan, (ROBOT.rear_lidar.x_m, ROBOT.rear_lidar.yaw_rad), sim.truth().car_from_base)
    assert np.allclose(seen[np.abs(seen[:, 0]) < 0.8][:, 1], 0.88, atol=0.01)


def test_rear_lidar_that_is_switched_off_says_nothing():
    sim = Sim(1, BESIDE, SimParameters(rear_lidar=False))
    assert all(sim.step().rear_scan is None for _ in range(6))


def test_scan_is_stamped_with_its_first_beam_and_given_when_complete():
    sim = Sim(1, BESIDE)
    sensors = [sim.step() for _ in range(6)]
    given = [(each.time_ns, each.front_scan.stamp_ns) for each in sensors if each.front_scan]
    period = LIDAR.period_ns
    assert given == [(SIMULATION_START_NS + n * period, SIMULATION_START_NS + (n - 1) * period) for n in (1, 2, 3)]


def test_scan_is_given_only_when_its_whole_sweep_was_wanted():
    sim = Sim(1, BESIDE)
    given = []
    for tick in range(1, 11):
        sim.scans_wanted = tick not in (4, 5)
        given.append(sim.step().front_scan is not None)
    assert [tick for tick, was_given in enumerate(given, 1) if was_given] == [2, 8, 10]


def test_unwanted_scans_change_nothing_else():
    always, sometimes = Sim(1, BESIDE), Sim(1, BESIDE)
    for tick in range(40):
        sometimes.scans_wanted = tick >= 20
        expected, seen = always.step(), sometimes.step()
    assert seen.to_bytes() == expected.to_bytes()


def test_casting_ahead_changes_nothing():
    plain, ahead = Sim(1, BESIDE), Sim(1, BESIDE)
    for _ in range(10):
        ahead.cast_ahead()
        expected, seen = plain.step(), ahead.step()
        assert seen.to_bytes() == expected.to_bytes()


def test_beams_take_three_quarters_of_a_turn():
    parameters = LidarParameters()
    assert parameters.time_increment_s * (parameters.beams - 1) == pytest.approx(0.03)


def test_range_noise_is_what_the_parameter_says():
    sim = Sim(1, BESIDE)
    sim.step()
    scans = [scan.ranges_m for scan in (sim.step().front_scan for _ in range(200)) if scan is not None]
    ahead = np.array(scans)[:, 350:370]
    assert np.mean(np.std(ahead, axis=0)) == pytest.approx(0.01, rel=0.15)


def test_nothing_in_range_is_infinity_and_too_near_is_minus_infinity():
    lidar = LidarParameters(noise_m=0.0, range_min_m=1.0, range_max_m=10.0)
    near = dataclasses.replace(BESIDE, start_in_car=Pose2(20.0, 20.0, 0.0))
    pole = near.world_from_car @ near.start_in_car @ Pose2(0.8, 0.0, 0.0)
    with_pole = dataclasses.replace(near, poles=(Pole(pole.x, pole.y),))
    scan = first_scans(Sim(1, with_pole, SimParameters(lidar=lidar))).front_scan
    assert scan.ranges_m[360] == -np.inf
    assert scan.ranges_m[0] == np.inf


def pole_bearing_rad(angular_radps):
    """Bearing error in rad of a pole at the sweep's last beams, relative to its true bearing at the first beam."""
    scenario = Scenario(start_in_car=Pose2(20.0, 0.0, 0.0), start_offset_m=0.0, start_offset_rad=0.0)
    base = scenario.world_from_car @ scenario.start_in_car
    around = tuple(Pole(base.x + 3.0 * math.cos(angle), base.y + 3.0 * math.sin(angle), 0.03)
                   for angle in np.linspace(0.0, 2.0 * math.pi, 60, endpoint=False))
    sim = Sim(1, dataclasses.replace(scenario, poles=around), NO_NOISE)
    for _ in range(76):
        sim.command(0.0, angular_radps)
        sim.step()
    start = sim.truth().world_from_base
    sim.command(0.0, angular_radps)
    sim.step()
    scan = sim.step().front_scan
    seen = points(scan, (ROBOT.front_lidar.x_m, 0.0), start)
    last = seen[-3:].mean(axis=0)
    true = min(around, key=lambda pole: math.hypot(pole.x_m - last[0], pole.y_m - last[1]))
    return (math.atan2(last[1] - start.y, last[0] - start.x) - math.atan2(true.y_m - start.y, true.x_m - start.x))


def test_turning_robot_sees_its_last_beams_turned_against_its_motion():
    assert abs(pole_bearing_rad(0.0)) < 0.01
    # 30 ms at about 1.5 rad/s.
    assert pole_bearing_rad(1.5) == pytest.approx(-0.045, abs=0.012)


def test_gyro_and_accelerometer_agree_with_the_motion():
    sim = Sim(1, dataclasses.replace(BESIDE, start_in_car=Pose2(10.0, 0.0, 0.0)), NO_NOISE)
    for _ in range(150):
        sim.command(0.0, 0.8)
        imu = sim.step().imu
    assert imu.angular_velocity[2] == pytest.approx(sim.truth().angular_radps, abs=1e-4)
    assert imu.acceleration == pytest.approx((0.0, 0.0, 9.81), abs=0.02)


def test_gyro_bias_is_constant_and_small():
    sim = Sim(5, BESIDE)
    rates = [sim.step().imu.angular_velocity[2] for _ in range(500)]
    assert 0.0 < abs(np.mean(rates)) < math.radians(1.0)
    assert np.std(rates) == pytest.approx(math.radians(0.007) * math.sqrt(50.0), rel=0.15)


def test_battery_drains_slowly():
    sim = Sim(1, BESIDE)
    first = sim.step().battery.charge
    for _ in range(50):
        last = sim.step().battery.charge
    assert 0.0 < first - last < 0.001


def test_walking_person_moves_in_the_scan():
    walk = dataclasses.replace(BESIDE, start_in_car=Pose2(20.0, 0.0, 0.0), start_offset_m=0.0)
    base = walk.world_from_car @ walk.start_in_car
    start, end = base.apply(2.0, -0.5), base.apply(2.0, 0.5)
    sim = Sim(1, dataclasses.replace(walk, person=Walk(start, end)), NO_NOISE)
    scans = [scan.ranges_m for scan in (sim.step().front_scan for _ in range(60)) if scan is not None]
    places = {int(np.mean(np.flatnonzero(np.isfinite(ranges)))) for ranges in scans}
    assert max(places) - min(places) > 50


def test_same_seed_gives_the_same_sensor_output():
    digests = {run(Sim(7, named_scenario("lot")), Constant(0.4, 0.2), 2.0).digest for _ in range(2)}
    assert len(digests) == 1


def test_other_seed_gives_other_sensor_output():
    digests = {run(Sim(seed, named_scenario("lot")), Constant(0.4, 0.2), 0.2).digest for seed in (1, 2)}
    assert len(digests) == 2


def test_runner_gives_the_truth_of_each_tick():
    result = run(Sim(1, BESIDE), Constant(), 0.2)
    assert [truth.time_ns for truth in result.truth] == [SIMULATION_START_NS + n * 20_000_000 for n in range(1, 11)]
