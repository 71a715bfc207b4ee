"""Clocks that are set, drift and wrap: what the watch tells is right within its sigma, or is not told."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import bisect
import functools
import math
import random
from dataclasses import dataclass, field
from typing import NamedTuple

import pytest

from mtr_operator.car_link.can_frame import CanFrame
from mtr_operator.car_link.catch_up import LIMIT_S as CATCH_UP_S
from mtr_operator.car_link.fake_message import DemoLockMessage
from mtr_operator.car_link.lock_watch import LockWatch
from mtr_operator.car_link.profile import load_profile
from mtr_operator.domain.ports import LockState
from mtr_operator.domain.robot_status import RobotStatus

LOCK_ID = 0x320
CYCLE_S = 0.02
STATUS_PERIOD_S = 0.1
PROFILE = load_profile("mtr_demo_car")


@dataclass
class Clock:
    """Drifts, and is set.

    ramp_ppm_per_s: what warming up adds to the drift. steps: (true time, s forward).
    """

    offset_s: float = 0.0
    drift_ppm: float = 0.0
    ramp_ppm_per_s: float = 0.0
    steps: list[tuple[float, float]] = field(default_factory=list)

    def steady(self, time_s: float) -> float:
        """The clock if nobody had set it."""
        drift = self.drift_ppm + self.ramp_ppm_per_s * time_s / 2
        return time_s * (1.0 + 1e-6 * drift)

    def at(self, time_s: float) -> float:
        """What it shows at a true time."""
        return self.offset_s + self.steady(time_s) + sum(by_s for since_s, by_s in self.steps if since_s <= time_s)


@dataclass
class Ways:
    """How long messages are under way; interruptions: (begin, end) in which none gets through."""

    status_s: float = 0.001
    status_jitter_s: float = 0.004
    frame_s: float = 0.0003
    frame_jitter_s: float = 0.0005
    interruptions: list[tuple[float, float]] = field(default_factory=list)

    def arrival_s(self, time_s: float, way_s: float, jitter_s: float, chance: random.Random) -> float:
        """When a message arrives that leaves now."""
        arrival_s = time_s + way_s + chance.expovariate(1.0 / jitter_s)
        return max([arrival_s, *(end_s + way_s for begin_s, end_s in self.interruptions
                                 if begin_s <= arrival_s < end_s)])


class Told(NamedTuple):
    """An event as the watch tells it, beside its true time. is_usable: nothing says that it must not be believed."""

    true_s: float
    error_s: float
    sigma_s: float
    is_usable: bool


@dataclass
class Course:
    """What happens; true time is the laptop's."""

    changes: list[float]
    duration_s: float
    robot: Clock = field(default_factory=lambda: Clock(1000.0))
    adapter: Clock = field(default_factory=lambda: Clock(58.0))
    ways: Ways = field(default_factory=Ways)
    is_stamped: bool = True
    tells_steady_clock: bool = True
    pose_age_s: float = 0.0
    seed: int = 1

    def run(self):
        """Everything that the watch tells."""
        watch, told, frames = LockWatch(PROFILE), [], self._frames()[::-1]
        problem_s = -math.inf
        for arrival_s, status in self._statuses():
            while frames[-1][0] <= arrival_s:
                watch.frame(frames.pop()[1])
            watch.status(status, arrival_s)
            now_s = arrival_s
            while not watch.has_caught_up() and frames[-1][0] < arrival_s + CATCH_UP_S:
                now_s, frame = frames.pop()
                watch.frame(frame)
            events = watch.release(now_s)
            problem_s = now_s if watch.problem else problem_s
            for event in events:
                # A doubtful frame without a change: the adapter's stamps went back.
                if event.lock_state is (LockState.UNLOCKED if len(told) % 2 else LockState.LOCKED):
                    assert event.doubt
                    continue
                true_s = self.changes[len(told)]
                told.append(Told(true_s, event.time_s - self.robot.at(true_s), event.time_sigma_s,
                                 math.isfinite(event.time_sigma_s) and problem_s < true_s))
        return told

    def _statuses(self) -> list[tuple[float, RobotStatus]]:
        chance, ways, arrived = random.Random(self.seed), self.ways, []
        last_s = 0.0
        for index in range(round(self.duration_s / STATUS_PERIOD_S)):
            time_s = index * STATUS_PERIOD_S + 0.003
            last_s = max(last_s, ways.arrival_s(time_s, ways.status_s, ways.status_jitter_s, chance))
            steady_s = self.robot.steady(time_s) if self.tells_steady_clock else math.nan
            arrived.append((last_s, RobotStatus(index + 1, 1, self.robot.at(time_s - self.pose_age_s),
                                                sent_s=self.robot.at(time_s), steady_s=steady_s)))
        return arrived

    def _frames(self) -> list[tuple[float, CanFrame]]:
        chance, ways, arrived = random.Random(self.seed + 1), self.ways, []
        last_s, phase_s, message = 0.0, chance.uniform(0.0, CYCLE_S), DemoLockMessage()
        for index in range(round((self.duration_s + 1.0) / CYCLE_S)):
            time_s = index * CYCLE_S + phase_s
            message.is_locked = bisect.bisect_right(self.changes, time_s) % 2 == 0
            last_s = max(last_s, ways.arrival_s(time_s, ways.frame_s, ways.frame_jitter_s, chance))
            stamp_ms = int(self.adapter.at(time_s) * 1000.0) % 60_000 if self.is_stamped else None
            arrived.append((last_s, CanFrame(LOCK_ID, False, message.next(), last_s, stamp_ms)))
        return arrived


