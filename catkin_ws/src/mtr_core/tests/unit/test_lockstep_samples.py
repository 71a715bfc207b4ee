"""The sample for a consumer's tick, and the limits of the wait for it."""
# SPDX-License-Identifier: Apache-2.0
import threading

import pytest

from mtr_core.lockstep.samples import Samples
from mtr_core.schedule import (
    KEPT_SAMPLES,
    LATE_PRODUCER_SHARE,
    MILLISECOND_NS,
    MOTION_PLANNER,
    PRODUCER_LOST_AFTER_WALL_S,
    SENSORS,
)


def ms(time_ms):
    return time_ms * MILLISECOND_NS


class JumpingClock:
    """Wall clock that advances by the limit at each reading, so that a wait ends at once."""

    def __init__(self):
        self.now_s = 0.0

    def __call__(self):
        self.now_s += PRODUCER_LOST_AFTER_WALL_S
        return self.now_s


@pytest.fixture
def samples():
    return Samples(MOTION_PLANNER, wall_clock=JumpingClock())


def test_without_lock_step_the_newest_sample_is_read():
    samples = Samples(MOTION_PLANNER, waits=False)
    assert samples.at(ms(1000)) is None
    samples.add(ms(2000), "first")
    samples.add(ms(2040), "second")
    assert samples.at(ms(1000)) == "second"


def test_nothing_is_due_before_the_simulation_starts(samples):
    assert samples.at(ms(1020)) is None
    assert samples._wall_clock.now_s == 0.0


def test_message_that_came_early_is_left_for_the_next_tick(samples):
    samples.add(ms(2000), "due")
    samples.add(ms(2040), "early")
    assert samples.at(ms(2040)) == "due"
    assert samples.at(ms(2060)) == "early"


def test_sensor_without_lag_is_due_at_its_stamp():
    samples = Samples(SENSORS, lag_ns=0)
    samples.add(ms(2000), "previous")
    samples.add(ms(2020), "now")
    assert samples.at(ms(2020)) == "now"


def test_due_sample_is_waited_for():
    samples = Samples(MOTION_PLANNER)
    read = []
    consumer = threading.Thread(target=lambda: read.append(samples.at(ms(2060))))
    consumer.start()
    samples.add(ms(2000), "before")
    samples.add(ms(2040), "due")
    consumer.join(timeout=PRODUCER_LOST_AFTER_WALL_S)
    assert read == ["due"]


def taking_thread(samples):
    """Return a started thread that waits like the reader of a connection until more samples are wanted."""
    thread = threading.Thread(target=samples.wait_until_wanted)
    thread.start()
    return thread


@pytest.fixture
def slowly_read():
    """Return samples of a fast producer with a consumer that reads every 100 ms, last at 2100 ms."""
    samples = Samples(SENSORS, lag_ns=0)
    for tick in (2000, 2100):
        samples.add(ms(tick), tick)
        samples.at(ms(tick))
    return samples


def test_samples_that_nobody_wants_yet_wait_for_the_consumer(slowly_read, monkeypatch):
    monkeypatch.setattr("mtr_core.lockstep.samples.UNWANTED_LIMIT_WALL_S", 60.0)
    slowly_read.add(ms(2120), "unwanted")
    thread = taking_thread(slowly_read)
    assert thread.is_alive()
    consumer = threading.Thread(target=lambda: slowly_read.at(ms(2200)))
    consumer.start()
    thread.join(timeout=10.0)
    assert not thread.is_alive()
    slowly_read.add(ms(2200), "due")
    consumer.join()


def test_sample_that_the_consumer_wants_next_is_taken_at_once(slowly_read, monkeypatch):
    monkeypatch.setattr("mtr_core.lockstep.samples.UNWANTED_LIMIT_WALL_S", 60.0)
    slowly_read.add(ms(2180), "the last that nobody wants")
    slowly_read.wait_until_wanted()


def test_samples_of_an_equally_fast_producer_never_wait(monkeypatch):
    monkeypatch.setattr("mtr_core.lockstep.samples.UNWANTED_LIMIT_WALL_S", 60.0)
    samples = Samples(MOTION_PLANNER, lag_ns=0)
    for tick in (2000, 2040, 2080):
        samples.add(ms(tick), tick)
        samples.wait_until_wanted()
        assert samples.at(ms(tick)) == tick


def test_consumer_that_stays_away_gets_the_next_sample_all_the_same(slowly_read, monkeypatch):
    monkeypatch.setattr("mtr_core.lockstep.samples.UNWANTED_LIMIT_WALL_S", 0.0)
    slowly_read.add(ms(2120), "unwanted")
    slowly_read.wait_until_wanted()


def test_without_lock_step_no_sample_waits():
    samples = Samples(SENSORS, waits=False)
    samples.add(ms(2120), "newest")
    samples.wait_until_wanted()


def test_silent_producer_is_given_up_and_its_old_sample_is_read(samples):
    samples.add(ms(2000), "old")
    assert samples.at(ms(2060)) == "old"
    given_up_at = samples._wall_clock.now_s
    assert samples.at(ms(3000)) == "old"
    assert samples._wall_clock.now_s == given_up_at + PRODUCER_LOST_AFTER_WALL_S


def test_producer_that_was_given_up_is_waited_for_again_once_it_speaks(samples):
    assert samples.at(ms(2060)) is None
    samples.add(ms(2080), "back")
    assert not samples._lost


class StandingClock:
    """Wall clock that advances only during a wait."""

    def __init__(self, samples, monkeypatch):
        self.now_s, self.while_waiting = 0.0, lambda: None
        samples._wall_clock = lambda: self.now_s
        monkeypatch.setattr(samples._changed, "wait", self._wait)

    def _wait(self, timeout_s):
        self.now_s += timeout_s
        self.while_waiting()


@pytest.fixture
def standing(samples, monkeypatch):
    return StandingClock(samples, monkeypatch)


def test_producer_that_is_late_at_each_tick_costs_its_patience_once(samples, standing):
    for tick in range(2040, 2040 + 40 * 25, 40):
        samples.at(ms(tick + 20))
        samples.add(ms(tick - 400), "late")
    assert standing.now_s == pytest.approx(PRODUCER_LOST_AFTER_WALL_S * (1.0 + 24 * LATE_PRODUCER_SHARE))


def test_late_producer_that_was_in_time_again_is_waited_for_with_all_patience(samples, standing):
    samples.at(ms(2060))
    samples.add(ms(2040), "late")
    standing.while_waiting = lambda: samples.add(ms(2080), "in time")
    assert samples.at(ms(2100)) == "in time"
    standing.now_s, standing.while_waiting = 0.0, lambda: None
    samples.at(ms(2140))
    assert standing.now_s == PRODUCER_LOST_AFTER_WALL_S


def test_stamp_that_is_not_newer_replaces_history(samples):
    samples.add(ms(9000), "before the restart")
    samples.add(ms(1040), "after the restart")
    assert samples.at(ms(1060)) == "after the restart"


def test_only_the_last_samples_are_kept(samples):
    for number in range(KEPT_SAMPLES + 1):
        samples.add(ms(2000 + 40 * number), number)
    assert samples.at(ms(2020)) is None
    assert samples.at(ms(2060)) == 1
