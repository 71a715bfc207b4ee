"""Where the limits of the actions lie: of waiting, of silence, of a place and a height, of the Car's own timer."""
# SPDX-License-Identifier: Apache-2.0
import math
from dataclasses import replace

import pytest

from mtr_operator.domain.actions.car import Car
from mtr_operator.domain.actions.control_loop import ControlLoop
from mtr_operator.domain.actions.distance import Distance
from mtr_operator.domain.actions.line_watch import LineWatch
from mtr_operator.domain.actions.lock_history import Expected, LockHistory
from mtr_operator.domain.actions.pose_history import PoseHistory
from mtr_operator.domain.actions.robot import Robot
from mtr_operator.domain.actions.tolerances import Tolerances
from mtr_operator.domain.actions.trouble import LineInvalid
from mtr_operator.domain.errors import ConnectionFailed, LinkLost
from mtr_operator.domain.exchange.run_context import RunContext
from mtr_operator.domain.geometry.ray import Ray
from mtr_operator.domain.ports import PASSIVE_ENTRY, CarEvent, LockFacts, LockState
from mtr_operator.domain.requests import Direction
from mtr_operator.domain.results.journal import EVENT, Journal
from mtr_operator.domain.robot_status import RobotStatus

LOCKED, UNLOCKED = LockState.LOCKED, LockState.UNLOCKED
AHEAD = Ray(0.0, 0.0, 1.0, 0.0)


class Diary(Journal):
    """What was kept."""

    def __init__(self):
        self.entries = []

    def add(self, kind, values):
        self.entries.append((kind, values))


@pytest.fixture(name="loop")
def loop_fixture(robot_link, car_link):
    """On the world's links."""
    return ControlLoop(robot_link, car_link)


# Waiting and silence


def test_bus_that_is_not_understood_is_given_up_after_10_s(loop, world):
    world.car_problem = lambda time_s: "No frame."
    begun_s = loop.now_s
    with pytest.raises(ConnectionFailed):
        Car(loop).prepare()
    assert loop.now_s - begun_s == pytest.approx(10.0, abs=0.05)


def test_robot_that_never_speaks_is_looked_at_for_10_s(loop, world, robot_link):
    world.spoil = lambda status: None
    with pytest.raises(LinkLost, match="no Status has come for 10 s"):
        loop.step()
    # A look takes 50 ms.
    assert robot_link.status_id == 200


def test_robot_that_falls_silent_is_looked_at_for_30_s(loop, world, robot_link):
    loop.step()
    world.spoil = lambda status: None
    before = robot_link.status_id
    with pytest.raises(LinkLost, match="silent for 30 s"):
        loop.step()
    assert robot_link.status_id - before == 600


def test_hold_that_the_operator_has_released_is_asked_for_with_the_one_in_force(robot_link, car_link, world):
    asked = []
    loop = ControlLoop(robot_link, car_link, resumed_hold=lambda hold_id: (asked.append(hold_id), 4)[1])
    loop.step()
    assert asked == [0] and loop.desired.resume_hold_id == 4
    loop.step()
    assert asked == [0, 0] and robot_link.answers[-1][1].resume_hold_id == 4


def test_changes_of_the_locks_are_kept_before_anything_follows_from_them(loop, world):
    loop.context = RunContext(journal=Diary())
    world.events = [CarEvent(1.05, 0.005, UNLOCKED, PASSIVE_ENTRY)]
    loop.step()
    (kind, values), = loop.context.journal.entries
    assert (kind, values["time_s"], values["source"]) == (EVENT, 1.05, PASSIVE_ENTRY)
    assert len(loop.events) == 1


def test_robot_has_rested_since_its_newest_pose_in_motion(loop, world):
    robot = Robot(loop)
    loop.step()
    assert robot.rest_s == math.inf
    robot.set_maximum_speed(0.5)
    robot.go_to(AHEAD, 3.0, Direction.FORWARD)
    robot.wait_until_reached()
    robot.wait(2.0)
    assert robot.rest_s == pytest.approx(2.0, abs=0.25)


