"""The computed reaction probabilities of the honest Car agree with the frequencies of its simulated reactions."""
# SPDX-License-Identifier: Apache-2.0
import math

import numpy as np
import pytest
from scipy.special import ndtr
from scipy.stats import binom

from mtr_simulation.car.can_port import MemoryCanPort
from mtr_simulation.car.choice import chosen_car
from mtr_simulation.car.honest.car import STEP_NS, HonestCar
from mtr_simulation.car.honest.locks import LockState
from mtr_simulation.car.honest.parameters import (
    HonestParameters,
    KeyParameters,
    LockParameters,
    NoiseParameters,
    PassiveParameters,
)
from mtr_simulation.car.honest.radio.key_antenna import Attitude
from mtr_simulation.car.reaction.debounced import Polling, finds_probability, loses_probability
from mtr_simulation.car.reaction.honest import HonestReactions
from mtr_simulation.truth.log import NoTruthLog

RELEASED, UNLOCK_PRESSED = (1000.0, 1000.0), (1000.0, 2000.0)
AT_THE_DOOR = (0.05, 1.2, 1.0)
# A probability is rejected if it makes the observed count this unlikely. Seeds are fixed, so tests are repeatable.
RARE = 1e-4
LOCKS = LockParameters(boot_ms=0, actuator_ms=0, relock_s=0.0)


def agrees(successes, trials, probability):
    """Whether the count is within the two-sided binomial bounds."""
    low, high = binom.interval(1.0 - RARE, trials, probability)
    return low <= successes <= high


class Trial:
    """A separate Car that differs from the Cars of other trials only in noise and phases."""

    def __init__(self, seed, parameters):
        self.car = HonestCar(seed, parameters, MemoryCanPort(), NoTruthLog())
        self.time_ns = 1_000_000_000

    def stays(self, key_xyz, steps, servo_us=RELEASED, yaw_rad=0.0):
        """Keep the key at one place for some steps and return the resulting state of the locks."""
        for _ in range(steps):
            self.car.step(self.time_ns, key_xyz, servo_us, yaw_rad)
            self.time_ns += STEP_NS
        return self.car.locks.state


def places_on_a_radial(first_m, last_m, count, angle_rad):
    """Positions x, y, z along a radial at the key's height."""
    distances_m = np.linspace(first_m, last_m, count)
    return np.stack([distances_m * math.cos(angle_rad), distances_m * math.sin(angle_rad), np.ones(count)], axis=-1)


@pytest.mark.parametrize(("angle_rad", "yaw_rad"), [(0.3, 3.4), (2.0, -1.1)])
def test_press_works_as_often_as_computed_at_many_places(angle_rad, yaw_rad):
    parameters = HonestParameters(locks=LOCKS, noise=NoiseParameters(sigma_db=3.0, lapse=0.05),
                                  passive_entry=PassiveParameters(enabled=False))
    places = places_on_a_radial(2.5, 12.0, 14, angle_rad)
    computed = HonestReactions(parameters).press(places, Attitude(yaw_rad))
    assert ((computed > 0.05) & (computed < 0.9)).sum() >= 4
    for place, probability in zip(places.tolist(), computed):
        trials = [Trial(seed, parameters) for seed in range(120)]
        worked = sum(trial.stays(tuple(place), 6, UNLOCK_PRESSED, yaw_rad) is LockState.UNLOCKED for trial in trials)
        assert agrees(worked, 120, probability), (place, worked / 120, probability)


CORRELATED = NoiseParameters(sigma_db=2.0, correlation_s=0.3, lapse=0.05)


@pytest.mark.parametrize(("poll_period_ms", "debounce", "response_s"), [(300, 2, 1.5), (100, 3, 1.0), (700, 1, 1.0)])
def test_passive_entry_unlocks_as_often_as_computed_at_many_places(poll_period_ms, debounce, response_s):
    passive = PassiveParameters(poll_period_ms=poll_period_ms, debounce_polls=debounce, response_s=response_s)
    parameters = HonestParameters(locks=LOCKS, noise=CORRELATED, passive_entry=passive)
    places = places_on_a_radial(2.2, 2.6, 6, math.pi / 2.0)
    computed = HonestReactions(parameters).unlock(places, Attitude())
    assert ((computed > 0.05) & (computed < 0.95)).sum() >= 3
    for place, probability in zip(places.tolist(), computed):
        unlocked = sum(_unlocks(seed, parameters, tuple(place)) for seed in range(60))
        assert agrees(unlocked, 60, probability), (place, unlocked / 60, probability)


def _unlocks(seed, parameters, place):
    trial = Trial(seed, parameters)
    steps = round(parameters.passive_entry.response_s * 1e9 / STEP_NS)
    # Two extra steps: the first step only starts the polls, and the last one lets the locks move.
    return trial.stays(place, steps + 2) is LockState.UNLOCKED


