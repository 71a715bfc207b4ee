"""The checklist: each item by what is known, and never greener than the status word."""
# SPDX-License-Identifier: Apache-2.0
import dataclasses
import math

import pytest

from mtr_operator.domain.absent_car import NO_ADAPTER
from mtr_operator.domain.ports import BusTraffic, LockState
from mtr_operator.domain.robot_status import (
    AreaState,
    CarDimensions,
    EmergencyStop,
    Mode,
    Notification,
    PreflightItem,
    PreflightReport,
    Problem,
    RobotStatus,
)
from mtr_operator.domain.scenarios import SCENARIOS
from mtr_operator.domain.supervision.car_signals import DOOR, GEAR, IGNITION, SPEED, CarSignal, SignalState
from mtr_operator.domain.supervision.conditions import CONDITIONS
from mtr_operator.station.alert import Alert, Heard, alert_of
from mtr_operator.station.checks.check_texts import check_advice, check_text
from mtr_operator.station.checks.checklist import CONDITION_OF, UNSEEN, Facts, Wanted, checklist, hindrances
from mtr_operator.station.checks.finding import Check, Finding, State
from mtr_operator.station.checks.preflight_check import OLD_AFTER_S
from mtr_operator.station.disk_watch import free_bytes
from mtr_operator.station.estimate import USUAL_CAR, plan_of
from mtr_operator.station.events import RobotSnapshot
from mtr_operator.station.mailbox import Mailbox
from mtr_operator.station.readiness import (
    RUNNING,
    Cause,
    Phase,
    Readiness,
    ReadinessWord,
    Reason,
    can_resume,
    readiness_of,
)
from mtr_operator.station.sight.ways import Ways

STATUS = RobotStatus(id=1, robot_session_id=1, stamp_s=1.0, pose_valid=True, mode=Mode.FOLLOWING_WAYPOINT,
                     battery_percent=80, position_sigma_m=0.02, sent_s=1.0, steady_s=1.0,
                     emergency_stop=EmergencyStop.RELEASED,
                     area=AreaState(True, False, 1, 9, ((4.0, 4.0), (-4.0, 4.0), (-4.0, -4.0)), 9))
TRAFFIC = BusTraffic(0.3, 0.1, 0.1)
LIDAR = Problem("drive_control.lidar_covered", (("lidar", "rear LiDAR"),), "The rear LiDAR is covered.")


FINE, FULL = PreflightItem("/imu/data", False, "50 Hz."), PreflightItem("disk", True, "Full.")


def after_preflight(*found, age_s=180.0):
    report = PreflightReport(1000.0 - age_s, found, len(found), sum(item.is_bad for item in found))
    return dataclasses.replace(snapshot(sent_s=1000.0, steady_s=1000.0), preflight=report)


def snapshot(lock=LockState.LOCKED, problem="", traffic=TRAFFIC, is_secret=False, is_exposed=False, **changes):
    return RobotSnapshot(dataclasses.replace(STATUS, **changes), lock, problem, None, is_secret, traffic,
                         is_exposed=is_exposed)


def items(robot, silent_s=0.1, **facts):
    return {item.check: item for item in checklist(Facts(robot, silent_s, **facts))}


def test_each_thing_is_looked_at_in_its_order():
    shown = checklist(Facts(snapshot(), 0.1, free_bytes=10 ** 11))
    assert [item.check for item in shown] == list(Check)
    assert {item.check for item in shown if item.state is not State.GOOD} == {
        Check.PREFLIGHT, Check.SIZE, Check.WAY, *UNSEEN, Check.SIGNALS, Check.ROBOT_CLOCK, Check.KEY, Check.LIMITS}
    assert not hindrances(shown)


