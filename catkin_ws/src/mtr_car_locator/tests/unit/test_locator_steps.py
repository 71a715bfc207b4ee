"""Steps of the locator during the node's ticks, with a locator of adjustable duration."""
# SPDX-License-Identifier: Apache-2.0
import threading
from concurrent.futures import ThreadPoolExecutor

import pytest

from mtr_car_locator.estimate import Inputs
from mtr_car_locator.steps import CONNECTING_NS, MAP_LAG_NS, LocatorSteps, ScanWindow, is_map_due
from mtr_core.executors import InlineExecutor

LIMIT_S = 20.0


class SlowLocator:
    """Its estimate is the time of its inputs; a step at `holds_s` lasts until it is released."""

    def __init__(self, holds_s=None):
        self.poses, self.scans, self.steps = [], [], []
        self.holds_s, self.go_on, self.inside = holds_s, threading.Event(), threading.Event()

    def add_pose(self, pose):
        self.poses.append((pose, self.inside.is_set()))

    def wants_scans(self, inputs):
        return bool(self.steps)

    def step(self, inputs):
        if inputs.now_s == self.holds_s:
            self.inside.set()
            assert self.go_on.wait(LIMIT_S)
            self.inside.clear()
        if inputs.now_s < 0.0:
            raise ValueError("no step")
        self.steps.append(inputs.now_s)
        self.scans.extend(inputs.scans)
        return f"at {inputs.now_s}"


@pytest.fixture
def thread():
    with ThreadPoolExecutor(1) as executor:
        yield executor


def tick(steps, number, scans=()):
    """Run one tick of a node with one pose and return its estimate."""
    steps.wants_scans(Inputs(float(number)), [number])
    return steps.estimate(Inputs(float(number), scans=scans))


def test_in_lockstep_each_tick_has_the_estimate_of_its_own_inputs():
    locator = SlowLocator()
    steps = LocatorSteps(locator, InlineExecutor(), patience_s=0.0)
    assert [tick(steps, number) for number in range(3)] == ["at 0.0", "at 1.0", "at 2.0"]
    assert [pose for pose, _ in locator.poses] == [0, 1, 2]


def test_while_a_step_lasts_the_former_estimate_is_said_and_nothing_that_comes_is_lost(thread):
    locator = SlowLocator(holds_s=1.0)
    steps = LocatorSteps(locator, thread, patience_s=0.02)
    assert tick(steps, 0, ["a"]) == "at 0.0"
    assert [tick(steps, number, [f"{number}"]) for number in (1, 2, 3)] == ["at 0.0"] * 3
    locator.go_on.set()
    steps._patience_s = LIMIT_S
    assert tick(steps, 4, ["4"]) == "at 1.0"
    assert tick(steps, 5, ["5"]) == "at 5.0"
    assert locator.scans == ["a", "1", "2", "3", "4", "5"]
    assert [pose for pose, _ in locator.poses] == list(range(6))


def test_a_locator_at_work_is_not_touched(thread):
    locator = SlowLocator(holds_s=1.0)
    steps = LocatorSteps(locator, thread, patience_s=0.02)
    tick(steps, 0)
    tick(steps, 1)
    assert locator.inside.wait(LIMIT_S)
    assert steps.wants_scans(Inputs(2.0), [2]) is True
    locator.go_on.set()
    steps._patience_s = LIMIT_S
    steps.estimate(Inputs(2.0))
    tick(steps, 3)
    assert locator.poses == [(number, False) for number in range(4)]


def test_what_a_step_raised_reaches_the_node(thread):
    steps = LocatorSteps(SlowLocator(), thread, patience_s=LIMIT_S)
    with pytest.raises(ValueError, match="no step"):
        tick(steps, -1)


def test_scans_count_from_the_time_on_at_which_their_connections_are_made():
    window, begin_ns = ScanWindow(), 5_000_000_000
    assert not window.counts(begin_ns)
    window.follow(begin_ns, True)
    assert not window.counts(begin_ns + CONNECTING_NS - 1) and window.counts(begin_ns + CONNECTING_NS)
    window.follow(begin_ns + 100_000_000, True)
    assert window.counts(begin_ns + CONNECTING_NS)


def test_scans_that_are_wanted_again_count_anew():
    window, begin_ns = ScanWindow(), 5_000_000_000
    window.follow(begin_ns, True)
    window.follow(begin_ns + 1_000_000_000, False)
    assert not window.counts(begin_ns + 1_000_000_000)
    window.follow(begin_ns + 2_000_000_000, True)
    assert not window.counts(begin_ns + 2_000_000_000) and window.counts(begin_ns + 2_000_000_000 + CONNECTING_NS)


def test_scans_count_after_the_clock_was_set_back():
    window, begin_ns = ScanWindow(), 5_000_000_000
    window.follow(begin_ns, True)
    window.follow(begin_ns - 3_000_000_000, True)
    assert window.counts(begin_ns - 3_000_000_000 + CONNECTING_NS)


def test_map_counts_a_while_after_its_stamp():
    assert not is_map_due(7, 7 + MAP_LAG_NS - 1) and is_map_due(7, 7 + MAP_LAG_NS)
