"""The event-based computation of the honest Car gives the same results as its simulation in steps."""
# SPDX-License-Identifier: Apache-2.0
import dataclasses
import pathlib

import numpy as np
import pytest

from mtr_core.errors import ConfigurationError
from mtr_simulation.car.can_port import MemoryCanPort
from mtr_simulation.car.choice import car_from, chosen_car
from mtr_simulation.car.ecu import Command
from mtr_simulation.car.honest.car import HonestCar
from mtr_simulation.car.honest.frames import ON_CHANGE_NS
from mtr_simulation.car.honest.instants import STEP_NS, HonestInstants
from mtr_simulation.car.honest.locks import Cause, LockState
from mtr_simulation.car.honest.margins import Margins
from mtr_simulation.car.honest.parameters import (
    BusParameters,
    HonestParameters,
    KeyParameters,
    LockParameters,
    NoiseParameters,
    UhfParameters,
)
from mtr_simulation.car.honest.radio.key_antenna import LEVEL
from mtr_simulation.truth.log import TruthLog

START_NS = 1_000_000_000
RELEASED = (1000.0, 1000.0)
CALM = HonestParameters(uhf=UhfParameters(fading_sigma_db=0.0, margin_at_1m_db=80.0),
                        noise=NoiseParameters(sigma_db=0.1, lapse=0.0), locks=LockParameters(relock_s=0.0),
                        key=KeyParameters(sleep_after_s=0.0, pattern_floor_db=0.0))
SPEED_MPS = 0.4
WEAK = pathlib.Path("weak.yaml")


def key_at(time_ns):
    """Key position: from 4 m outside the Car to 0.4 m and out again; y in m from the Car's centre."""
    way_m = SPEED_MPS * (time_ns - START_NS) * 1e-9
    return (0.05, 0.9 + (4.0 - way_m if way_m < 3.6 else way_m - 3.2), 1.0)


def by_steps(tmp_path, parameters, until_ns, seed=3):
    log = TruthLog(tmp_path)
    car, found, before = HonestCar(seed, parameters, MemoryCanPort(), log), [], LockState.LOCKED
    for time_ns in range(START_NS, until_ns, STEP_NS):
        car.step(time_ns, key_at(time_ns), RELEASED)
        if car.locks.is_ready and car.locks.state is not before:
            before = car.locks.state
            found.append((time_ns, before, car.locks.cause))
    return found


def poll(car, time_ns, place):
    at = np.array(place)
    car.poll(time_ns, place, float(car.margins.field_db(at)), lambda: float(car.margins.answer_db(at, LEVEL)))


def by_instants(parameters, until_ns, seed=3):
    car, found = HonestInstants(seed, parameters), []
    for time_ns in [START_NS, *car.polls_ns(START_NS, until_ns)]:
        poll(car, time_ns, key_at(time_ns))
        found += car.pass_time(time_ns)
    return found


@pytest.mark.parametrize("seed", range(3))
def test_a_pass_unlocks_and_locks_at_the_same_steps(tmp_path, seed):
    until_ns = START_NS + 20_000_000_000
    stepped = by_steps(tmp_path, CALM, until_ns, seed)
    assert [state for _, state, _ in stepped] == [LockState.UNLOCKED, LockState.LOCKED]
    assert [moved[:3] for moved in by_instants(CALM, until_ns, seed)] == stepped


def test_the_relock_timer_moves_the_locks_without_a_poll():
    car = HonestInstants(1, dataclasses.replace(CALM, locks=LockParameters(relock_s=5.0)))
    poll(car, START_NS, (0.0, 9.0, 1.0))
    car.pass_time(START_NS + 1_000_000_000)
    assert car.press(START_NS + 1_000_000_000, Command.UNLOCK, (0.0, 3.0, 1.0), LEVEL)
    moved = car.pass_time(START_NS + 10_000_000_000)
    assert [(each.state, each.cause) for each in moved] == [(LockState.UNLOCKED, Cause.KEY_BUTTON),
                                                            (LockState.LOCKED, Cause.RELOCK_TIMER)]
    # 5 s of the relock timer and the actuator's time.
    assert moved[1].time_ns - moved[0].time_ns == 5_100_000_000