def test_pose_of_a_minute_ago_is_remembered():
    poses = PoseHistory()
    for stamp_s in (1.0, 31.0, 61.0):
        poses.add(RobotStatus(1, 1, stamp_s, x=3.0, y=0.0, heading=0.0, pose_valid=True))
    assert [sample.stamp_s for sample in poses.samples] == [1.0, 31.0, 61.0]
    poses.add(RobotStatus(1, 1, 61.1, x=3.0, y=0.0, heading=0.0, pose_valid=True))
    assert poses.samples[0].stamp_s == 31.0


# A place on a line


def place(distance_m, sigma_m=0.0, speed_mps=0.0, lateral_m=0.0, heading_rad=0.0):
    """Where something was measured."""
    return Distance(distance_m, sigma_m, 10.0, lateral_m, heading_rad, 1.0, speed_mps)


# On a line from 0.5 to 4 m; the tolerance beside the line, 10 cm, and 3 sigma count along it too.
@pytest.mark.parametrize(("measured", "is_good"), [
    (place(0.4), True), (place(0.399), False), (place(4.1), True), (place(4.101), False),
    (place(0.315, 0.03), True), (place(0.305, 0.03), False), (place(4.185, 0.03), True), (place(4.195, 0.03), False),
    (place(0.405, math.nan), True), (place(0.395, math.nan), False), (place(4.105, math.nan), False),
    (place(1.0, speed_mps=0.6), True), (place(1.0, speed_mps=-0.601), False), (place(1.0, speed_mps=math.nan), False),
    (place(1.0, lateral_m=-0.1), True), (place(1.0, lateral_m=0.101), False),
    (place(1.0, heading_rad=math.radians(-5.0)), True), (place(1.0, heading_rad=math.radians(5.1)), False)])
def test_place_of_a_measurement_lies_on_its_line_within_the_tolerances(loop, measured, is_good):
    watch = LineWatch(loop, Tolerances())
    if is_good:
        watch.check_distance(measured, 0.5, 4.0, 0.5)
    else:
        with pytest.raises(LineInvalid):
            watch.check_distance(measured, 0.5, 4.0, 0.5)


def test_height_of_the_key_is_told_with_the_one_wanted_and_what_is_allowed(loop, world):
    robot, height_m = Robot(loop), [1.2]
    world.spoil = lambda status: replace(status, key_height_m=height_m[-1])
    robot.move_key_to(1.2)
    sentence = r"The Remote key is at 90 cm instead of 120 cm; allowed are 7 cm of difference\."
    with pytest.raises(LineInvalid, match=sentence), robot.watched(Tolerances(height_tolerance_m=0.07)):
        height_m.append(1.14)
        robot.wait(0.3)
        height_m.append(0.9)
        robot.wait(0.3)


# The Car's own timer


def lock(time_s, sigma_s=0.0, source=""):
    """The Car locks."""
    return CarEvent(time_s, sigma_s, LOCKED, source)


# A timer of 30 s is good to 1 s and 2 %, beside 3 sigma of the instant.
@pytest.mark.parametrize(("locked_s", "sigma_s", "is_timer"), [
    (31.55, 0.0, True), (31.65, 0.0, False), (28.45, 0.0, True), (28.35, 0.0, False),
    (31.85, 0.1, True), (31.95, 0.1, False)])
def test_car_may_lock_by_its_timer_within_the_timers_accuracy(locked_s, sigma_s, is_timer):
    history = LockHistory(UNLOCKED, LockFacts(relock_after_s=30.0), unlocked_s=0.0)
    if is_timer:
        history.take(lock(locked_s, sigma_s))
        assert history.state is LOCKED and history.answer is None
    else:
        with pytest.raises(LineInvalid, match="was locked without anything in the test to make it"):
            history.take(lock(locked_s, sigma_s))


@pytest.mark.parametrize(("locked_s", "source", "is_timer"), [
    (30.1, "", True), (30.1, "key_button", False), (20.0, "", False)])
