"""The simulated clock waits for working nodes, and not for ended or silent ones."""
# SPDX-License-Identifier: Apache-2.0
import threading

import pytest

from mtr_simulation.clock.barrier import LOOK_WALL_S, SILENT_AFTER_WALL_S, Barrier, Watcher

STEP = 20_000_000


@pytest.fixture
def log():
    return []


class Diary(Watcher):
    """Watcher that records all notifications."""

    def __init__(self, log):
        self.warn = log.append
        self.dropped = lambda name: log.append(f"dropped {name}")
        self.returned = lambda name: log.append(f"returned {name}")


@pytest.fixture
def barrier(log, clock):
    return Barrier(["/a", "/b"], Diary(log), clock)


def wait_in_thread(barrier, time_ns):
    """Start a wait in a thread; it ends when the test has fulfilled its condition."""
    results = []
    thread = threading.Thread(target=lambda: results.append(barrier.wait(time_ns)))
    thread.start()
    return thread, results


def test_clock_goes_on_when_all_holds_allow_it(barrier):
    barrier.hold("/a", STEP, 0)
    barrier.hold("/b", 5 * STEP, 0)
    assert barrier.wait(STEP)


def test_clock_waits_for_the_earliest_hold(barrier):
    barrier.hold("/a", STEP, 0)
    barrier.hold("/b", 5 * STEP, 0)
    thread, results = wait_in_thread(barrier, 2 * STEP)
    assert results == []
    barrier.hold("/a", 2 * STEP, 0)
    thread.join(10.0)
    assert results == [True]


def test_who_works_later_is_asleep_until_then(barrier):
    barrier.message("/b")
    barrier.hold("/a", 2 * STEP, 0)
    assert barrier.asleep(STEP) == {"/a"}
    assert barrier.asleep(2 * STEP) == set()


def test_dropped_node_is_not_asleep(barrier, clock):
    barrier.hold("/a", STEP, 0)
    clock.hurry_s = SILENT_AFTER_WALL_S + 1.0
    barrier.wait(2 * STEP)
    assert barrier.asleep(0) == set()


def test_silent_node_is_dropped_later_where_there_is_more_patience(clock, log):
    patient = Barrier(["/a"], Diary(log), clock, silent_after_s=20.0)
    patient.hold("/a", STEP, 0)
    thread, results = wait_in_thread(patient, 2 * STEP)
    clock.now_s += 19.0
    thread.join(3.0 * LOOK_WALL_S)
    assert results == [] and log == []
    clock.now_s += 2.0
    thread.join(10.0)
    assert results == [True] and "/a has been silent for 20 s" in log[0]


def test_wait_is_counted_for_the_node_that_came_last(barrier, clock):
    barrier.hold("/a", STEP, 0)
    barrier.hold("/b", STEP, 0)
    thread, _ = wait_in_thread(barrier, 2 * STEP)
    barrier.hold("/a", 2 * STEP, 0)
    barrier.hold("/b", 2 * STEP, 0)
    thread.join(10.0)
    assert set(barrier.waited_s) <= {"/b"}


def test_clock_waits_for_messages_that_are_under_way(barrier):
    barrier.hold("/a", STEP, 2)
    barrier.message("/a")
    thread, results = wait_in_thread(barrier, STEP)
    assert results == []
    barrier.message("/a")
    thread.join(10.0)
    assert results == [True]


def test_message_that_overtakes_its_hold_counts(barrier):
    barrier.message("/a")
    barrier.hold("/a", STEP, 1)
    assert barrier.wait(STEP)


def test_messages_of_other_nodes_do_not_count(barrier, clock, log):
    barrier.message("/b")
    barrier.hold("/a", STEP, 1)
    clock.hurry_s = SILENT_AFTER_WALL_S + 1.0
    assert barrier.wait(STEP)
    assert "1 messages of node /a were lost" in log[0]


