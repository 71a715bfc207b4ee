"""The station's decisions: numbers, settings, readiness, estimates, the mailbox."""
# SPDX-License-Identifier: Apache-2.0
import dataclasses
import math

import pytest

from mtr_operator.domain.absent_car import NO_ADAPTER, AbsentCarLink
from mtr_operator.domain.interfaces.car_bus import BusMonitor
from mtr_operator.domain.ports import BusTraffic, LockFacts, LockState
from mtr_operator.domain.robot_status import CarDimensions, Mode, Notification, RobotStatus
from mtr_operator.domain.scenarios import SCENARIOS
from mtr_operator.station.estimate import USUAL_CAR, USUAL_FACTS, TimeLeft, plan_of
from mtr_operator.station.events import ActionBegun, RobotSnapshot, known_facts
from mtr_operator.station.mailbox import MAX_TRAIL, Batch, Mailbox
from mtr_operator.station.readiness import Cause, Phase, ReadinessWord, can_resume, readiness_of
from mtr_operator.station.trail import thinned
from mtr_operator.station.view_model import ViewModel

STATUS = RobotStatus(id=1, robot_session_id=1, stamp_s=1.0, sent_s=1.0, steady_s=1.0, pose_valid=True,
                     mode=Mode.FOLLOWING_WAYPOINT,
                     battery_percent=80)


def snapshot(lock=LockState.LOCKED, problem="", **changes):
    return RobotSnapshot(dataclasses.replace(STATUS, **changes), lock, problem)


def test_plan_is_made_with_what_the_connected_cars_profile_tells():
    model = ViewModel()
    assert model.facts == USUAL_FACTS
    model.apply(Batch((), snapshot(), ()))
    assert model.facts == USUAL_FACTS
    slow = LockFacts(told_every_s=0.8)
    model.apply(Batch((), dataclasses.replace(snapshot(), facts=slow), ()))
    assert model.facts == slow
    scenario = SCENARIOS["autolock"]
    for facts, told in ((USUAL_FACTS, "every 0.20 s"), (model.facts, "every 0.80 s")):
        caution, = plan_of(scenario, scenario.parameters_type(), USUAL_CAR, True, facts).cautions
        assert told in caution


def test_car_without_a_bus_tells_nothing_beforehand():
    class Bus(AbsentCarLink, BusMonitor):
        """One whose profile is known."""
        facts = LockFacts(told_every_s=0.8)
        traffic = None
    car = Bus()
    assert known_facts(car) is None
    Bus.traffic = BusTraffic(0.1, 0.8, 0.8)
    assert known_facts(car) == LockFacts(told_every_s=0.8)


def test_nothing_heard_is_communication_lost():
    assert readiness_of(None, 0.0, Phase.IDLE).word is ReadinessWord.LOST
    assert readiness_of(snapshot(), 1.6, Phase.MEASURING).word is ReadinessWord.LOST


@pytest.mark.parametrize(("robot", "word", "cause"), [
    (snapshot(), ReadinessWord.READY, None),
    (snapshot(mode=Mode.READY_TO_MAP_CAR, pose_valid=False), ReadinessWord.READY, None),
    (snapshot(battery_percent=20), ReadinessWord.WARNINGS, Cause.BATTERY_LOW),
    (snapshot(battery_percent=9), ReadinessWord.NOT_READY, Cause.BATTERY_EMPTY),
    (snapshot(battery_percent=None), ReadinessWord.NOT_READY, Cause.BATTERY_UNKNOWN),
    (snapshot(mode=Mode.STARTING), ReadinessWord.NOT_READY, Cause.ROBOT_STARTING),
    (snapshot(mode=Mode.FAULT), ReadinessWord.NOT_READY, Cause.ROBOT_FAULT),
    (snapshot(controlled_by_other=True), ReadinessWord.NOT_READY, Cause.OTHER_OPERATOR),
    (snapshot(pose_valid=False), ReadinessWord.NOT_READY, Cause.POSITION_LOST),
    (snapshot(notifications=(Notification("x", 2, "Slow."),)), ReadinessWord.WARNINGS, Cause.NOTIFICATION),
    (snapshot(notifications=(Notification("x", 3, "Broken."),)), ReadinessWord.NOT_READY, Cause.NOTIFICATION),
    (snapshot(notifications=(Notification("mode", 1, "Waits."),)), ReadinessWord.READY, None),
    (snapshot(LockState.UNKNOWN, NO_ADAPTER), ReadinessWord.NOT_READY, Cause.NO_CAN),
    (snapshot(LockState.UNKNOWN, "No CAN frame."), ReadinessWord.NOT_READY, Cause.CAN_PROBLEM),
    (snapshot(LockState.UNKNOWN), ReadinessWord.NOT_READY, Cause.LOCKS_UNKNOWN),
])
def test_each_cause_has_its_word(robot, word, cause):
    readiness = readiness_of(robot, 0.0, Phase.IDLE)
    assert readiness.word is word
    assert [reason.cause for reason in readiness.reasons] == ([] if cause is None else [cause])
    assert readiness.can_start is (word in (ReadinessWord.READY, ReadinessWord.WARNINGS))


def test_blocking_reasons_come_first():
    reasons = readiness_of(snapshot(LockState.UNKNOWN, battery_percent=20), 0.0, Phase.IDLE).reasons
    assert [reason.is_blocking for reason in reasons] == [True, False]


@pytest.mark.parametrize(("phase", "is_blocking"), [
    (Phase.IDLE, True), (Phase.PAUSED, True), (Phase.MEASURING, False)])
def test_unknown_charge_hinders_a_start_and_warns_in_a_test(phase, is_blocking):
    reason, = readiness_of(snapshot(battery_percent=None), 0.0, phase).reasons
    assert (reason.cause, reason.is_blocking) == (Cause.BATTERY_UNKNOWN, is_blocking)


