"""Distances that a perfect measurement of a line would give: 50 %, 95 % and the static boundary."""
# SPDX-License-Identifier: Apache-2.0
import math

import numpy as np
import pytest

from mtr_simulation.car.can_port import MemoryCanPort
from mtr_simulation.car.choice import chosen_car
from mtr_simulation.car.honest.car import STEP_NS
from mtr_simulation.car.parameters import CarParameters
from mtr_simulation.car.radio import PassiveEntryRadio, RemoteRadio
from mtr_simulation.truth.distance import CarSize, start_and_direction
from mtr_simulation.truth.expected import Line, expected
from mtr_simulation.truth.log import NoTruthLog
from mtr_simulation.truth.monotone import falling, falls_below
from mtr_simulation.truth.results import MeasuredEvent

SIZE = CarSize(4.5, 1.8)
NAN = math.nan


def axis(event="unlock", side="left", origin=(0.4, 0.91), direction=(0.0, 1.0)):
    """An axis of Autolock."""
    return MeasuredEvent("1", event, "ok", NAN, NAN, NAN, side, direction, origin)


def radial(clockwise_deg=0.0):
    """A radial of Key press."""
    return MeasuredEvent("1", "press", "ok", NAN, NAN, NAN, "", (0.0, 0.0), clockwise_rad=math.radians(clockwise_deg))


class Logistic:
    """Car whose reactions depend on one coordinate of the key only, through a logistic function."""

    def press(self, places, attitude):
        return 1.0 / (1.0 + np.exp((places[:, 0] - 5.0) / 0.2))

    def unlock(self, places, attitude):
        return 1.0 / (1.0 + np.exp((places[:, 1] - 0.9 - 1.5) / 0.1))

    def lock(self, places, attitude):
        return 1.0 - 1.0 / (1.0 + np.exp((places[:, 1] - 0.9 - 2.5) / 0.1))

    def unlock_poll(self, places, attitude):
        return 1.0 / (1.0 + np.exp((places[:, 1] - 0.9 - 1.4) / 0.1))

    def lock_poll(self, places, attitude):
        return 1.0 - 1.0 / (1.0 + np.exp((places[:, 1] - 0.9 - 2.6) / 0.1))


def test_falling_curve_is_the_nearest_one_that_never_rises():
    assert falling(np.array([1.0, 0.4, 0.8, 0.1])) == pytest.approx([1.0, 0.6, 0.6, 0.1])
    assert falling(np.array([0.0, 1.0])) == pytest.approx([0.5, 0.5])
    steady = np.linspace(1.0, 0.0, 50)
    assert np.array_equal(falling(steady), steady)
    noisy = np.random.default_rng(1).random(200)
    curve = falling(noisy)
    assert (np.diff(curve) <= 1e-12).all()
    assert curve.sum() == pytest.approx(noisy.sum())


def test_level_is_passed_between_two_steps_or_nowhere():
    distances = np.array([1.0, 2.0, 3.0])
    assert falls_below(distances, np.array([1.0, 0.75, 0.25]), 0.5) == pytest.approx(2.5)
    assert math.isnan(falls_below(distances, np.array([0.4, 0.3, 0.2]), 0.5))
    assert math.isnan(falls_below(distances, np.array([1.0, 0.9, 0.8]), 0.5))


def test_distances_of_a_car_that_falls_steadily_are_those_of_its_curve():
    rise = math.log(19.0)  # from 50 to 95 %
    press = expected(radial(), SIZE, Logistic(), 1.0)
    assert all(math.isnan(each) for each in press[2:])
    assert press[:2] == pytest.approx((5.0, 5.0 - 0.2 * rise), abs=1e-3)
    assert expected(axis(), SIZE, Logistic(), 1.0)[:3] == pytest.approx((1.5, 1.5 - 0.1 * rise, 1.4), abs=1e-3)
    assert expected(axis("lock"), SIZE, Logistic(), 1.0)[:3] == pytest.approx((2.5, 2.5 + 0.1 * rise, 2.6), abs=1e-3)


