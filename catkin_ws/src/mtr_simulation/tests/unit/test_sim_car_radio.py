"""Radio of the simulated Car: ranges per direction, thresholds, height, repeatability."""
# SPDX-License-Identifier: Apache-2.0
import math
import statistics

import pytest

from mtr_core.errors import ConfigurationError
from mtr_simulation.car.noise import ShadowField, gaussian
from mtr_simulation.car.parameters import CarParameters, PassiveEntryParameters, RemoteParameters
from mtr_simulation.car.radio import PassiveEntryRadio, RemoteRadio

CAR = CarParameters()
KEY_HEIGHT_M = 1.0
DIAGONAL = math.sqrt(0.5)


def axes():
    """Origin and direction of axes 0.8 m apart on each side, and of axes at the corners."""
    half_length, half_width = 2.25, 0.90
    for offset in (-1.6, -0.8, 0.0, 0.8, 1.6):
        yield (offset, half_width), (0.0, 1.0)
        yield (offset, -half_width), (0.0, -1.0)
    for offset in (-0.8, 0.0, 0.8):
        yield (half_length, offset), (1.0, 0.0)
        yield (-half_length, offset), (-1.0, 0.0)
    for sign_x, sign_y in ((1, 1), (1, -1), (-1, 1), (-1, -1)):
        yield (sign_x * half_length, sign_y * half_width), (sign_x * DIAGONAL, sign_y * DIAGONAL)


def outermost(origin, direction, holds, height_m=KEY_HEIGHT_M):
    """Largest distance along an axis at which holds(key) is true, in steps of 1 cm."""
    for centimetre in range(900, 0, -1):
        distance = centimetre / 100.0
        if holds((origin[0] + distance * direction[0], origin[1] + distance * direction[1], height_m)):
            return distance
    return 0.0


def radials(count):
    """Directions from the Car's centre."""
    return [(math.cos(2.0 * math.pi * k / count), math.sin(2.0 * math.pi * k / count)) for k in range(count)]


@pytest.mark.parametrize("seed", range(5))
def test_unlock_and_lock_distances_lie_in_reach_on_all_axes(seed):
    passive = CAR.passive_entry
    radio = PassiveEntryRadio(seed, passive, CAR.shadow_correlation_m)
    for origin, direction in axes():
        unlock = outermost(origin, direction, lambda key: radio.strength_db(key) > passive.unlock_threshold_db)
        lock = outermost(origin, direction, lambda key: radio.strength_db(key) > passive.lock_threshold_db)
        assert 0.75 < unlock < 2.0
        assert 1.7 < lock < 2.9
        assert lock > unlock + 0.5


def test_unlock_distances_differ_visibly_per_direction():
    passive = CAR.passive_entry
    radio = PassiveEntryRadio(1, passive, CAR.shadow_correlation_m)
    found = [outermost(*axis, lambda key: radio.strength_db(key) > passive.unlock_threshold_db) for axis in axes()]
    assert statistics.stdev(found) > 0.15


@pytest.mark.parametrize("seed", range(5))
def test_press_range_lies_beyond_passive_unlocking_on_all_radials(seed):
    remote = RemoteRadio(seed, CAR.remote, CAR.shadow_correlation_m)
    passive = PassiveEntryRadio(seed, CAR.passive_entry, CAR.shadow_correlation_m)
    for direction in radials(16):
        press = outermost((0.0, 0.0), direction, lambda key: remote.margin_db(key) >= 0.0)
        assert 2.5 < press < 5.6
        assert press > outermost((0.0, 0.0), direction, lambda key: passive.strength_db(key) > 0.0) + 0.3


@pytest.mark.parametrize("height_m", [0.5, 1.4])
def test_press_range_shrinks_below_and_above_the_best_height(height_m):
    remote = RemoteRadio(1, CAR.remote, CAR.shadow_correlation_m)
    for direction in radials(8):
        best = outermost((0.0, 0.0), direction, lambda key: remote.margin_db(key) >= 0.0)
        other = outermost((0.0, 0.0), direction, lambda key: remote.margin_db(key) >= 0.0, height_m)
        assert other < best - 0.2


def test_same_seed_gives_same_strength_and_another_seed_another():
    first, again, other = (PassiveEntryRadio(seed, CAR.passive_entry, 0.5) for seed in (7, 7, 8))
    key = (0.3, 2.0, 1.0)
    assert first.poll_db(key, 42) == again.poll_db(key, 42)
    assert first.poll_db(key, 42) != other.poll_db(key, 42)
    assert first.poll_db(key, 42) != first.poll_db(key, 43)


def test_strength_is_finite_inside_an_antenna():
    antenna = CAR.passive_entry.antennas[0]
    radio = PassiveEntryRadio(1, CAR.passive_entry, 0.5)
    assert math.isfinite(radio.strength_db((antenna.x_m, antenna.y_m, antenna.z_m)))


def test_shadow_field_has_the_sigma_and_the_correlation_asked_for():
    fields = [ShadowField(seed, "test", 1.0, 0.5) for seed in range(400)]
    here = [field.at(1.0, 2.0, 1.0) for field in fields]
    near = [field.at(1.5, 2.0, 1.0) for field in fields]
    assert statistics.pstdev(here) == pytest.approx(1.0, abs=0.1)
    covariance = statistics.fmean(a * b for a, b in zip(here, near))
    assert covariance == pytest.approx(math.exp(-0.5), abs=0.12)


def test_gaussian_has_mean_zero_and_sigma_one():
    values = [gaussian(1, "test", index) for index in range(4000)]
    assert statistics.fmean(values) == pytest.approx(0.0, abs=0.05)
    assert statistics.pstdev(values) == pytest.approx(1.0, abs=0.05)


@pytest.mark.parametrize(
    ("make", "words"),
    [
        (lambda: CarParameters(boot_ms=20_000), ["boot_ms", "20000", "0 to 10000"]),
        (lambda: PassiveEntryParameters(lock_threshold_db=3.0), ["lock_threshold_db", "3"]),
        (lambda: PassiveEntryParameters(antennas=()), ["antennas"]),
        (lambda: RemoteParameters(contact_travel=1.5), ["contact_travel", "1.5", "0 to 1"]),
        (lambda: RemoteParameters(path_loss_exponent=math.nan), ["path_loss_exponent", "nan"]),
    ],
)
def test_parameter_out_of_range_is_refused_with_name_value_and_range(make, words):
    with pytest.raises(ConfigurationError) as error:
        make()
    assert all(word in str(error.value) for word in words)
