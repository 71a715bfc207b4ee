"""An adapter on the robot's own simulated clock: frames and Statuses count in the order of their stamps."""
# SPDX-License-Identifier: Apache-2.0
import gc
import random
import tracemalloc

import pytest

from mtr_operator.car_link.can_frame import CanFrame
from mtr_operator.car_link.clocks.frame_time import FrameTime
from mtr_operator.car_link.clocks.ordered_map import OrderedClockMap, minutes_between
from mtr_operator.car_link.lock_watch import LockWatch
from mtr_operator.car_link.profile import load_profile
from mtr_operator.domain.robot_status import RobotStatus

LOCK_ID = 0x411
MINUTE_S = 60.0
FRAMES_S = 0.02
STATUS_S = 0.1
# On a busy machine a reading thread is so late, or a simulator so far ahead, in s of simulated time.
MOST_LATE_S = 0.15


def arrivals(seed, duration_s=60.0, late_s=MOST_LATE_S, begin_s=75.0):
    """(time of arrival, stamp in s, is it a frame) of a simulation, in the order in which they are read."""
    chance = random.Random(seed)
    # Lateness lasts, as a machine is busy for a while.
    phases = [chance.uniform(0.0, late_s) for _ in range(20)]

    def late(time_s, of):
        return phases[int(time_s + of) % len(phases)] * chance.random()
    frames = [begin_s + 0.01025 + FRAMES_S * number for number in range(round(duration_s / FRAMES_S))]
    stamps = [begin_s + STATUS_S * number for number in range(1, round(duration_s / STATUS_S))]
    found, arrived_s = [], 0.0
    for each in frames:
        arrived_s = max(arrived_s, each + late(each, 0))
        found.append((arrived_s, each, True))
    arrived_s = 0.0
    for each in stamps:
        arrived_s = max(arrived_s, each + late(each, 7))
        found.append((arrived_s, each, False))
    return sorted(found)


def frame_at(adapter_s, arrival_s):
    """Of an adapter that stamps in whole milliseconds of a minute."""
    return CanFrame(LOCK_ID, False, bytes(3), arrival_s, int(round(adapter_s % MINUTE_S * 1000, 3)) % 60_000)


def fed(events, ahead_s=0.0, steady_apart_s=0.0):
    """Map after these; ahead_s: of the adapter's clock, steady_apart_s: of the robot's steady one."""
    time = FrameTime()
    for arrival_s, stamp_s, is_frame in events:
        if is_frame:
            frame = frame_at(stamp_s + ahead_s, arrival_s)
            if not time.goes_on_with(frame):
                time.begin(frame)
            time.frame(frame)
        else:
            time.status(RobotStatus(round(stamp_s / STATUS_S), 1, stamp_s, sent_s=stamp_s,
                                    steady_s=stamp_s + steady_apart_s), arrival_s)
    return time


def mapped(time):
    """What a test may know of it."""
    return time.is_ready, time.to_robot(0.0), time.sigma_with(0.0)


@pytest.mark.parametrize("seed", range(6))
def test_map_is_the_same_however_busy_the_machine_is(seed):
    assert mapped(fed(arrivals(seed))) == mapped(fed(arrivals(0, late_s=0.0)))


def test_that_arrivals_tell_is_another_map_on_a_busy_machine():
    # Statuses whose steady clock is another one are of no simulation: there arrivals count.
    by_arrival = {fed(arrivals(seed), steady_apart_s=1000.0).to_robot(0.0) for seed in range(6)}
    assert len(by_arrival) > 1


def test_map_is_right():
    time = fed(arrivals(1))
    assert time.to_robot(0.0) % MINUTE_S == pytest.approx(0.0, abs=0.011) or time.to_robot(
        0.0) % MINUTE_S == pytest.approx(MINUTE_S, abs=0.011)
    assert time.problem == ""


@pytest.mark.parametrize("ahead_s", [0.4, 7.3, 31.0, 58.0])
def test_adapter_on_another_clock_is_mapped_by_arrivals(ahead_s):
    time = fed(arrivals(2, late_s=0.002), ahead_s)
    told_s = time.to_robot((100.0 + ahead_s) % MINUTE_S)
    assert (told_s - 100.0 + 30.0) % MINUTE_S - 30.0 == pytest.approx(0.0, abs=0.012)


@pytest.mark.parametrize("step_s", [2.0, -2.0, 20.0])
def test_adapter_whose_clock_is_set_is_followed(step_s):
    events = arrivals(3, 60.0, 0.002)
    time = FrameTime()
    for arrival_s, stamp_s, is_frame in events:
        if is_frame:
            set_by_s = step_s if stamp_s > 100.0 else 0.0
            frame = frame_at(stamp_s + set_by_s, arrival_s)
            if not time.goes_on_with(frame):
                time.begin(frame)
            local_s, _ = time.frame(frame)
            newest_s = stamp_s
        else:
            time.status(RobotStatus(round(stamp_s / STATUS_S), 1, stamp_s, sent_s=stamp_s, steady_s=stamp_s), arrival_s)
    assert time.to_robot(local_s) == pytest.approx(newest_s, abs=0.012)


@pytest.mark.parametrize(("local_s", "stamp_s", "whole_s"), [
    (15.0, 75.1, 60.0), (15.0, 15.0, 0.0), (59.99, 60.1, 0.0), (0.02, 60.0, 60.0), (15.0, 76.0, None),
    (float("nan"), 75.0, None)])
def test_minutes_between_are_known_where_the_clocks_are_one(local_s, stamp_s, whole_s):
    assert minutes_between(local_s, stamp_s) == whole_s


@pytest.mark.parametrize(("steady_apart_s", "is_waited_for"), [(0.0, True), (1000.0, False)])
def test_frames_up_to_the_status_are_waited_for_where_the_clocks_are_one(steady_apart_s, is_waited_for):
    # Frames of all messages come each 20 ms, the lock message each 0.2 s: what is missing may be one of it.
    watch = LockWatch(load_profile("mtr_honest_car"))
    for step in range(300):
        time_s = 75.0 + FRAMES_S * step
        watch.frame(frame_at(time_s - 0.01, time_s))
        if step % 5 == 0:
            watch.status(RobotStatus(step, 1, round(time_s, 6), sent_s=round(time_s, 6),
                                     steady_s=round(time_s, 6) + steady_apart_s), time_s)
            assert watch.has_caught_up()
            watch.release(time_s)
    late_s = round(time_s + 0.1, 6)
    watch.status(RobotStatus(300, 1, late_s, sent_s=late_s, steady_s=late_s + steady_apart_s), late_s)
    assert watch.has_caught_up() is not is_waited_for
    for step in range(1, 6):
        assert watch.has_caught_up() is not is_waited_for
        watch.frame(frame_at(time_s + FRAMES_S * step - 0.01, late_s))
    assert watch.has_caught_up()


def test_bus_without_a_robot_fills_no_memory():
    clock = OrderedClockMap(60.0)
    gc.collect()
    tracemalloc.start()
    for number in range(200_000):
        clock.frame(0.02 * number)
    held, _ = tracemalloc.get_traced_memory()
    tracemalloc.stop()
    assert held < 1_000_000