@pytest.mark.parametrize("silent_s", [0.1, 9.0])
@pytest.mark.parametrize(("check", "words"), [
    (Check.STOP_TRIAL, ("lost controller", "receiver", "Press the stop button", "release")),
    (Check.GROUND, ("lying", "chocks", "Walk around")), (Check.CABLES, ("CAN cable", "charging cable")),
    (Check.OPENINGS, ("hatch", "by itself", "boot")), (Check.FITTINGS, ("tow bar", "rear_fitting_m")),
    (Check.AREA, ("2 m free", "stairs", "dock", "kerb")), (Check.PEOPLE, ("adults", "kneels")),
    (Check.WEATHER, ("ice", "fog", "low sun", "8 m/s")), (Check.LIGHT, ("lit",)),
    (Check.CAR, ("brake", "gear P", "chocks", "cabin empty", "alarm")),
    (Check.ATTENDANCE, ("10 m", "in sight", "hardware emergency stop"))])
def test_what_no_sensor_shows_is_for_a_person_to_check(check, words, silent_s):
    item = items(snapshot(), silent_s)[check]
    assert item.state is State.UNKNOWN
    shown = f"{check_text(item)} {check_advice(item)}"
    assert all(word in shown for word in words)
    assert all(len(sentence.split()) <= 30 for sentence in (check_text(item), check_advice(item)))


def test_operating_conditions_are_items_and_good_once_a_person_has_confirmed_them():
    assert list(CONDITION_OF.values()) == list(CONDITIONS)
    for check, name in CONDITION_OF.items():
        found = items(snapshot(), wanted=Wanted(confirmed=(name,)))
        assert (found[check].state, found[check].finding) == (State.GOOD, Finding.CONFIRMED)
        assert all(found[other].state is State.UNKNOWN for other in UNSEEN if other is not check)


IGNITION_ON = CarSignal(IGNITION, "Terminal of Power", SignalState.ACTIVE)
GEAR_SILENT = CarSignal(GEAR, "Lever of Gear", SignalState.UNKNOWN)
ALL_CLEAR = tuple(CarSignal(kind, "Signal", SignalState.CLEAR) for kind in (IGNITION, GEAR, SPEED, DOOR))


@pytest.mark.parametrize("signals, state, finding, words", [
    ((), State.UNKNOWN, Finding.SIGNALS_UNNAMED, "names no signal for: ignition, gear, speed, door. Watch them"),
    (ALL_CLEAR[1:], State.UNKNOWN, Finding.SIGNALS_UNNAMED, "names no signal for: ignition. Watch"),
    (ALL_CLEAR, State.GOOD, Finding.SIGNALS_FINE, "are received"),
    ((*ALL_CLEAR, GEAR_SILENT), State.UNKNOWN, Finding.SIGNALS_SILENT, "Not received from the Car: Lever of Gear."),
    ((GEAR_SILENT, IGNITION_ON), State.BAD, Finding.SIGNAL_ACTIVE, "ignition is on (signal Terminal of Power).")])
def test_signals_of_the_car_are_looked_at_before_a_test(signals, state, finding, words):
    robot = dataclasses.replace(snapshot(), signals=signals)
    item = items(robot)[Check.SIGNALS]
    assert (item.state, item.finding) == (state, finding)
    assert words in f"{check_text(item)} {check_advice(item)}"
    readiness = readiness_of(robot, 0.1, Phase.IDLE)
    assert readiness.can_start is (state is not State.BAD)


def test_door_that_the_bus_tells_open_is_noted():
    opened = CarSignal(DOOR, "Tail of Doors", SignalState.ACTIVE, "tailgate")
    item = items(dataclasses.replace(snapshot(), signals=(opened,)))[Check.OPENINGS]
    assert (item.state, item.finding) == (State.NOTE, Finding.OPENINGS_OPEN)
    assert check_text(item) == "A door or lid of the Car is open: tailgate (signal Tail of Doors)."


def real(report, steady_s=50_000.0):
    """A robot whose clock tells the date."""
    return dataclasses.replace(snapshot(sent_s=1.7e9, steady_s=steady_s), preflight=report)


MOVED = PreflightReport(49_000.0, (FINE,), 1, 0, 48_000.0)