def test_timer_that_locks_after_a_press_without_an_answer_is_not_a_late_answer(locked_s, source, is_timer):
    history = LockHistory(UNLOCKED, LockFacts(relock_after_s=30.0, sources=frozenset({"key_button"})), unlocked_s=0.0)
    history.expect(Expected(LOCKED, "key_button", "the press at 3.35 m", 10.0, 11.0))
    history.close(11.0)
    if is_timer:
        history.take(lock(locked_s, source=source))
        assert history.state is LOCKED and history.answer is None
    else:
        with pytest.raises(LineInvalid, match="too late for the press at 3.35 m"):
            history.take(lock(locked_s, source=source))


@pytest.mark.parametrize(("before", "is_timer"), [
    ([(1.0, LOCKED), (2.0, UNLOCKED)], True), ([(1.0, UNLOCKED)], False), ([], False)])
def test_timer_counts_from_the_last_time_that_the_car_was_seen_to_unlock(loop, world, before, is_timer):
    world.facts, world.locked = LockFacts(relock_after_s=30.0), False
    loop.step()
    loop.events = [CarEvent(time_s, 0.0, state) for time_s, state in before]
    watch = LineWatch(loop, Tolerances())
    loop.events = [*loop.events, lock(33.2)]
    if is_timer:
        watch.check(loop.status)
        assert watch.is_locked
    else:
        with pytest.raises(LineInvalid, match="without anything in the test"):
            watch.check(loop.status)


def test_change_that_was_doubted_is_no_beginning_of_a_timer(loop, world):
    world.facts, world.locked = LockFacts(relock_after_s=30.0), False
    loop.step()
    loop.events = [CarEvent(2.0, 0.0, UNLOCKED), CarEvent(20.0, 0.0, UNLOCKED, doubt="A glitch.")]
    watch = LineWatch(loop, Tolerances())
    loop.events = [*loop.events, lock(32.0)]
    watch.check(loop.status)
    assert watch.is_locked


# A change that the test provokes: after 10 s, until 11 s.
@pytest.mark.parametrize(("time_s", "sigma_s", "cause_sigma_s", "words"), [
    (10.0, 0.0, 0.0, ""), (11.0, 0.0, 0.0, ""), (11.01, 0.01, 0.0, "0.01 s too late for the press"),
    (9.975, 0.0, 0.01, ""), (9.965, 0.0, 0.01, "before the press"), (9.955, 0.009, 0.012, ""),
    (9.945, 0.009, 0.012, "0.05 s before the press")])
def test_answer_comes_within_its_window_and_the_accuracy_of_the_clocks(time_s, sigma_s, cause_sigma_s, words):
    history = LockHistory(UNLOCKED, LockFacts())
    history.expect(Expected(LOCKED, "key_button", "the press", 10.0, 11.0, cause_sigma_s))
    if words:
        with pytest.raises(LineInvalid, match=words):
            history.take(lock(time_s, sigma_s))
    else:
        history.take(lock(time_s, sigma_s))
        assert history.answer.time_s == time_s


def test_change_that_is_held_back_is_judged_when_it_is_known_what_was_expected():
    history = LockHistory(UNLOCKED, LockFacts())
    history.hold()
    history.take(lock(10.5))
    assert history.answer is None and history.state is UNLOCKED
    history.expect(Expected(LOCKED, "key_button", "the press", 10.0, 11.0))
    assert history.answer.time_s == 10.5 and history.state is LOCKED
    history.hold()
    with pytest.raises(LineInvalid, match=r"0\.50 s before the press"):
        history.take(replace(lock(11.5), lock_state=UNLOCKED))
        history.expect(Expected(UNLOCKED, "key_button", "the press", 12.0, 13.0))


def test_car_that_may_lock_may_not_unlock():
    history = LockHistory(UNLOCKED, LockFacts())
    history.allow_lock()
    history.take(lock(10.0))
    assert history.state is LOCKED
    with pytest.raises(LineInvalid, match="was unlocked without anything in the test to make it"):
        history.take(replace(lock(11.0), lock_state=UNLOCKED))
