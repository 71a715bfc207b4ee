"""The link during lost messages, clock steps and messages of strangers."""
# SPDX-License-Identifier: Apache-2.0
import math
import random

import pytest
from dispatcher_link import START_S, Link

from mtr_core.problems import NO_PROBLEM, Problem
from mtr_core.requests import Press, Waypoint
from mtr_core.se2 import Pose2
from mtr_dispatcher.command import MAX_BUTTON, Command
from mtr_dispatcher.order_numbers import OrderNumbers
from mtr_dispatcher.parameters import Parameters
from mtr_dispatcher.sent_statuses import KEPT, SentStatuses
from mtr_dispatcher.session import MAX_FIRST_ID, MAX_ID_STEP, CommandResult, ControlSession
from mtr_dispatcher.status.emergency import EmergencyStop, EmergencyWatch
from mtr_dispatcher.status.inputs import Inputs
from mtr_dispatcher.status.interventions import Interventions
from mtr_dispatcher.status.notices import MAX_FOREIGN, ForeignApplications
from mtr_dispatcher.status.texts import MAX_TEXT
from mtr_msgs.msg import CarEstimate, DriveStatus, MotionStatus, PeripheralsState, RobotMode
from mtr_msgs.msg import Problem as ProblemMessage
from mtr_proto import robot_link_pb2 as link

STEPS_S = [0.05, -0.05, 0.4, -0.4, 60.0, -60.0, 3600.0, -3600.0]
MAX_STATUS_BYTES = 64 * 1024


def drive_order():
    return link.Waypoint(id=1, x=3.0, y=0.0, heading=0.0)


@pytest.mark.parametrize("resend_s", [0.05, 0.2, 0.3, 0.999])
def test_moving_order_ends_one_second_after_the_status_that_it_answers_whatever_is_lost(resend_s):  # A5
    robot = Link()
    last_seen = robot.status()
    robot.command(last_seen, waypoint=drive_order())
    assert robot.moves()
    moved_until_s, next_s = START_S, START_S + resend_s
    while robot.steady_s < START_S + 3.0:
        robot.steady_s += 0.01
        robot.status()
        if robot.steady_s >= next_s:
            robot.command(last_seen, waypoint=drive_order())
            next_s += resend_s
        if robot.moves():
            moved_until_s = robot.steady_s
    assert moved_until_s - START_S <= 1.0 + 1e-6


@pytest.mark.parametrize("silence_s, limit_mps, moves", [
    (0.0, math.inf, True), (0.39, math.inf, True), (0.41, 0.3, True), (0.89, 0.3, True), (1.01, 0.3, False)])
def test_silent_link_slows_the_robot_before_it_stops_it(silence_s, limit_mps, moves):
    robot = Link()
    robot.command(robot.status(), waypoint=drive_order())
    robot.steady_s += silence_s
    assert robot.core.desired(robot.steady_s).speed_limit_mps == limit_mps and robot.moves() is moves
    robot.command(robot.status(), waypoint=drive_order())
    assert robot.core.desired(robot.steady_s).speed_limit_mps == math.inf and robot.moves()


def driving(speed_mps, source="planner"):
    return DriveStatus(source=source, linear_mps=speed_mps)


@pytest.mark.parametrize("drive, silence_s, moves", [
    (driving(0.71), 0.69, True), (driving(0.71), 0.71, False), (driving(-0.71), 0.71, False),
    (driving(0.36), 0.71, False), (driving(math.nan), 0.71, False), (driving(0.35), 0.89, True),
    (driving(0.30), 0.89, True), (driving(0.30), 0.91, False), (driving(0.71, "manual"), 0.89, True),
    (None, 0.89, True), (None, 0.91, False)])
def test_silence_that_stops_the_robot_is_shorter_while_the_planner_drives_fast(drive, silence_s, moves):
    robot = Link()
    robot.command(robot.status(drive=drive), waypoint=drive_order())
    robot.steady_s += silence_s
    assert robot.moves() is moves


def test_robot_that_was_too_fast_for_its_link_stays_stopped_while_it_brakes():
    robot = Link()
    robot.command(robot.status(drive=driving(0.71)), waypoint=drive_order())
    for _ in range(5):
        robot.steady_s += 0.15
        robot.status(drive=driving(0.71))
    assert not robot.moves()
    robot.steady_s += 0.1
    newest = robot.status(drive=driving(0.0, "locked"))
    assert not robot.moves()
    robot.command(newest, waypoint=drive_order())
    assert robot.moves()
    robot.steady_s += 0.1
    robot.command(robot.status(drive=driving(0.2)), waypoint=drive_order())
    robot.steady_s += 0.89
    assert robot.moves()