@pytest.mark.parametrize("report, state, finding", [
    (None, State.BAD, Finding.PREFLIGHT_UNTOLD), (PreflightReport(), State.BAD, Finding.PREFLIGHT_NEVER),
    (dataclasses.replace(MOVED, motion_made_s=math.nan), State.BAD, Finding.PREFLIGHT_AT_REST),
    (dataclasses.replace(MOVED, motion_made_s=1.0), State.BAD, Finding.PREFLIGHT_OLD),
    (MOVED, State.GOOD, Finding.PREFLIGHT_FINE)])
def test_real_robot_needs_a_preflight_in_motion(report, state, finding):
    item = items(real(report))[Check.PREFLIGHT]
    assert (item.state, item.finding) == (state, finding)
    assert state is State.GOOD or "preflight" in check_advice(item)
    assert readiness_of(real(report), 0.1, Phase.IDLE).can_start is (state is State.GOOD)
    # A test that runs goes on.
    assert readiness_of(real(report), 0.1, Phase.MEASURING).word is ReadinessWord.MEASURING


@pytest.mark.parametrize(("ways", "state", "finding", "said"), [
    (None, State.UNKNOWN, Finding.WAY_TO_COME, ""), (Ways(), State.GOOD, Finding.WAY_FREE, ""),
    (Ways(("3", "7"), 2.5, ("8",)), State.NOTE, Finding.WAY_HINDERED, "3, 7"),
    (Ways(unseen=("1", "2", "3")), State.UNKNOWN, Finding.WAY_UNSEEN, "1\u20133")])
def test_way_of_the_lines_is_told_and_hinders_no_test(ways, state, finding, said):
    item = items(snapshot(), wanted=Wanted(ways=ways))[Check.WAY]
    assert (item.state, item.finding, item.said) == (state, finding, said)