def test_a_change_is_told_by_the_next_cyclic_frame_or_at_once():
    cyclic, at_once = (dataclasses.replace(CALM, bus=BusParameters(lock_cycle_ms=200, sent_on_change=on_change))
                       for on_change in (False, True))
    until_ns = START_NS + 20_000_000_000
    for moved in by_instants(cyclic, until_ns):
        assert moved.told_ns - moved.before_ns == 200_000_000
        assert moved.before_ns <= moved.time_ns < moved.told_ns
    assert [each.told_ns - each.time_ns for each in by_instants(at_once, until_ns)] == [ON_CHANGE_NS] * 2


def test_a_sleeping_key_is_not_found_and_its_handle_neither():
    car = HonestInstants(1, dataclasses.replace(CALM, key=KeyParameters(sleep_after_s=2.0, pattern_floor_db=0.0)))
    place = (0.05, 1.2, 1.0)
    for time_ns in (START_NS, START_NS + 400_000_000):
        car.press(time_ns, Command.LOCK, place, LEVEL)
    assert car.take_handle(START_NS + 600_000_000, place, LEVEL)
    assert not car.take_handle(START_NS + 3_000_000_000, place, LEVEL)


def test_a_file_weakens_one_antenna_alone():
    content = {"model": "honest", "profile": "mtr_honest_car", "antennas": {"left_door": {"strength_db": 8.2}}}
    weak, usual = car_from(content, WEAK).honest, chosen_car("honest").honest
    left, right = np.array([0.05, 2.0, 1.0]), np.array([0.05, -2.0, 1.0])
    lost_db = [float(Margins(usual).unlock_db(place, LEVEL) - Margins(weak).unlock_db(place, LEVEL))
               for place in (left, right)]
    assert lost_db == pytest.approx([3.0, 0.0], abs=1e-9)


@pytest.mark.parametrize("antennas, sentence", [
    ({"roof": {"x_m": 0.0}}, "Antenna roof is unknown; allowed are left_door, right_door, boot, front."),
    ({"boot": {"colour": 1.0}}, "Parameter colour of antenna boot is unknown"),
    ({"boot": {"x_m": True}}, "is True; allowed is a number."),
    ({"boot": {"strength_db": 41.0}}, "antennas.boot.strength_db"),
    ({"boot": 3}, "Antenna boot is 3; allowed is a table"), ([1], "Section antennas is")])
def test_a_wrong_antenna_is_a_sentence(antennas, sentence):
    content = {"model": "honest", "profile": "mtr_honest_car", "antennas": antennas}
    with pytest.raises(ConfigurationError, match="Car weak.yaml: .*" + sentence.split(";")[0]) as caught:
        car_from(content, WEAK)
    assert sentence in str(caught.value)


@pytest.mark.parametrize("car", ["honest", "honest_868", "honest_slow"])
def test_the_next_poll_is_the_first_of_the_next_ones(car):
    instants = HonestInstants(5, chosen_car(car).honest)
    first_ns, *others_ns = instants.next_polls_ns(START_NS, 40)
    for time_ns in (START_NS, first_ns - 1, first_ns, first_ns + STEP_NS, others_ns[3] - 1, others_ns[3]):
        later_ns = min(each for each in (first_ns, *others_ns) if each > time_ns)
        assert instants.next_poll_ns(time_ns) == later_ns == instants.next_polls_ns(time_ns, 1)[0]


def test_a_car_without_passive_entry_never_polls():
    silent = dataclasses.replace(CALM.passive_entry, enabled=False)
    instants = HonestInstants(5, dataclasses.replace(CALM, passive_entry=silent))
    assert instants.next_poll_ns(START_NS) is None and instants.next_polls_ns(START_NS, 3) == []