def test_robot_without_a_session_has_no_speed_limit_of_the_link():
    robot = Link()
    robot.steady_s += 100.0
    assert robot.core.desired(robot.steady_s).speed_limit_mps == math.inf


class Air:
    """A TCP connection over Wi-Fi: a lost packet is repeated after a delay, and later ones wait for it."""

    def __init__(self, loss, delay_s, pause_s=0.0):
        self._random, self._loss, self._delay_s, self._pause_s = random.Random(1), loss, delay_s, pause_s
        self._waiting, self._newest_s = [], 0.0

    def send(self, now_s, message):
        arrival_s, repeat_s = now_s + self._delay_s * self._random.uniform(0.2, 1.0), 0.2
        while self._random.random() < self._loss:
            arrival_s, repeat_s = arrival_s + repeat_s, 2.0 * repeat_s
        # Every half minute the laptop changes the access point.
        if now_s % 30.0 < self._pause_s:
            arrival_s += self._pause_s
        self._newest_s = max(self._newest_s, arrival_s)
        self._waiting.append((self._newest_s, message))

    def arrived(self, now_s):
        arrived = [message for time_s, message in self._waiting if time_s <= now_s]
        self._waiting = [each for each in self._waiting if each[0] > now_s]
        return arrived


@pytest.mark.parametrize("loss, delay_s, pause_s, slow_share, stops", [
    (0.001, 0.015, 0.0, 0.005, 0), (0.01, 0.04, 0.0, 0.03, 0), (0.02, 0.06, 0.0, 0.08, 3), (0.0, 0.1, 0.0, 0.0, 0)],
    ids=["good", "ordinary", "unreliable", "late"])
def test_ordinary_wifi_neither_slows_the_robot_for_long_nor_stops_it(loss, delay_s, pause_s, slow_share, stops):
    robot, down, up = Link(), Air(loss, delay_s, pause_s), Air(loss, delay_s, pause_s)
    slow = stopped = steps = 0
    was_moving = True
    while robot.steady_s < START_S + 120.0:
        steps += 1
        if steps % 5 == 0:
            down.send(robot.steady_s, robot.status(drive=driving(0.71)))
        for answered in down.arrived(robot.steady_s):
            up.send(robot.steady_s, answered)
        for answered in up.arrived(robot.steady_s):
            robot.command(answered, waypoint=drive_order())
        slow += robot.core.desired(robot.steady_s).speed_limit_mps < math.inf
        stopped += was_moving and not robot.moves()
        was_moving = robot.moves()
        robot.steady_s = START_S + 0.02 * steps
    # The robot waits for the first answer. A stop instead of the limit would occur in each slow phase.
    assert slow / steps <= slow_share and stopped <= stops + 1


def test_command_at_the_end_of_its_life_does_not_prolong_the_link():  # A5
    robot = Link()
    robot.command(robot.status())
    answered = robot.status()
    robot.steady_s += 0.899
    assert robot.command(answered) is CommandResult.REPEATED and robot.moves()
    robot.steady_s += 0.002
    assert not robot.moves(), "at the next turn, 0.1 s later, more than a second would be over"
    robot.steady_s += 0.098
    assert robot.command(answered) is CommandResult.REPEATED and not robot.moves()


@pytest.mark.parametrize("step_s", STEPS_S)
def test_setting_the_robots_clock_changes_nothing_of_the_link(step_s):  # A10
    robot = Link(offset_s=1e6)
    answered = robot.status()
    robot.command(answered, waypoint=drive_order())
    robot.offset_s += step_s
    assert robot.moves()
    robot.steady_s += 0.5
    assert robot.command(answered, waypoint=drive_order()) is CommandResult.REPEATED
    answered = robot.status()
    robot.steady_s += 0.5
    assert robot.command(answered, waypoint=drive_order()) is CommandResult.REPEATED
    robot.steady_s += 0.6
    assert not robot.moves()