@pytest.mark.parametrize(("robot", "check", "state", "finding"), [
    (snapshot(is_secret=True), Check.ENCRYPTION, State.GOOD, Finding.ENCRYPTED),
    (snapshot(is_exposed=True), Check.ENCRYPTION, State.NOTE, Finding.NOT_ENCRYPTED),
    (snapshot(), Check.ENCRYPTION, State.GOOD, Finding.LOCAL_LINK),
    (snapshot(mode=Mode.STARTING), Check.ROBOT, State.BAD, Finding.ROBOT_STARTING),
    (snapshot(mode=Mode.FAULT), Check.ROBOT, State.BAD, Finding.ROBOT_FAULT),
    (snapshot(controlled_by_other=True), Check.ROBOT, State.BAD, Finding.OTHER_OPERATOR),
    (snapshot(notifications=(Notification("x", 3, "Broken."),)), Check.ROBOT, State.BAD, Finding.ROBOT_SAYS),
    (snapshot(notifications=(Notification("x", 2, "Slow."),)), Check.ROBOT, State.NOTE, Finding.ROBOT_SAYS),
    (snapshot(notifications=(Notification("held", 3, "Held."),)), Check.ROBOT, State.NOTE, Finding.ROBOT_SAYS),
    (snapshot(emergency_stop=EmergencyStop.ENGAGED), Check.EMERGENCY_STOP, State.NOTE, Finding.STOP_ENGAGED),
    (snapshot(emergency_stop=EmergencyStop.ABSENT), Check.EMERGENCY_STOP, State.NOTE, Finding.STOP_ABSENT),
    (snapshot(emergency_stop=EmergencyStop.ABSENT, notifications=(Notification("no_emergency_stop", 3, "None."),)),
     Check.EMERGENCY_STOP, State.BAD, Finding.STOP_MISSING),
    (snapshot(emergency_stop=EmergencyStop.UNKNOWN), Check.EMERGENCY_STOP, State.UNKNOWN, Finding.STOP_UNKNOWN),
    (snapshot(pose_valid=False), Check.POSITION, State.BAD, Finding.POSITION_LOST),
    (snapshot(pose_valid=False, mode=Mode.READY_TO_MAP_CAR), Check.POSITION, State.GOOD, Finding.POSITION_TO_COME),
    (snapshot(), Check.SIZE, State.UNKNOWN, Finding.SIZE_TO_COME),
    (snapshot(car=CarDimensions(4.5, 1.8, 0.005, 0.005)), Check.SIZE, State.GOOD, Finding.SIZE_KNOWN),
    (snapshot(car=CarDimensions(4.5, 1.8, 0.005, 0.07)), Check.SIZE, State.NOTE, Finding.SIZE_OF_PLANE),
    (snapshot(notifications=(Notification("fault", 3, "Stands.", (LIDAR,)),)), Check.LIDARS, State.GOOD,
     Finding.LIDARS_FINE),
    (snapshot(notifications=(Notification("mode", 2, "Stands.", (LIDAR,)),)), Check.LIDARS, State.NOTE,
     Finding.PART_TROUBLED),
    (snapshot(notifications=(Notification("peripherals", 2, "Slow."),)), Check.BOARD, State.NOTE,
     Finding.PART_TROUBLED),
    (snapshot(notifications=(Notification("peripherals_silent", 3, "Silent."),)), Check.BOARD, State.BAD,
     Finding.PART_TROUBLED),
    (snapshot(battery_percent=None), Check.BATTERY, State.BAD, Finding.BATTERY_UNKNOWN),
    (snapshot(battery_percent=20), Check.BATTERY, State.NOTE, Finding.BATTERY_LOW),
    (snapshot(battery_percent=9), Check.BATTERY, State.BAD, Finding.BATTERY_EMPTY),
    (snapshot(LockState.UNKNOWN, NO_ADAPTER, None), Check.BUS, State.BAD, Finding.NO_ADAPTER),
    (snapshot(LockState.UNKNOWN, "No CAN frame."), Check.BUS, State.BAD, Finding.BUS_TROUBLED),
    (snapshot(traffic=BusTraffic(0.75, 0.1, 0.1)), Check.BUS, State.NOTE, Finding.BUS_FULL),
    (snapshot(traffic=BusTraffic(0.3, 0.4, 0.1)), Check.BUS, State.NOTE, Finding.BUS_SLOW),
    (snapshot(traffic=None), Check.BUS, State.GOOD, Finding.BUS_SIMULATED),
    (snapshot(LockState.UNKNOWN), Check.LOCKS, State.BAD, Finding.LOCKS_UNKNOWN),
    (snapshot(LockState.UNKNOWN, "The clock jumped.", BusTraffic(0.3, 0.1, 0.1, "The clock jumped.")), Check.CLOCK,
     State.BAD, Finding.CLOCK_NOT_MAPPED),
    (snapshot(LockState.UNKNOWN, "The clock jumped.", BusTraffic(0.3, 0.1, 0.1, "The clock jumped.")), Check.BUS,
     State.GOOD, Finding.BUS_FINE),
])
def test_each_item_says_what_was_found(robot, check, state, finding):
    assert (items(robot)[check].state, items(robot)[check].finding) == (state, finding)


@pytest.mark.parametrize("robot", [
    snapshot(), snapshot(mode=Mode.STARTING), snapshot(mode=Mode.FAULT), snapshot(controlled_by_other=True),
    snapshot(pose_valid=False), snapshot(pose_valid=False, mode=Mode.READY_TO_MAP_CAR), snapshot(battery_percent=9),
    snapshot(battery_percent=None), snapshot(battery_percent=20), snapshot(LockState.UNKNOWN),
    snapshot(LockState.UNKNOWN, NO_ADAPTER),
    snapshot(LockState.UNKNOWN, "No CAN frame."), snapshot(notifications=(Notification("x", 3, "Broken."),)),
    snapshot(notifications=(Notification("held", 3, "Held."),)),
    snapshot(notifications=(Notification("no_emergency_stop", 3, "None."),)),
    snapshot(notifications=(Notification("link_lost", 3, "Lost."),)),
    snapshot(notifications=(Notification("disk_full", 3, "Full."),)),
    snapshot(notifications=(Notification("x", 3, "Stands.", (LIDAR,)),)),
    snapshot(notifications=(Notification("peripherals_silent", 3, "Silent."),)),
    after_preflight(FINE), after_preflight(FINE, age_s=1e6), after_preflight(FULL, FINE),
    after_preflight(FULL, age_s=1e6), after_preflight(FULL, age_s=-100.0)])
