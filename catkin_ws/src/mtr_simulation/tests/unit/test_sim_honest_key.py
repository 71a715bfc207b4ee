"""Key of the honest Car: sleep, battery, attitude, and randomly lost presses."""
# SPDX-License-Identifier: Apache-2.0
import numpy as np
import pytest
from honest_bench import DOOR, FAR, LOCK_PRESSED, UNLOCK_PRESSED

from mtr_simulation.car.honest.car import STEP_NS
from mtr_simulation.car.honest.locks import LockState


def test_key_at_rest_falls_asleep_and_a_motion_wakes_it(bench):
    bench = bench(key={"sleep_after_s": 5.0})
    bench.stays(FAR, 6.0)
    assert not bench.car.key.is_awake
    bench.stays(DOOR, 2.0)
    assert bench.car.key.is_awake
    assert bench.car.locks.state is LockState.UNLOCKED
    # The sleeping key at the door does not answer, so the Car treats it as gone.
    assert bench.stays(DOOR, 5.0) is LockState.LOCKED
    assert bench.stays((DOOR[0] + 0.02, *DOOR[1:]), 2.0) is LockState.UNLOCKED


@pytest.mark.parametrize(("buttons_wake", "state"), [(True, LockState.UNLOCKED), (False, LockState.LOCKED)])
def test_buttons_of_a_sleeping_key_work_where_they_wake_it(bench, buttons_wake, state):
    bench = bench(key={"sleep_after_s": 2.0, "buttons_wake": buttons_wake})
    bench.stays(FAR, 3.0)
    assert bench.presses(FAR, UNLOCK_PRESSED) is state
    assert bench.events()[0][0] == "press"


def test_low_battery_shortens_the_range_and_an_empty_one_silences_the_key(bench):
    edge = (0.0, 128.0, 1.0)
    assert bench().presses(edge, UNLOCK_PRESSED) is LockState.UNLOCKED
    assert bench(key={"battery_v": 2.2}).presses(edge, UNLOCK_PRESSED) is LockState.LOCKED
    assert bench(key={"battery_v": 1.8}).presses(DOOR, UNLOCK_PRESSED) is LockState.LOCKED


def test_attitude_of_the_key_decides_at_the_edge_of_the_range(bench):
    bench = bench(key={"pattern_floor_db": -30.0, "axis_azimuth_deg": 0.0, "axis_elevation_deg": 0.0})
    places = {}
    for yaw_rad in (0.0, np.pi / 2.0):
        for _ in range(10):
            bench.car.step(bench.time_ns, (80.0, 0.1, 1.15), UNLOCK_PRESSED, yaw_rad)
            bench.time_ns += STEP_NS
        places[yaw_rad] = bench.stays((80.0, 0.1, 1.15), 1.0)
    assert list(places.values()) == [LockState.LOCKED, LockState.UNLOCKED]


def test_lapses_lose_presses_at_any_place(bench):
    bench = bench(noise={"lapse": 0.5}, passive_entry={"enabled": False})
    lost = 0
    for number in range(60):
        state = bench.presses((0.0, 3.0, 1.0), LOCK_PRESSED if number % 2 else UNLOCK_PRESSED)
        lost += state is not (LockState.LOCKED if number % 2 else LockState.UNLOCKED)
    assert 5 < lost < 45