@pytest.mark.parametrize(("event", "start", "direction"), [
    (axis(), (0.4, 0.9), (0.0, 1.0)),
    (axis(side="rear", origin=(-2.26, -0.3), direction=(-1.0, 0.0)), (-2.25, -0.3), (-1.0, 0.0)),
    (axis(side="front_right", direction=(3.0, -4.0)), (2.25, -0.9), (0.6, -0.8)),
    (radial(90.0), (0.0, 0.0), (0.0, -1.0)),
])
def test_line_starts_at_the_true_car_and_the_key_looks_towards_it(event, start, direction):
    found = start_and_direction(event, SIZE)
    assert found[0] == pytest.approx(start)
    assert found[1] == pytest.approx(direction)
    line = Line(event, SIZE, 1.2)
    assert line.places[0] == pytest.approx([start[0] + 0.1 * direction[0], start[1] + 0.1 * direction[1], 1.2])
    assert math.cos(line.attitude.yaw_rad) == pytest.approx(-direction[0], abs=1e-9)
    assert math.sin(line.attitude.yaw_rad) == pytest.approx(-direction[1], abs=1e-9)


def test_gentle_car_s_distances_are_where_its_radio_crosses_the_thresholds():
    car, model = CarParameters(), chosen_car("gentle").reactions(1)
    passive = PassiveEntryRadio(1, car.passive_entry, car.shadow_correlation_m)
    remote = RemoteRadio(1, car.remote, car.shadow_correlation_m)
    unlock, lock, press = (expected(event, SIZE, model, 1.0) for event in (axis(), axis("lock"), radial()))
    assert passive.strength_db((0.4, 0.9 + unlock.static_m, 1.0)) == pytest.approx(0.0, abs=0.05)
    assert passive.strength_db((0.4, 0.9 + lock.static_m, 1.0)) == pytest.approx(-12.0, abs=0.05)
    assert remote.margin_db((press.p50_distance_m, 0.0, 1.0)) == pytest.approx(0.0, abs=0.05)
    # Many polls within the response time unlock slightly farther out than a single poll does in half of all cases.
    assert 0.0 < unlock.p50_distance_m - unlock.static_m < 0.05
    assert press.p95_distance_m < press.p50_distance_m < press.p95_distance_m + 0.2


def test_honest_car_has_a_range_on_every_line_and_its_transition_is_wide():
    model = chosen_car("honest").reactions(1)
    radials = [expected(radial(45.0 * number), SIZE, model, 1.0) for number in range(8)]
    assert all(1.0 < each.p50_distance_m < 20.0 for each in radials)
    widths = [each.p50_distance_m - each.p95_distance_m for each in radials if not math.isnan(each.p95_distance_m)]
    assert np.median(widths) > 1.0
    for side, origin, direction in (("left", (0.0, 0.9), (0.0, 1.0)), ("rear", (-2.25, 0.0), (-1.0, 0.0))):
        unlock, lock = (expected(axis(event, side, origin, direction), SIZE, model, 1.0)
                        for event in ("unlock", "lock"))
        assert 0.5 < unlock.static_m < lock.static_m < 3.5


class FirstEvent(NoTruthLog):
    """Truth log that stores the key's distance from the left side when the locks moved."""

    def __init__(self):
        self.distance_m = None

    def lock_event(self, event, time_ns, key_xyz):
        self.distance_m = key_xyz[1] - 0.9


def unlocked_at(seed, speed_mps):
    """Distance at which the honest Car unlocks during one approach."""
    log = FirstEvent()
    car = chosen_car("honest").car(seed, MemoryCanPort(), log)
    step = 0
    while log.distance_m is None:
        place = (0.4, 0.9 + 2.8 - step * speed_mps * STEP_NS * 1e-9, 1.0)
        car.step(1_000_000_000 + step * STEP_NS, place, (1000, 1000), -math.pi / 2.0)
        step += 1
    return log.distance_m


def test_passes_at_several_speeds_tend_to_the_static_boundary():
    static_m = expected(axis(), SIZE, chosen_car("honest").reactions(1), 1.0).static_m
    speeds_mps = (0.2, 0.4, 0.8)
    means_m = [np.mean([unlocked_at(seed, speed_mps) for seed in range(30)]) for speed_mps in speeds_mps]
    slope_s, intercept_m = np.polyfit(speeds_mps, means_m, 1)
    assert intercept_m == pytest.approx(static_m, abs=0.06)
    # Delay: half a poll on average to the first poll in the zone, one poll for the debounce, and the actuator.
    assert -slope_s == pytest.approx(0.15 + 0.3 + 0.1, abs=0.12)