def usable(told):
    """Events that a line would be made of."""
    return [event for event in told if event.is_usable]


# B4, table 1.1: before, each was told with an error of the whole step for some 15 s, and a sigma of some ms.
STEPS_S = (0.02, 0.05, 0.1, 0.2, 0.4, 0.48, 0.9, 1.5, -0.02, -0.05, -0.09, -0.15, -0.4, -0.9, -3600.0, 3600.0)
SET_S = 12.0
CHANGES_S = [SET_S + after_s for after_s in (-0.3, -0.05, 0.01, 0.05, 0.1, 0.25, 0.5, 1.0, 2.0, 3.0, 5.0, 13.0)]


@pytest.mark.parametrize("is_stamped", [True, False], ids=["stamped", "unstamped"])
@pytest.mark.parametrize("step_s", STEPS_S)
def test_b4_no_event_is_told_wrongly_when_the_robot_says_that_its_clock_was_set(step_s, is_stamped):
    told = Course(CHANGES_S, 26.0, Clock(5000.0, steps=[(SET_S, step_s)]), is_stamped=is_stamped).run()
    assert len(told) == len(CHANGES_S)
    for event in usable(told):
        assert abs(event.error_s) < max(3.0 * event.sigma_s, 0.005)
    assert max(event.true_s for event in usable(told)) == CHANGES_S[-1]


@pytest.mark.parametrize("is_stamped", [True, False], ids=["stamped", "unstamped"])
@pytest.mark.parametrize("step_s", STEPS_S)
def test_b4_no_event_is_off_by_a_noticeable_step_when_a_robot_of_before_sets_its_clock(step_s, is_stamped):
    told = Course(CHANGES_S, 26.0, Clock(5000.0, steps=[(SET_S, step_s)]), is_stamped=is_stamped,
                  tells_steady_clock=False).run()
    assert len(told) == len(CHANGES_S)
    for event in usable(told):
        assert abs(event.error_s) < 0.035
    assert max(event.true_s for event in usable(told)) == CHANGES_S[-1]


@pytest.mark.parametrize("is_stamped", [True, False], ids=["stamped", "unstamped"])
def test_b4_clock_of_a_robot_of_before_that_goes_back_at_once_is_noticed(is_stamped):
    told = Course([4.0, 9.0], 15.0, Clock(5000.0, steps=[(2.5, -8.0)]), is_stamped=is_stamped,
                  tells_steady_clock=False).run()
    assert [abs(event.error_s) < 0.035 for event in usable(told)] == [True]