def test_list_and_status_word_never_contradict_each_other__B10(robot):
    can_start = readiness_of(robot, 0.1, Phase.IDLE).can_start
    assert bool(hindrances(checklist(Facts(robot, 0.1, free_bytes=10 ** 11)))) is not can_start


@pytest.mark.parametrize("silent_s", [1.6, 60.0])
def test_silent_robot_leaves_everything_of_it_open(silent_s):
    shown = items(snapshot(), silent_s)
    assert shown[Check.LINK].finding is Finding.LINK_SILENT and shown[Check.LINK].numbers == (silent_s,)
    assert {item.finding for check, item in shown.items()
            if check not in (Check.LINK, Check.DISK, Check.LIMITS, *UNSEEN)} == {Finding.UNHEARD}
    assert items(None)[Check.LINK].state is State.BAD


def test_battery_is_measured_by_the_plan():
    scenario = SCENARIOS["autolock"]
    plan = plan_of(scenario, scenario.parameters_type(measurements_distance_m=0.3), USUAL_CAR, False)
    wanted = Wanted(plan)
    assert items(snapshot(battery_percent=100), wanted=wanted)[Check.BATTERY].finding is Finding.BATTERY_SUFFICES
    short = items(snapshot(battery_percent=math.ceil(plan.battery_percent) + 10), wanted=wanted)[Check.BATTERY]
    assert (short.finding, short.numbers[1]) == (Finding.BATTERY_SHORT, plan.battery_percent)


@pytest.mark.parametrize(("free", "state"), [
    (None, State.UNKNOWN), (10_000_000, State.BAD), (400_000_000, State.NOTE), (10 ** 11, State.GOOD)])
def test_room_on_the_disk(free, state):
    assert items(snapshot(), free_bytes=free)[Check.DISK].state is state


@pytest.mark.parametrize(("robot", "state", "finding", "said", "numbers"), [
    (snapshot(), State.UNKNOWN, Finding.PREFLIGHT_UNTOLD, "", ()),
    (dataclasses.replace(snapshot(), preflight=PreflightReport()), State.UNKNOWN, Finding.PREFLIGHT_NEVER, "", ()),
    (after_preflight(FINE, FINE), State.GOOD, Finding.PREFLIGHT_FINE, "", (2, 2, 180.0)),
    (after_preflight(FINE, age_s=-0.5), State.GOOD, Finding.PREFLIGHT_FINE, "", (1, 1, 0.0)),
    (after_preflight(FINE, age_s=OLD_AFTER_S + 1.0), State.NOTE, Finding.PREFLIGHT_OLD, "", (1, 1, OLD_AFTER_S + 1.0)),
    (after_preflight(FULL, FINE), State.BAD, Finding.PREFLIGHT_BAD, "disk: Full.", (1, 2, 180.0)),
    (after_preflight(FULL, age_s=OLD_AFTER_S + 1.0), State.BAD, Finding.PREFLIGHT_BAD, "disk: Full.",
     (1, 1, OLD_AFTER_S + 1.0)),
    (after_preflight(FULL, age_s=-100.0), State.UNKNOWN, Finding.PREFLIGHT_NEVER, "", ())])
def test_preflight_is_told_with_its_age(robot, state, finding, said, numbers):
    item = items(robot)[Check.PREFLIGHT]
    assert (item.state, item.finding, item.said, item.numbers) == (state, finding, said, numbers)