def test_paused_test_goes_on_only_when_nothing_stands_against_it():
    assert can_resume(readiness_of(snapshot(), 0.0, Phase.PAUSED))
    assert not can_resume(readiness_of(snapshot(problem="No CAN frame."), 0.0, Phase.PAUSED))
    assert not can_resume(readiness_of(snapshot(), 5.0, Phase.PAUSED))


@pytest.mark.parametrize("name", list(SCENARIOS))
def test_plan_has_a_stretch_and_a_time_for_each_line(name):
    scenario = SCENARIOS[name]
    parameters = scenario.parameters_type()
    plan = plan_of(scenario, parameters, USUAL_CAR, False)
    assert len(plan.stretches) == len(plan.lines_s) == len(scenario.lines(parameters, USUAL_CAR))
    assert all(seconds > 0.0 for seconds in plan.lines_s)
    assert plan.duration_s > plan_of(scenario, parameters, USUAL_CAR, True).duration_s
    for stretch in plan.stretches:
        assert math.dist(stretch.start, stretch.end) == pytest.approx(
            parameters.maximum_distance_m - parameters.minimum_distance_m)


def test_slower_and_more_lines_take_longer():
    scenario = SCENARIOS["autolock"]
    usual = plan_of(scenario, scenario.parameters_type(), USUAL_CAR, True).duration_s
    slow = plan_of(scenario, scenario.parameters_type(measuring_speed_mps=0.2), USUAL_CAR, True).duration_s
    dense = plan_of(scenario, scenario.parameters_type(measurements_distance_m=0.2), USUAL_CAR, True).duration_s
    assert slow > usual
    assert dense > usual


def test_battery_has_to_leave_a_reserve():
    scenario = SCENARIOS["autolock"]
    plan = plan_of(scenario, scenario.parameters_type(), USUAL_CAR, False)
    assert plan.suffices(plan.battery_percent + 15.0)
    assert not plan.suffices(plan.battery_percent + 14.9)


def test_time_left_learns_from_the_pace():
    left = TimeLeft((10.0, 10.0, 10.0, 10.0))
    assert left.left_s(0.0) is None
    left.begin(0, 100.0)
    assert left.left_s(105.0) == pytest.approx(35.0)
    left.advance(1, 120.0)  # twice as slow as expected
    assert left.left_s(120.0) == pytest.approx(60.0)
    assert left.left_s(130.0) == pytest.approx(50.0)


def test_time_left_does_not_come_to_an_end_while_lines_are_left__B3():
    left = TimeLeft((10.0, 10.0, 10.0, 10.0))
    left.begin(1, 100.0)
    assert left.left_s(1000.0) == pytest.approx(20.0)
    left.advance(3, 120.0)
    assert left.left_s(1000.0) == 0.0


def test_time_left_counts_what_comes_before_the_lines__B3():
    left = TimeLeft((10.0, 10.0), 62.0)
    left.begin(0, 100.0)
    assert left.left_s(100.0) == pytest.approx(82.0)
    assert left.left_s(150.0) == pytest.approx(32.0)
    assert left.left_s(500.0) == pytest.approx(20.0)


def test_time_of_a_pause_does_not_count():
    left = TimeLeft((10.0, 10.0, 10.0))
    left.begin(1, 5000.0)
    assert left.left_s(5000.0) == pytest.approx(20.0)


def test_mailbox_wakes_once_and_thins_out_the_trail():
    woken = []
    mailbox = Mailbox(lambda: woken.append(1))
    for number in range(3 * MAX_TRAIL):
        mailbox.put_robot(snapshot(x=float(number), y=0.0))
    mailbox.put(ActionBegun("a"))
    batch = mailbox.take()
    assert len(woken) == 1
    assert len(batch.trail) <= MAX_TRAIL
    assert (batch.trail[0], batch.trail[-1]) == ((0.0, 0.0), (3.0 * MAX_TRAIL - 1, 0.0))
    assert batch.events == (ActionBegun("a"),)
    assert mailbox.take().robot is None
    mailbox.put(ActionBegun("b"))
    assert len(woken) == 2


def trail_of(*snapshots):
    mailbox, model = Mailbox(), ViewModel()
    model.test = object()
    for each in snapshots:
        mailbox.put_robot(each)
    model.apply(mailbox.take())
    return model.trail


CAR = CarDimensions(4.5, 1.8, 0.01, 0.01)


def test_trail_begins_anew_when_the_robot_was_restarted__B4():
    before, after = (snapshot(x=x, y=0.0, car=CAR, robot_session_id=number)
                     for x, number in ((3.0, 1), (-3.0, 2)))
    assert trail_of(before, after) == [(-3.0, 0.0)]


def test_trail_begins_anew_when_the_car_is_mapped_anew__B4():
    assert trail_of(snapshot(x=3.0, y=0.0, car=CAR), snapshot(pose_valid=False), snapshot(x=2.0, y=2.0, car=CAR)) == [
        (2.0, 2.0)]


@pytest.mark.parametrize("between", [[], [snapshot(pose_valid=False, car=CAR)]])
def test_trail_has_a_gap_where_nobody_saw_the_robot_drive__B4(between):
    far = [snapshot(x=x, y=0.0, car=CAR) for x in (3.0, -3.0)]
    assert trail_of(far[0], *between, far[1]) == [(3.0, 0.0), None, (-3.0, 0.0)]


def test_trail_that_is_thinned_out_keeps_its_gaps__B4():
    assert thinned([(0.0, 0.0), (1.0, 0.0), None, (5.0, 0.0), (6.0, 0.0)]) == [(0.0, 0.0), None, (6.0, 0.0)]
