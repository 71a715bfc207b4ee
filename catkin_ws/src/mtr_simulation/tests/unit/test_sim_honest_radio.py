"""Radio effects of the honest Car: nulls, fading in space, noise in time, antenna and battery of the key."""
# SPDX-License-Identifier: Apache-2.0
import math

import numpy as np
import pytest

from mtr_simulation.car.honest.parameters import KeyParameters, UhfParameters
from mtr_simulation.car.honest.radio.battery import battery_gain_db
from mtr_simulation.car.honest.radio.key_antenna import Attitude, loop_axis, pattern_db
from mtr_simulation.car.honest.radio.lf_field import LfField
from mtr_simulation.car.honest.radio.plane_waves import fading, shadowing
from mtr_simulation.car.honest.radio.time_noise import TimeNoise
from mtr_simulation.car.honest.radio.two_ray import reflection, two_ray_gain_db, wavelength_m
from mtr_simulation.car.honest.radio.uhf_link import UhfLink
from mtr_simulation.car.parameters import DEFAULT_ANTENNAS, PassiveEntryParameters
from mtr_simulation.car.radio import PassiveEntryRadio

KEY_M, RECEIVER_M = 1.0, 1.15
STEP_NS = 20_000_000


def rays_db(distances_m, frequency_mhz):
    """Gain of two rays between key and Receiver at the heights of the issue."""
    heights = (np.full(len(distances_m), KEY_M), RECEIVER_M)
    return two_ray_gain_db(distances_m, heights, wavelength_m(frequency_mhz), 5.0)


@pytest.mark.parametrize(("frequency_mhz", "nulls_m"), [(868.0, (6.7, 3.3)), (434.0, (3.3, 1.7))])
def test_ground_bounce_puts_nulls_inside_the_range(frequency_mhz, nulls_m):
    distances_m = np.arange(1.4, 12.0, 0.01)
    gain_db = rays_db(distances_m, frequency_mhz)
    inner = gain_db[1:-1]
    minima_m = distances_m[1:-1][(inner < gain_db[:-2]) & (inner < gain_db[2:])]
    assert sorted(minima_m, reverse=True)[:2] == pytest.approx(nulls_m, abs=0.1)
    for null_m in nulls_m:
        assert gain_db[np.argmin(abs(distances_m - null_m))] < -4.5


def test_far_beyond_the_last_null_the_power_falls_with_the_fourth_power_of_the_distance():
    near_db, far_db = rays_db(np.array([300.0, 600.0]), 434.0) - 20.0 * np.log10([300.0, 600.0])
    assert near_db - far_db == pytest.approx(12.0, abs=0.5)


def test_ground_reflects_with_turned_sign_and_whole_where_the_wave_grazes_it():
    assert reflection(np.array([0.0]), 5.0)[0] == pytest.approx(-1.0)
    steep = reflection(np.array([math.pi / 2.0]), 5.0)[0]
    assert steep == pytest.approx(-(math.sqrt(5.0) - 1.0) / (math.sqrt(5.0) + 1.0))


def field_of(fields, places):
    """Values of many fields at places, one row per field."""
    return np.array([field.at(places) for field in fields])


@pytest.mark.parametrize(("frequency_mhz", "sigma_db"), [(434.0, 5.0), (434.0, 8.0), (868.0, 6.0)])
@pytest.mark.parametrize("direction", [(1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0), (0.6, 0.48, 0.64)])
def test_fading_has_the_sigma_asked_for_and_is_gone_after_half_a_wavelength(frequency_mhz, sigma_db, direction):
    wave_m = wavelength_m(frequency_mhz)
    lags_m = np.array([0.0, 0.25, 0.5]) * wave_m
    places = np.array([3.0, -2.0, 1.0]) + lags_m[:, None] * np.array(direction)
    values = field_of([fading(seed, "test", sigma_db, wave_m) for seed in range(400)], places)
    assert values.std(axis=0) == pytest.approx(sigma_db, rel=0.12)
    correlation = np.corrcoef(values.T)[0]
    assert correlation[1] == pytest.approx(2.0 / math.pi, abs=0.12)  # sin(pi/2) / (pi/2)
    assert abs(correlation[2]) < 0.17


def test_one_fading_field_has_its_sigma_along_a_long_way_and_is_near_normal():
    places = np.zeros((20_000, 3)) + [0.0, 0.0, 1.0]
    places[:, 0] = np.linspace(0.0, 2000.0, 20_000)
    values = fading(7, "test", 6.0, 0.69).at(places)
    assert values.std() == pytest.approx(6.0, rel=0.05)
    assert (abs(values) > 2.0 * 6.0).mean() == pytest.approx(0.0455, abs=0.012)


