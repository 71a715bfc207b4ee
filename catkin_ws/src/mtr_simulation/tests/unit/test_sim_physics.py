"""The simulated robot moves like a skid-steered robot with a mast."""
# SPDX-License-Identifier: Apache-2.0
import dataclasses
import math
import statistics

import pytest

from mtr_core.se2 import Pose2
from mtr_simulation.physics.robot import shipped_robot
from mtr_simulation.physics.wheels import BaseParameters
from mtr_simulation.sim import TICK_S, Sim, SimParameters
from mtr_simulation.site.scenario import Scenario

ROBOT = shipped_robot()
# Far from the Car and without random offset of the start pose.
FIELD = Scenario(start_in_car=Pose2(10.0, 0.0, 0.0), start_offset_m=0.0, start_offset_rad=0.0)
EXACT = BaseParameters(radius_error=0.0)
FOUR_SLIDING_POINTS = 1.0 + (ROBOT.half_wheelbase_m / ROBOT.half_track_m) ** 2


def drive(sim, linear_mps, angular_radps, duration_s):
    """True states and odometry of each tick under a constant command."""
    seen = []
    for _ in range(round(duration_s / TICK_S)):
        sim.command(linear_mps, angular_radps)
        sensors = sim.step()
        seen.append((sim.truth(), sensors.odometry))
    return seen


@pytest.mark.parametrize("timestep_s", [0.002, 0.005])
@pytest.mark.parametrize("rate_radps", [0.3, 1.0])
def test_turning_on_the_spot_needs_the_multiplier_of_four_sliding_points(timestep_s, rate_radps):
    sim = Sim(1, FIELD, SimParameters(timestep_s=timestep_s, base=EXACT))
    seen = drive(sim, 0.0, rate_radps, 3.0)[100:]
    wheels = statistics.mean(odometry.angular_radps for _, odometry in seen) * EXACT.separation_multiplier
    true = statistics.mean(truth.angular_radps for truth, _ in seen)
    assert wheels / true == pytest.approx(FOUR_SLIDING_POINTS, rel=0.01)


def test_tyres_hardly_slip_when_accelerating_at_1_mps2():
    sim = Sim(1, FIELD, SimParameters(base=dataclasses.replace(EXACT, max_linear_mps2=1.0)))
    before, slips = 0.0, []
    for truth, odometry in drive(sim, 1.5, 0.0, 1.5):
        slips.append(abs(odometry.linear_mps - 0.5 * (before + truth.linear_mps)))
        before = truth.linear_mps
    # During the first half second, the robot rocks back on its tyres.
    assert max(slips[25:]) < 0.003


def test_wheels_spin_when_accelerating_beyond_friction():
    sim = Sim(1, FIELD, SimParameters(base=dataclasses.replace(EXACT, max_linear_mps2=8.0)))
    drive(sim, 0.0, 0.0, 0.1)
    truth, odometry = drive(sim, 2.0, 0.0, 0.2)[-1]
    assert odometry.linear_mps > truth.linear_mps + 0.1


def tilt_when_braking_deg(deceleration_mps2, friction):
    base = BaseParameters(max_linear_mps2=deceleration_mps2, max_wheel_torque_nm=20.0)
    sim = Sim(1, dataclasses.replace(FIELD, friction=friction), SimParameters(base=base))
    sim.set_lift(ROBOT.key.lift_travel_m)
    drive(sim, 0.0, 0.0, 4.0)
    drive(sim, 1.5, 0.0, 2.5)
    return math.degrees(max(truth.tilt_rad for truth, _ in drive(sim, 0.0, 0.0, 1.5)))


def test_gentle_braking_with_the_lift_up_hardly_tilts():
    assert tilt_when_braking_deg(1.0, 0.5) < 1.0


def test_hard_braking_with_the_lift_up_lifts_the_wheels():
    assert tilt_when_braking_deg(10.0, 0.8) > 10.0


def test_base_stops_when_no_command_comes():
    sim = Sim(1, FIELD)
    drive(sim, 1.0, 0.0, 2.0)
    for _ in range(round(1.2 / TICK_S)):
        sim.step()
    assert abs(sim.truth().linear_mps) < 0.01


def test_command_that_is_not_finite_is_ignored():
    sim = Sim(1, FIELD)
    drive(sim, 0.0, 0.0, 0.1)
    sim.command(math.nan, 0.0)
    sim.command(0.5, math.inf)
    for _ in range(25):
        sim.step()
    assert abs(sim.truth().linear_mps) < 0.001


def test_robot_at_rest_stays_where_it_is():
    sim = Sim(1, FIELD)
    before = sim.truth().world_from_base
    for _ in range(100):
        sim.step()
    assert sim.truth().world_from_base.distance_to(before) < 1e-4


def test_odometry_is_wrong_by_the_radius_error_on_a_straight_way():
    sim = Sim(1, FIELD, SimParameters(base=BaseParameters(radius_error=0.003)))
    before = sim.truth().world_from_base
    odometry = drive(sim, 0.5, 0.0, 4.0)[-1][1]
    true = sim.truth().world_from_base.distance_to(before)
    assert odometry.x_m / true == pytest.approx(1.003, abs=0.002)


@pytest.mark.parametrize("height_m", [0.0, 0.65, 1.2])
def test_key_is_at_the_height_of_the_lift(height_m):
    sim = Sim(1, FIELD)
    sim.set_lift(height_m)
    for _ in range(150):
        sim.step()
    assert sim.truth().key_in_car[2] == pytest.approx(ROBOT.key.min_height_m + height_m, abs=0.01)


def test_key_is_ahead_of_the_base():
    truth = Sim(1, FIELD).truth()
    expected = truth.car_from_base.apply(ROBOT.key.x_m, 0.0)
    assert truth.key_in_car[:2] == pytest.approx(expected, abs=1e-3)


def test_truth_agrees_between_world_and_car():
    sim = Sim(3, Scenario())
    truth = sim.truth()
    again = sim.scenario.world_from_car @ truth.car_from_base
    assert again.distance_to(truth.world_from_base) < 1e-9


def test_driving_into_the_car_is_a_contact():
    sim = Sim(1, dataclasses.replace(FIELD, start_in_car=Pose2(3.0, 0.0, math.pi)))
    assert sim.contacts() == set()
    drive(sim, 0.5, 0.0, 1.5)
    assert sim.contacts() == {"car"}


def test_start_differs_by_seed_within_its_limits():
    starts = [Scenario().world_from_car.inverse() @ Scenario().start_in_world(seed) for seed in range(20)]
    nominal = Scenario().start_in_car
    assert len({(pose.x, pose.y) for pose in starts}) == 20
    assert all(pose.distance_to(nominal) <= 0.3 for pose in starts)
    assert all(abs(pose.heading - nominal.heading) <= math.radians(5.0) + 1e-9 for pose in starts)
