"""From frames and Statuses to lock events: order, time, uncertainty, silence."""
# SPDX-License-Identifier: Apache-2.0
import pytest

from mtr_operator.car_link.can_frame import CanFrame
from mtr_operator.car_link.fake_message import DemoLockMessage
from mtr_operator.car_link.lock_watch import LockWatch
from mtr_operator.car_link.profile import load_profile
from mtr_operator.domain.ports import LockState
from mtr_operator.domain.robot_status import RobotStatus

LOCK_ID = 0x320
SPEED_ID = 0x1A0
# The adapter's clock was started 58 s before the robot's: its stamps begin anew 2 s later.
ADAPTER_AHEAD_S = 58.0
WALL_PER_ROBOT_S = 0.25


class Bench:
    """Steps robot time by 20 ms; a frame of the step before is 13 ms old, each fifth step has a Status."""

    def __init__(self, stamped=True):
        self.watch = LockWatch(load_profile("mtr_demo_car"))
        self.stamped = stamped
        self.step = 50
        self.message = DemoLockMessage()
        self.spoil = lambda data: data
        self.can_id = LOCK_ID
        self.bus_speaks = True
        self.robot_session_id = 1
        self.events = []

    @property
    def now_s(self):
        """Robot time."""
        return self.step * 0.02

    def frame(self):
        """The frame of the step before."""
        stamp_s = self.now_s - 0.013 + ADAPTER_AHEAD_S
        self.watch.frame(CanFrame(self.can_id, False, self.spoil(self.message.next()), self.now_s * WALL_PER_ROBOT_S,
                                  round(stamp_s * 1000) % 60_000 if self.stamped else None))

    def status(self):
        """Status of this step; collects events."""
        status = RobotStatus(self.step // 5, self.robot_session_id, round(self.now_s, 6))
        self.watch.status(status, self.now_s * WALL_PER_ROBOT_S + 0.0001)
        caught_up = self.watch.has_caught_up()
        self.events += self.watch.release(self.now_s * WALL_PER_ROBOT_S)
        return caught_up

    def run(self, seconds):
        """Let robot time pass."""
        for _ in range(round(seconds * 50)):
            self.step += 1
            if self.bus_speaks:
                self.frame()
            if self.step % 5 == 0:
                self.status()


@pytest.fixture(name="bench")
def bench_fixture():
    """Bench with a ready map, over the minute of the adapter's stamps, on a Status."""
    bench = Bench()
    bench.run(4.0)
    assert bench.watch.problem == ""
    return bench


def test_initial_state_is_no_event(bench):
    assert bench.events == []
    assert bench.watch.lock_state is LockState.LOCKED


@pytest.mark.parametrize("steps_after_status", range(1, 6))
def test_event_is_timed_by_the_frame_less_half_a_cycle(bench, steps_after_status):
    bench.run(0.02 * steps_after_status - 0.02)
    changed_s = bench.now_s
    bench.message.is_locked = False
    bench.run(0.2)
    event, = bench.events
    # The frame that shows it is stamped 7 ms after the step of the change.
    assert event.time_s == pytest.approx(changed_s, abs=0.005)
    assert 0.005 < event.time_sigma_s < 0.012
    assert event.lock_state is bench.watch.lock_state is LockState.UNLOCKED


def test_event_times_do_not_depend_on_the_laptops_clock():
    def course(wall_factor):
        bench = Bench()
        bench.run(4.0)
        bench.message.is_locked = False
        bench.run(1.0 * wall_factor)
        return bench.events[0]

    assert course(1) == course(2)


def test_later_frame_read_early_waits_for_its_status(bench):
    bench.step += 1
    bench.message.is_locked = False
    bench.frame()
    bench.step -= 1
    bench.status()
    assert bench.events == []
    assert bench.watch.lock_state is LockState.LOCKED
    bench.step += 1
    bench.run(0.08)
    assert len(bench.events) == 1


def test_result_is_the_same_whichever_of_status_and_frame_is_read_first(bench):
    bench.run(0.08)
    bench.step += 1
    bench.message.is_locked = False
    status = RobotStatus(9999, 1, round(bench.now_s, 6))
    bench.watch.status(status, 0.0)
    assert not bench.watch.has_caught_up()
    bench.frame()
    assert bench.watch.has_caught_up()
    event, = bench.watch.release(bench.now_s * WALL_PER_ROBOT_S)
    assert event.time_s == pytest.approx(bench.now_s - 0.02, abs=0.005)


def test_events_are_held_back_until_the_clock_is_mapped():
    bench = Bench()
    bench.run(1.0)
    changed_s = bench.now_s
    bench.message.is_locked = False
    bench.run(0.5)
    assert bench.events == [] and "not mapped" in bench.watch.problem
    bench.run(3.0)
    event, = bench.events
    assert event.time_s == pytest.approx(changed_s, abs=0.005)


def test_silent_bus_is_a_problem_after_half_a_second(bench):
    bench.bus_speaks = False
    bench.run(0.5)
    assert bench.watch.problem == ""
    bench.run(0.1)
    assert "No CAN frame for 0.6 s" in bench.watch.problem
    assert bench.watch.lock_state is LockState.UNKNOWN
    assert bench.watch.has_caught_up()


def test_bus_that_was_silent_from_the_start_is_a_problem():
    bench = Bench()
    bench.bus_speaks = False
    bench.run(1.0)
    assert "No CAN frame" in bench.watch.problem


def test_change_during_silence_is_as_uncertain_as_the_silence_is_long(bench):
    bench.bus_speaks = False
    bench.run(2.0)
    bench.bus_speaks, bench.message.is_locked = True, False
    bench.run(0.5)
    event, = bench.events
    assert event.time_s == pytest.approx(bench.now_s - 1.5, abs=0.02)
    assert event.time_sigma_s == pytest.approx(2.0 / 12 ** 0.5, abs=0.02)
    assert bench.watch.lock_state is LockState.UNLOCKED and bench.watch.problem == ""


def test_after_a_minute_of_silence_everything_is_learnt_again(bench):
    bench.bus_speaks = False
    bench.run(65.0)
    bench.bus_speaks, bench.message.is_locked = True, False
    bench.run(1.0)
    assert "not mapped" in bench.watch.problem
    bench.run(3.0)
    assert bench.watch.problem == "" and bench.events == []
    assert bench.watch.lock_state is LockState.UNLOCKED


def test_bus_without_the_lock_message_names_it(bench):
    bench.can_id = SPEED_ID
    bench.run(0.7)
    assert "DoorLockStatus (id 0x320)" in bench.watch.problem
    assert bench.watch.lock_state is LockState.UNKNOWN


def test_restarted_robot_needs_a_new_map(bench):
    bench.robot_session_id = 2
    bench.run(0.1)
    assert "not mapped" in bench.watch.problem
    bench.run(3.0)
    assert bench.watch.problem == ""


def test_unknown_state_is_a_doubt_and_the_return_to_the_state_before_no_event(bench):  # B1
    bench.spoil = lambda data: bench.message.encoded(2)
    bench.run(0.2)
    assert bench.watch.lock_state is LockState.UNKNOWN
    bench.spoil = lambda data: data
    bench.run(0.2)
    assert {event.lock_state for event in bench.events} == {LockState.UNKNOWN}
    assert "LockState of the Car's lock message has the unknown value 2" in bench.events[0].doubt
    assert bench.watch.lock_state is LockState.LOCKED


@pytest.mark.parametrize(("raw", "source"), [(1, "passive_entry"), (2, "key_button"), (0, ""), (7, "")])
def test_event_carries_what_made_the_locks_move(bench, raw, source):
    bench.message.is_locked, bench.message.source = False, raw
    bench.run(0.2)
    event, = bench.events
    assert (event.lock_state, event.source) == (LockState.UNLOCKED, source)


def test_another_source_without_a_change_is_no_event(bench):
    bench.message.source = 1
    bench.run(0.2)
    assert bench.events == []


def test_frames_without_stamps_are_timed_by_their_arrival():
    bench = Bench(stamped=False)
    bench.run(4.0)
    changed_s = bench.now_s
    bench.message.is_locked = False
    bench.run(0.3)
    event, = bench.events
    # Written one step after the change; half a cycle is taken off.
    assert event.time_s == pytest.approx(changed_s + 0.01, abs=0.005)
    assert event.time_sigma_s < 0.03
