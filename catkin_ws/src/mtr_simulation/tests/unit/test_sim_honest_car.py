"""Locks of the honest Car: passive entry, walk-away lock, timers, and the doors that a press opens."""
# SPDX-License-Identifier: Apache-2.0
import numpy as np
import pytest
from honest_bench import BESIDE, DOOR, FAR, LOCK_PRESSED, UNLOCK_PRESSED, Bench, calm

from mtr_simulation.car.honest.locks import Cause, LockState


def test_car_is_unknown_while_it_boots_then_locked(tmp_path):
    bench = Bench(tmp_path, calm(locks={"boot_ms": 1000}))
    assert bench.car.locks.state is LockState.UNKNOWN
    assert bench.stays(FAR, 1.0) is LockState.LOCKED
    assert bench.frames("LockStatus")[0][1]["LockState"] == LockState.UNKNOWN


def test_approach_unlocks_and_walking_away_locks_with_their_cause(bench):
    bench = bench()
    assert bench.stays(DOOR, 2.0) is LockState.UNLOCKED
    assert bench.stays(BESIDE, 2.0) is LockState.UNLOCKED  # no reaction between the two zones
    assert bench.stays(FAR, 2.0) is LockState.LOCKED
    assert [kind for kind, _ in bench.events()] == ["unlocked", "locked"]
    assert bench.car.locks.cause is Cause.PASSIVE_ENTRY


@pytest.mark.parametrize(("period_ms", "debounce"), [(100, 1), (300, 2), (700, 1), (700, 3)])
def test_reaction_comes_evenly_within_one_poll_after_the_debounce(tmp_path, period_ms, debounce):
    passive = {"poll_period_ms": period_ms, "debounce_polls": debounce, "response_s": 5.0}
    parameters = calm(passive_entry=passive, locks={"actuator_ms": 0})
    delays_s = []
    for seed in range(150):
        bench = Bench(tmp_path, parameters, seed)
        arrival_s = bench.time_ns * 1e-9
        while bench.car.locks.state is LockState.LOCKED:
            bench.stays(DOOR, 0.02)
        delays_s.append(bench.events()[0][1] - arrival_s)
    # Delays are uniform over debounce - 1 to debounce periods; key and locks are updated at ticks of 20 ms.
    first_s, last_s = (debounce - 1) * period_ms * 1e-3, debounce * period_ms * 1e-3
    assert first_s - 0.021 <= min(delays_s) and max(delays_s) <= last_s + 0.041
    assert np.mean(delays_s) == pytest.approx((first_s + last_s) / 2.0, abs=0.021 + 0.1 * period_ms * 1e-3)
    assert np.std(delays_s) == pytest.approx(period_ms * 1e-3 / np.sqrt(12.0), rel=0.2)


def test_motors_take_their_time(tmp_path):
    times_s = []
    for actuator_ms in (0, 400):
        bench = Bench(tmp_path, calm(locks={"actuator_ms": actuator_ms}))
        bench.stays(DOOR, 2.0)
        times_s.append(bench.events()[0][1])
    assert times_s[1] - times_s[0] == pytest.approx(0.38, abs=0.021)


def test_walk_away_by_delay_locks_so_long_after_the_unlock_zone_was_left(bench):
    bench = bench(passive_entry={"walk_away": "delay", "walk_away_delay_s": 3.0})
    bench.stays(DOOR, 2.0)
    left_s = bench.time_ns * 1e-9
    assert bench.stays(BESIDE, 3.0) is LockState.UNLOCKED
    assert bench.stays(BESIDE, 1.5) is LockState.LOCKED
    assert 3.2 < bench.events()[-1][1] - left_s < 4.2


def test_walk_away_by_delay_is_given_up_when_the_key_comes_back(bench):
    bench = bench(passive_entry={"walk_away": "delay", "walk_away_delay_s": 3.0})
    bench.stays(DOOR, 2.0)
    bench.stays(BESIDE, 2.0)
    assert bench.stays(DOOR, 6.0) is LockState.UNLOCKED
    assert len(bench.events()) == 1


def test_walk_away_off_leaves_the_car_unlocked(bench):
    bench = bench(passive_entry={"walk_away": "off"})
    bench.stays(DOOR, 2.0)
    assert bench.stays(FAR, 5.0) is LockState.UNLOCKED


def test_relock_timer_locks_a_car_that_nobody_opened(bench):
    bench = bench(locks={"relock_s": 10.0})
    bench.presses(FAR, UNLOCK_PRESSED)
    assert bench.car.locks.state is LockState.UNLOCKED
    assert bench.stays(FAR, 11.0) is LockState.LOCKED
    assert bench.car.locks.cause is Cause.RELOCK_TIMER
    (_, unlocked_s), (_, locked_s) = [event for event in bench.events() if event[0] != "press"]
    assert locked_s - unlocked_s == pytest.approx(10.1, abs=0.03)


def test_second_key_inside_forbids_what_the_car_wants_but_not_the_button(bench):
    bench = bench(locks={"second_key_inside": True, "relock_s": 5.0})
    bench.stays(DOOR, 2.0)
    assert bench.stays(FAR, 8.0) is LockState.UNLOCKED
    assert bench.presses(FAR, LOCK_PRESSED) is LockState.LOCKED


def test_drivers_door_alone_at_the_first_press_and_all_at_the_second(bench):
    bench = bench(locks={"unlock_doors": "driver"})
    assert bench.presses(FAR, UNLOCK_PRESSED) is LockState.DRIVER_UNLOCKED
    assert bench.presses(FAR, UNLOCK_PRESSED) is LockState.UNLOCKED
    assert bench.presses(FAR, LOCK_PRESSED) is LockState.LOCKED
    assert [kind for kind, _ in bench.events()] == ["press", "unlocked", "press", "press", "locked"]