def test_shadowing_is_correlated_over_its_length():
    places = np.array([[0.0, 2.0, 1.0], [0.5, 2.0, 1.0], [2.0, 2.0, 1.0]])
    values = field_of([shadowing(seed, "test", 1.0, 0.5) for seed in range(400)], places)
    correlation = np.corrcoef(values.T)[0]
    assert values.std(axis=0) == pytest.approx(1.0, rel=0.12)
    assert correlation[1] == pytest.approx(math.exp(-0.5), abs=0.12)
    assert abs(correlation[2]) < 0.17


def test_fields_of_one_seed_are_the_same_and_of_another_different():
    place = np.array([1.0, 2.0, 1.0])
    assert fading(1, "uhf", 6.0, 0.69).at(place) == fading(1, "uhf", 6.0, 0.69).at(place)
    assert fading(1, "uhf", 6.0, 0.69).at(place) != fading(2, "uhf", 6.0, 0.69).at(place)


def noise_course(sigma_db, correlation_s, steps, seed=1):
    """Values of the noise in time, one per step."""
    noise, values = TimeNoise(seed, sigma_db, correlation_s), []
    for step in range(steps):
        noise.step(step * STEP_NS)
        values.append(noise.now_db)
    return np.array(values)


@pytest.mark.parametrize("sigma_db", [1.0, 3.0])
def test_noise_in_time_has_the_sigma_and_the_correlation_asked_for(sigma_db):
    values = noise_course(sigma_db, 0.1, 20_000)
    assert values.std() == pytest.approx(sigma_db, rel=0.05)
    assert np.corrcoef(values[:-5], values[5:])[0, 1] == pytest.approx(math.exp(-1.0), abs=0.05)


def test_noise_in_time_does_not_depend_on_who_looks():
    first, second = TimeNoise(3, 2.0, 0.3), TimeNoise(3, 2.0, 0.3)
    for step in range(50):
        first.step(step * STEP_NS)
        second.step(step * STEP_NS)
        assert [first.now_db for _ in range(step % 3)] in ([], [first.now_db], [first.now_db] * 2)
    assert first.now_db == second.now_db


def test_key_antenna_is_deaf_along_its_axis_and_the_attitude_turns_it():
    axis, east = loop_axis(0.0, 0.0), np.array([5.0, 0.0, 0.0])
    assert pattern_db(axis, Attitude(), east, -12.0) == pytest.approx(-12.0)
    assert pattern_db(axis, Attitude(yaw_rad=math.pi / 2.0), east, -12.0) == pytest.approx(0.0)
    assert pattern_db(axis, Attitude(pitch_rad=math.pi / 2.0), east, -12.0) == pytest.approx(0.0)
    assert pattern_db(axis, Attitude(yaw_rad=math.pi / 4.0), east, -40.0) == pytest.approx(-3.0, abs=0.05)
    assert pattern_db(axis, Attitude(roll_rad=1.0), east, -12.0) == pytest.approx(-12.0)


def test_battery_lowers_the_power_with_the_square_of_its_voltage_until_there_is_silence():
    assert battery_gain_db(3.0, 2.1) == 0.0
    assert battery_gain_db(2.4, 2.1) == pytest.approx(-1.94, abs=0.01)
    assert battery_gain_db(2.0, 2.1) == -math.inf


def test_link_budget_is_the_sum_of_its_parts():
    place = np.array([[3.8, 0.1, 1.0]])
    base = UhfLink(1, UhfParameters(), KeyParameters())
    weak = UhfLink(1, UhfParameters(margin_at_1m_db=40.0), KeyParameters(battery_v=2.4))
    assert base.margin_db(place) - weak.margin_db(place) == pytest.approx(4.0 + 1.94, abs=0.01)
    calm = UhfLink(1, UhfParameters(fading_sigma_db=0.0), KeyParameters())
    assert calm.margin_db(place) == pytest.approx(base.mean_margin_db(place))
    assert base.margin_db(place) != pytest.approx(base.mean_margin_db(place), abs=1e-3)


def test_low_frequency_field_is_the_dipole_of_the_gentle_car():
    places = np.array([[0.0, 2.0, 1.0], [-3.0, 0.5, 0.8], [2.5, -1.0, 1.2]])
    gentle = PassiveEntryRadio(1, PassiveEntryParameters(shadow_sigma_db=0.0), 0.5)
    honest = LfField(1, DEFAULT_ANTENNAS, 0.0, 0.5)
    assert honest.strength_db(places) == pytest.approx([gentle.strength_db(tuple(place)) for place in places.tolist()])
    assert honest.strength_db(places[0]) == pytest.approx(honest.strength_db(places)[0])
    for antenna in DEFAULT_ANTENNAS:
        alone = LfField(1, [antenna], 0.0, 0.5).strength_db(places)
        assert alone.shape == (3,) and (alone <= honest.strength_db(places)).all()