@pytest.mark.parametrize("jitter_s", [0.001, 0.006])
def test_robot_of_before_over_a_slow_wifi_does_not_seem_to_set_its_clock(jitter_s):
    for seed in range(10):
        told = Course([9.0, 12.0, 15.0], 18.0, ways=Ways(status_jitter_s=jitter_s), tells_steady_clock=False,
                      seed=seed).run()
        assert len(usable(told)) == 3


@pytest.mark.parametrize("step_s", (*STEPS_S, 25.0))
def test_b4_no_event_is_off_by_a_noticeable_step_when_the_adapters_clock_jumps(step_s):
    told = Course(CHANGES_S, 26.0, adapter=Clock(5000.0, steps=[(SET_S, step_s)])).run()
    for event in usable(told):
        assert abs(event.error_s) < 0.035
    assert max(event.true_s for event in usable(told)) == CHANGES_S[-1]


EVENTS_PER_COURSE = 100
COURSES = 100
# Each part is a test of its own, so that a slow machine does not reach the time limit of a single one.
PARTS = 10


def random_course(seed, is_disturbed):
    """Everything at once: drift, warming up, wraps, slow and interrupted Wi-Fi, and clocks that are set."""
    chance = random.Random(seed)
    changes, time_s = [], 6.0
    for _ in range(EVENTS_PER_COURSE):
        time_s += chance.uniform(0.3, 0.6)
        changes.append(time_s)
    duration_s = time_s + 8.0

    def clock(offset_s, steps):
        sizes = [chance.choice((-1.0, 1.0)) * 10.0 ** chance.uniform(math.log10(0.02), 2.0) for _ in range(steps)]
        return Clock(offset_s, chance.uniform(-100.0, 100.0), chance.uniform(-1.0, 1.0),
                     [(chance.uniform(10.0, time_s), size_s) for size_s in sizes])

    is_stamped = chance.random() < 0.6
    interruptions = [(begin_s, begin_s + chance.uniform(0.05, 0.8))
                     for begin_s in (chance.uniform(6.0, duration_s) for _ in range(4 * is_disturbed))]
    return Course(changes, duration_s, clock(chance.uniform(1e3, 1.7e9), 2 * is_disturbed),
                  clock(chance.uniform(0.0, 60.0), is_disturbed and is_stamped),
                  Ways(chance.uniform(0.0005, 0.005), chance.uniform(0.001, 0.01), interruptions=interruptions),
                  is_stamped, pose_age_s=chance.uniform(0.02, 0.15), seed=seed)


@functools.lru_cache(maxsize=None)
def disturbed(part):
    """Events that the watch released in a part of the courses."""
    seeds = range(part * COURSES // PARTS, (part + 1) * COURSES // PARTS)
    return [event for seed in seeds for event in random_course(seed, is_disturbed=True).run()]


@pytest.mark.parametrize("part", range(PARTS))
def test_disturbed_courses_lose_no_event(part):
    assert len(disturbed(part)) == COURSES // PARTS * EVENTS_PER_COURSE


def test_normalised_error_of_10000_events_is_within_its_95_percent_bounds():
    events = [event for part in range(PARTS) for event in disturbed(part)]
    errors = [event.error_s / event.sigma_s for event in usable(events)]
    assert len(errors) > 0.7 * len(events)
    # Upper bound of chi-square with so many degrees of freedom, normal approximation.
    assert sum(error ** 2 for error in errors) / len(errors) < 1.0 + 1.645 * math.sqrt(2.0 / len(errors))
    assert sum(abs(error) < 1.96 for error in errors) / len(errors) >= 0.95
    # Of a normal distribution 0.27 %.
    assert sum(abs(error) > 3.0 for error in errors) / len(errors) < 0.0027


def test_undisturbed_events_are_all_told_with_a_sigma_of_some_ms():
    for seed in range(10):
        told = random_course(seed, is_disturbed=False).run()
        assert len(usable(told)) == EVENTS_PER_COURSE
        assert max(event.sigma_s for event in told) < 0.015
