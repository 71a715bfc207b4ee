"""Bus of the honest Car: frames that report the state of the locks, their cycle, and their other signals."""
# SPDX-License-Identifier: Apache-2.0
import dataclasses

import numpy as np
import pytest
from honest_bench import DOOR, FAR, LOCK_PRESSED, UNLOCK_PRESSED, Bench, calm

from mtr_simulation.car.honest.frames import ON_CHANGE_NS
from mtr_simulation.car.honest.locks import Cause, LockState
from mtr_simulation.car.honest.parameters import BusParameters


@pytest.mark.parametrize("cycle_ms", [20, 200, 800])
def test_lock_message_comes_in_its_cycle_and_counts(bench, cycle_ms):
    bench = bench(bus={"lock_cycle_ms": cycle_ms})
    bench.stays(FAR, 8.0)
    frames = bench.frames("LockStatus")
    times_ns = np.array([time_ns for time_ns, _ in frames])
    assert (np.diff(times_ns) == cycle_ms * 1_000_000).all()
    assert len(frames) == pytest.approx(8300 / cycle_ms, abs=1.1)
    alive = np.array([signals["AliveCounter"] for _, signals in frames])
    assert (np.diff(alive) % 16 == 1).all()
    assert not bench.frames("LockCauseStatus")


def test_cyclic_message_tells_a_change_up_to_a_cycle_late_and_on_change_at_once(tmp_path):
    for on_change, most_ms in ((False, 800), (True, 3)):
        bench = Bench(tmp_path, calm(bus={"lock_cycle_ms": 800, "sent_on_change": on_change}))
        bench.stays(DOOR, 4.0)
        changed_ns = round(bench.events()[0][1] * 1e9)
        first_ns = next(time_ns for time_ns, signals in bench.frames("LockStatus")
                        if signals["LockState"] == LockState.UNLOCKED)
        assert 0 < first_ns - changed_ns <= most_ms * 1_000_000
        assert (first_ns - changed_ns == ON_CHANGE_NS) is on_change


@pytest.mark.parametrize(("cause_in", "in_lock_message", "in_other"), [
    ("same", Cause.KEY_BUTTON, None), ("other", Cause.NONE, Cause.KEY_BUTTON), ("none", Cause.NONE, None)])
def test_cause_stands_where_the_car_tells_it(bench, cause_in, in_lock_message, in_other):
    bench = bench(bus={"cause_in": cause_in, "cause_cycle_ms": 100})
    bench.presses(FAR, UNLOCK_PRESSED)
    assert bench.frames("LockStatus")[-1][1]["LockCause"] == in_lock_message
    other = bench.frames("LockCauseStatus")
    assert (other[-1][1]["LastLockCause"] if other else None) == in_other


@pytest.mark.parametrize("counts", [True, False])
def test_event_counter_counts_changes_where_there_is_one(bench, counts):
    bench = bench(bus={"event_counter": counts, "lock_cycle_ms": 20})
    bench.presses(FAR, UNLOCK_PRESSED)
    bench.presses(FAR, UNLOCK_PRESSED)
    bench.presses(FAR, LOCK_PRESSED)
    counted = [signals["EventCounter"] for _, signals in bench.frames("LockStatus")]
    assert (counted[0], counted[-1]) == (0, 2 if counts else 0)


def test_frames_split_over_steps_come_in_the_order_of_the_bus(bench):
    bench = bench(bus={"cause_in": "other"})
    bench.stays(FAR, 3.0)
    assert bench.port.frames == sorted(bench.port.frames, key=lambda frame: (frame.time_ns, frame.can_id))


def test_bus_is_never_silent_for_half_a_second(bench):
    bench = bench(bus=dataclasses.asdict(BusParameters(lock_cycle_ms=800)))
    bench.stays(FAR, 3.0)
    assert np.diff([frame.time_ns for frame in bench.port.frames]).max() <= 100_000_000