def test_preflight_brings_all_its_sentences():
    assert items(after_preflight(FULL, FINE))[Check.PREFLIGHT].parts == (
        (State.BAD, "disk: Full."), (State.GOOD, "/imu/data: 50 Hz."))


def test_bad_preflight_hinders_a_start_and_not_a_test_that_runs():
    robot = after_preflight(FULL)
    assert readiness_of(robot, 0.1, Phase.IDLE).reasons == (Reason(Cause.PREFLIGHT_BAD, True, "disk: Full."),)
    assert not can_resume(readiness_of(robot, 0.1, Phase.PAUSED))
    assert readiness_of(robot, 0.1, Phase.MEASURING) == Readiness(ReadinessWord.MEASURING)


def test_full_disk_of_the_robot_hinders_a_start_and_not_a_test_that_runs():
    robot = snapshot(notifications=(Notification("disk_full", 3, "The disk is full."),))
    assert readiness_of(robot, 0.1, Phase.IDLE) == Readiness(
        ReadinessWord.NOT_READY, (Reason(Cause.NOTIFICATION, True, "The disk is full."),))
    assert not can_resume(readiness_of(robot, 0.1, Phase.PAUSED))
    for phase in RUNNING:
        assert readiness_of(robot, 0.1, phase) == Readiness(
            ReadinessWord.MEASURING, (Reason(Cause.NOTIFICATION, False, "The disk is full."),))


def test_preflight_is_kept_between_its_statuses_and_ends_with_the_robot():
    mailbox, report = Mailbox(), PreflightReport(1.0, (FINE,), 1, 0)
    kept = []
    for changes in ({}, {"preflight": report}, {}, {"robot_session_id": 2}):
        mailbox.put_robot(snapshot(**changes))
        kept.append(mailbox.take().robot.preflight)
    assert kept == [None, report, report, None]


def test_room_is_that_where_the_folder_will_be_made(tmp_path):
    assert free_bytes(tmp_path / "not" / "there") == pytest.approx(free_bytes(tmp_path), rel=0.05)


@pytest.mark.parametrize(("answered_s", "state"), [(None, State.UNKNOWN), (5.0, State.GOOD), (61.0, State.UNKNOWN)])
def test_key_counts_as_awake_for_as_long_as_it_stays_so(answered_s, state):
    assert items(snapshot(), answered_s=answered_s)[Check.KEY].state is state


def test_limits_are_counted_and_their_fault_is_told():
    assert items(snapshot(), wanted=Wanted(limits=3))[Check.LIMITS].numbers == (3,)
    unfit = items(snapshot(), wanted=Wanted(limits=3, limits_problem="No such line."))[Check.LIMITS]
    assert (unfit.state, unfit.said) == (State.BAD, "No such line.")


REST = Heard(False, ReadinessWord.READY, Phase.IDLE, False)
RUN = Heard(True, ReadinessWord.MEASURING, Phase.MEASURING, False)


@pytest.mark.parametrize(("before", "now", "alert"), [
    (REST, REST, None), (REST, RUN, Alert.MOVES), (RUN, RUN, None),
    (RUN, Heard(False, ReadinessWord.READY, Phase.FINISHED, False), Alert.DONE),
    (RUN, Heard(False, ReadinessWord.PAUSED, Phase.PAUSED, False), None),
    (RUN, Heard(False, ReadinessWord.PAUSED, Phase.PAUSED, True), Alert.TROUBLE),
    (RUN, dataclasses.replace(RUN, word=ReadinessWord.BLOCKED), Alert.TROUBLE),
    (RUN, dataclasses.replace(RUN, word=ReadinessWord.LOST), Alert.TROUBLE),
    (REST, dataclasses.replace(REST, word=ReadinessWord.LOST), None)])
def test_what_is_to_be_heard(before, now, alert):
    assert alert_of(before, now) is alert