def test_stop_is_never_too_late():  # A6
    robot = Link()
    answered = robot.status()
    robot.command(answered, waypoint=drive_order())
    robot.steady_s += 0.9
    robot.command(robot.status(), waypoint=drive_order())
    robot.steady_s += 0.5
    assert robot.command(answered, 2, waypoint=drive_order(), stop=True) is CommandResult.EXPIRED
    assert robot.core.desired(robot.steady_s).command.stop and not robot.moves()
    assert robot.command(answered, 3, waypoint=drive_order()) is CommandResult.EXPIRED
    assert robot.core.desired(robot.steady_s).command.stop


def test_answer_with_the_time_of_another_status_has_expired():
    statuses = SentStatuses()
    statuses.add(5, 1000.0, 10.0)
    assert statuses.answered_s((5, 999.9)) == 10.0
    assert [statuses.answered_s(answer) for answer in ((5, 990.0), (5, math.nan), (4, 1000.0))] == [None] * 3


def test_statuses_of_the_last_half_minute_are_remembered():
    statuses = SentStatuses()
    for number in range(1, KEPT + 2):
        statuses.add(number, 1.0, 2.0)
    assert statuses.answered_s((1, 1.0)) is None and statuses.answered_s((2, 1.0)) == 2.0


@pytest.mark.parametrize("spoofed_id", [2 ** 64 - 1, 2 ** 63, 1 + MAX_ID_STEP + 1])
@pytest.mark.parametrize("end_session", [False, True])
def test_id_out_of_turn_neither_blocks_nor_ends_the_owners_session(spoofed_id, end_session):  # D3
    robot = Link()
    answered = robot.status()
    robot.command(answered, 1)
    assert robot.command(answered, spoofed_id, end_session=end_session) is CommandResult.EXPIRED
    assert robot.command(answered, 2, waypoint=drive_order()) is CommandResult.TAKEN and robot.moves()


def test_first_id_of_a_session_is_bounded():  # D3
    robot = Link()
    assert robot.command(robot.status(), MAX_FIRST_ID + MAX_ID_STEP + 1) is CommandResult.EXPIRED
    assert robot.command(robot.status(), 5000) is CommandResult.TAKEN


BAD_BUTTONS = {"twice": (1, 1), "too-high": (MAX_BUTTON + 1,), "huge": (2 ** 32 - 1,), "zero": (0,)}


@pytest.mark.parametrize("buttons", BAD_BUTTONS.values(), ids=list(BAD_BUTTONS))
def test_impossible_buttons_are_refused(buttons):  # N7
    session = ControlSession(Parameters())
    press = Press(1, 1, buttons)
    assert session.take(Command(1, 1, 1, 1.0, press=press), 1.0, 1.0) is CommandResult.REFUSED


def test_orders_of_all_sessions_differ_and_none_is_0():  # A9a
    numbers = OrderNumbers()
    made = {numbers.number_of(session_id, order_id) for session_id in (1, 5, 2 ** 63, 2 ** 64 - 1)
            for order_id in (1, 2, 3, 2 ** 64 - 1)}
    assert len(made) == 16 and all(0 < number < 2 ** 63 for number in made)
    assert numbers.number_of(5, 0) == 0 and numbers.id_of(5, 0) == 0


def test_dispatcher_that_was_restarted_gives_an_order_the_number_that_it_had():
    before, after = Link(), Link()
    after.steady_s += 5.0
    for robot in (before, after):
        robot.command(robot.status(), map_car_id=1, check_car_id=2)
    old, new = (robot.core.desired(robot.steady_s) for robot in (before, after))
    assert (old.map_order, old.check_order) == (new.map_order, new.check_order)
    assert after.core.session.map_orders.id_of(old.session_id, old.map_order) == 1


def test_order_of_another_session_is_not_confirmed():  # A9a
    numbers = OrderNumbers()
    old = numbers.number_of(5, 1)
    assert numbers.number_of(6, 1) != old
    assert numbers.id_of(6, old) == numbers.id_of(5, old) == 0


def test_status_stays_readable_whatever_nodes_and_strangers_say():  # D5
    robot = Link()
    robot.command(robot.status(), 1)
    robot.command(robot.status(), 2, press=link.ButtonPress(id=1, buttons=range(1, 60_001)))
    for number in range(50):
        robot.core.log.add(float(number), 2, "noisy", f"{number}{'x' * 7000}")
    long = ProblemMessage(code="state_machine.long", text="y" * 100_000, names=["z"] * 1000, values=["v" * 1000] * 1000)
    mode = RobotMode(mode=RobotMode.FAULT, message="y" * 100_000, problems=[long] * 100)
    message = robot.status(mode=mode)
    assert len(message.SerializeToString()) <= MAX_STATUS_BYTES
    assert all(len(entry.text) <= MAX_TEXT for entry in message.log) and message.log
    assert all(len(notice.text) <= MAX_TEXT for notice in message.notifications) and message.notifications
    assert len(robot.core.desired(robot.steady_s).stop_reason.text) <= 2 * MAX_TEXT