def test_lost_messages_are_given_up_once(barrier, clock, log):
    barrier.hold("/a", STEP, 3)
    clock.hurry_s = SILENT_AFTER_WALL_S + 1.0
    barrier.wait(STEP)
    clock.hurry_s = 0.0
    barrier.message("/a")
    barrier.hold("/a", 2 * STEP, 4)
    assert barrier.wait(2 * STEP)
    assert len(log) == 1


def test_silent_node_is_dropped_with_a_sentence(barrier, clock, log):
    barrier.hold("/a", STEP, 0)
    clock.hurry_s = SILENT_AFTER_WALL_S + 1.0
    assert barrier.wait(2 * STEP)
    assert log == ["Node /a has been silent for 5 s; time goes on without it.", "dropped /a"]


def test_node_that_has_ended_is_not_waited_for(log, clock):
    ended = set()
    barrier = Barrier(["/a"], Diary(log), clock, ended.__contains__)
    barrier.hold("/a", STEP, 3)
    thread, results = wait_in_thread(barrier, 2 * STEP)
    ended.add("/a")
    thread.join(10.0)
    assert results == [True]
    assert log == ["Node /a has ended; time goes on without it."]


def test_node_that_was_started_again_is_waited_for_like_a_new_one(log, clock):
    ended = {"/a"}
    barrier = Barrier(["/a"], Diary(log), clock, ended.__contains__)
    barrier.hold("/a", STEP, 3)
    assert barrier.wait(2 * STEP)
    ended.clear()
    barrier.hold("/a", 3 * STEP, 1)
    thread, results = wait_in_thread(barrier, 3 * STEP)
    assert results == []
    barrier.message("/a")
    thread.join(10.0)
    assert results == [True]


def test_dropped_node_that_speaks_again_is_waited_for_again(barrier, clock, log):
    barrier.hold("/a", STEP, 0)
    clock.hurry_s = SILENT_AFTER_WALL_S + 1.0
    barrier.wait(2 * STEP)
    clock.hurry_s = 0.0
    barrier.hold("/a", 3 * STEP, 0)
    assert log[-1] == "returned /a"
    thread, results = wait_in_thread(barrier, 4 * STEP)
    assert results == []
    barrier.hold("/a", 4 * STEP, 0)
    thread.join(10.0)
    assert results == [True]


def test_repeated_hold_is_a_sign_of_life(barrier, clock, log):
    barrier.hold("/a", STEP, 0)
    thread, results = wait_in_thread(barrier, 2 * STEP)
    for _ in range(5):
        clock.now_s += SILENT_AFTER_WALL_S - 1.0
        barrier.hold("/a", STEP, 0)
    barrier.hold("/a", 2 * STEP, 0)
    thread.join(10.0)
    assert (results, log) == ([True], [])


def test_restarted_node_counts_from_zero(barrier):
    for _ in range(10):
        barrier.message("/a")
    barrier.hold("/a", STEP, 10)
    barrier.hold("/a", STEP, 0)
    thread, results = wait_in_thread(barrier, 2 * STEP)
    barrier.hold("/a", 2 * STEP, 1)
    assert results == []
    barrier.message("/a")
    thread.join(10.0)
    assert results == [True]


def test_expected_nodes_are_missing_until_they_hold(barrier):
    barrier.message("/a")
    assert barrier.missing() == ["/a", "/b"]
    barrier.hold("/b", STEP, 0)
    assert barrier.missing() == ["/a"]
    barrier.hold("/a", STEP, 0)
    barrier.wait_for_expected()


def test_waiting_for_the_expected_nodes_ends_when_stopped(barrier, log):
    barrier.stop()
    barrier.wait_for_expected()
    assert log == []


def test_stop_ends_a_wait_at_once(barrier):
    barrier.hold("/a", STEP, 0)
    thread, results = wait_in_thread(barrier, 2 * STEP)
    barrier.stop()
    thread.join(10.0)
    assert results == [False]


def test_longest_waits_are_named_longest_first(barrier):
    assert barrier.longest_waits() == "waited so far for nobody"
    barrier.waited_s = {"/a": 1.0, "/b": 2.0}
    assert barrier.longest_waits() == "waited so far for /b 2.0 s, /a 1.0 s"