def test_passive_entry_locks_as_often_as_computed_at_many_places():
    parameters = HonestParameters(locks=LOCKS, noise=CORRELATED, passive_entry=PassiveParameters(response_s=1.5))
    places = places_on_a_radial(3.0, 3.4, 6, math.pi / 2.0)
    computed = HonestReactions(parameters).lock(places, Attitude())
    assert ((computed > 0.05) & (computed < 0.95)).sum() >= 3
    for place, probability in zip(places.tolist(), computed):
        locked = sum(_locks(seed, parameters, tuple(place)) for seed in range(60))
        assert agrees(locked, 60, probability), (place, locked / 60, probability)


def _locks(seed, parameters, place):
    trial = Trial(seed, parameters)
    while trial.stays(AT_THE_DOOR, 1) is not LockState.UNLOCKED:
        pass
    # The key leaves at any moment between two polls, not immediately after the poll that unlocked.
    trial.stays(AT_THE_DOOR, seed % 15)
    return trial.stays(place, round(1.5e9 / STEP_NS) + 1) is LockState.LOCKED


def test_handle_request_unlocks_as_often_as_computed():
    passive = PassiveParameters(unlock_on="handle")
    parameters = HonestParameters(locks=LOCKS, noise=CORRELATED, passive_entry=passive)
    places = places_on_a_radial(2.0, 3.0, 6, math.pi / 2.0)
    for place, probability in zip(places.tolist(), HonestReactions(parameters).unlock(places, Attitude())):
        unlocked = 0
        for seed in range(120):
            trial = Trial(seed, parameters)
            trial.stays(tuple(place), 5)
            trial.car.request_handle()
            unlocked += trial.stays(tuple(place), 2) is LockState.UNLOCKED
        assert agrees(unlocked, 120, probability), (place, unlocked / 120, probability)


def sampled(margin_sigmas, polling, polls, trials=20_000):
    """Monte Carlo frequency of enough agreeing polls in a row."""
    generator = np.random.default_rng(5)
    noise, row = generator.normal(size=trials), np.zeros(trials)
    done = np.zeros(trials, dtype=bool)
    for _ in range(polls):
        agree = (noise + margin_sigmas >= 0.0) & (generator.random(trials) >= polling.lapse)
        row = np.where(agree, row + 1, 0)
        done |= row >= polling.debounce
        noise = polling.correlation * noise + math.sqrt(1.0 - polling.correlation**2) * generator.normal(size=trials)
    return done.mean()


@pytest.mark.parametrize("polling",
                         [Polling(10.0, 2, 0.37, 0.02), Polling(30.0, 3, 0.95, 0.1), Polling(4.0, 1, 0.0, 0.0)])
@pytest.mark.parametrize("margin_sigmas", [-1.95, -0.45, 0.0, 1.05])
def test_debounced_probability_is_the_frequency_of_agreeing_polls(polling, margin_sigmas):
    computed = finds_probability(np.array([margin_sigmas]), 1.0, polling)[0]
    assert sampled(margin_sigmas, polling, int(polling.polls)) == pytest.approx(computed, abs=0.015)


def test_a_single_poll_without_lapse_is_the_normal_distribution():
    margins = np.linspace(-3.0, 3.0, 25)
    polling = Polling(1.0, 1, 0.5, 0.0)
    assert finds_probability(margins, 1.0, polling) == pytest.approx(ndtr(margins), abs=2e-3)
    assert loses_probability(margins, 1.0, polling) == pytest.approx(1.0 - ndtr(margins), abs=2e-3)


def test_half_a_poll_more_is_the_mean_of_both_counts():
    margins = np.array([-0.5])
    two, between, three = (finds_probability(margins, 1.0, Polling(polls, 2, 0.3, 0.0))[0] for polls in (2.0, 2.5, 3.0))
    assert between == pytest.approx((two + three) / 2.0)


def test_silent_battery_has_the_probability_zero():
    model = HonestReactions(HonestParameters(key=KeyParameters(battery_v=1.8)))
    place = np.array([[0.0, 1.2, 1.0]])
    assert model.press(place, Attitude())[0] == model.unlock(place, Attitude())[0] == 0.0
    assert model.lock(place, Attitude())[0] == pytest.approx(1.0)


def test_without_passive_entry_or_walk_away_or_with_a_second_key_there_is_no_such_reaction():
    place = np.array([[0.0, 9.0, 1.0]])
    for parameters in (HonestParameters(passive_entry=PassiveParameters(enabled=False)),
                       HonestParameters(passive_entry=PassiveParameters(walk_away="off")),
                       HonestParameters(locks=LockParameters(second_key_inside=True))):
        assert HonestReactions(parameters).lock(place, Attitude())[0] == 0.0
    assert HonestReactions(HonestParameters()).lock(place, Attitude())[0] == pytest.approx(1.0)


def test_fading_stays_where_it_is_whatever_the_simulation_s_seed():
    places = places_on_a_radial(3.0, 9.0, 20, 0.5)
    for name, stays in (("honest", True), ("gentle", False)):
        first, second = (chosen_car(name).reactions(seed).press(places, Attitude()) for seed in (1, 2))
        assert np.array_equal(first, second) is stays