def test_status_that_is_still_too_large_goes_without_what_can_be_missed():  # D5
    robot = Link()
    car = CarEstimate(state=CarEstimate.LOCATED, outline_x=[1.0] * 7950, outline_y=[2.0] * 7950)
    for number in range(50):
        robot.core.log.add(float(number), 2, "noisy", f"{number}{'x' * 7000}")
    message = robot.status(car=car)
    assert len(message.SerializeToString()) <= MAX_STATUS_BYTES and not message.log and message.id


def test_sixteen_strangers_are_remembered():  # D6
    strangers = ForeignApplications()
    for number in range(100_000):
        strangers.received(1, 2 + number, 5.0)
    assert len(strangers._received_s) == MAX_FOREIGN and strangers.notices(1, 5.0)


def test_steady_time_hold_and_source_are_told():
    robot = Link(offset_s=500.0)
    message = robot.status(mode=RobotMode(hold_id=77, message="Driven by hand."), drive=DriveStatus(source="manual"))
    assert (message.steady_time_s, message.sent_time_s) == (START_S, START_S + 500.0)
    assert (message.hold_id, message.motion_source) == (77, link.MOTION_SOURCE_MANUAL)
    assert {notice.code: notice.text for notice in message.notifications}["held"] == "Driven by hand."


def test_interventions_only_grow_when_their_nodes_start_anew():
    robot = Link()
    robot.status(drive=DriveStatus(manual_drives=4, blockages=2), motion=MotionStatus(replans=1))
    robot.status(drive=DriveStatus(manual_drives=5, blockages=2), motion=MotionStatus(replans=3),
                 peripherals=PeripheralsState(manual_lifts=1))
    message = robot.status(drive=DriveStatus(manual_drives=1, lock_stops=1), clock_steps=2,
                           peripherals=PeripheralsState(manual_lifts=2, firmware_resets=1))
    counts = message.interventions
    assert (counts.manual_drives, counts.blockages, counts.lock_stops, counts.replans) == (2, 0, 1, 2)
    assert (counts.manual_lifts, counts.firmware_resets, counts.clock_steps) == (1, 1, 2)


def test_node_that_is_silent_changes_no_intervention():
    counts = Interventions()
    counts.update(Inputs(1.0, drive=DriveStatus(blockages=1)))
    counts.update(Inputs(2.0, drive=DriveStatus(blockages=2)))
    assert counts.update(Inputs(3.0))["blockages"] == 1


def test_emergency_stop_is_as_its_owners_say_and_engaged_when_they_are_silent():
    watch = EmergencyWatch(expected=False)
    assert watch.at(1.0) is EmergencyStop.ABSENT
    watch.received("controller_input", False, 1.0)
    assert watch.at(1.4) is EmergencyStop.RELEASED and watch.at(1.6) is EmergencyStop.ENGAGED
    watch.received("controller_input", True, 2.0)
    assert watch.at(2.0) is EmergencyStop.ENGAGED
    watch.received("controller_input", False, 2.1)
    assert watch.at(2.1) is EmergencyStop.RELEASED
    assert EmergencyWatch(expected=True).at(1.0) is EmergencyStop.ENGAGED


def test_emergency_stop_of_an_owner_that_restarts_and_says_nothing_of_it_stays_engaged():  # A4
    watch = EmergencyWatch(expected=False)
    watch.received("controller_input", True, 1.0)
    watch.received("controller_input", False, 3.0)
    assert watch.at(3.0) is EmergencyStop.ENGAGED


def test_waypoint_and_its_problem_are_untouched():
    session = ControlSession(Parameters())
    order = Command(1, 1, 1, 1.0, waypoint=Waypoint(1, "application/1", "car", Pose2(1.0, 2.0, 3.0)), resume_hold_id=9)
    assert session.take(order, 1.0, 1.0) is CommandResult.TAKEN
    assert session.desired(1.0).stop_reason == NO_PROBLEM == Problem() and session.command.resume_hold_id == 9
