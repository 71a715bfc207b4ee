"""After a fault, an emergency stop, an obstacle or manual driving the Operator has to resume the robot. A8, A9b"""
# SPDX-License-Identifier: Apache-2.0
import math
from dataclasses import replace

import pytest
from state_machine_seen import ALL_WELL, COLLECTING, LOCATED, WANTS, WAYPOINT

from mtr_core.problems import Problem
from mtr_core.requests import NO_GOAL, DesiredState, GoalReport, Waypoint
from mtr_core.states import CarState, Result, State
from mtr_state_machine.core import StateMachine
from mtr_state_machine.hold import EMPTY_FOR_S
from mtr_state_machine.observation import Car, Drive, Emergency, Observation, Part
from mtr_state_machine.parameters import Parameters

SILENT = {**ALL_WELL, Part.LOCALIZATION: 0.6}
IDLE = replace(WANTS, waypoint=Waypoint())
STOPPED = replace(WANTS, stop=True)
SILENT_LINK = replace(WANTS, link_alive=False, stop=True)
OBSTACLE = Problem("motion_planner.obstacle", "The robot is blocked by an obstacle.")


class Robot:
    """A state machine and its observations; each step is a tick of 0.1 s."""

    def __init__(self, resume_by_operator=True, now_s=50.0):
        self.machine = StateMachine(Parameters(resume_by_operator=resume_by_operator, signal_s=0.0))
        self.now_s = now_s
        self.seen = Observation(desired=IDLE, car=Car(), age_s=ALL_WELL)

    def step(self, **changes):
        """Run one tick; changes remain in effect."""
        self.now_s += 0.1
        self.seen = replace(self.seen, now_s=self.now_s, **changes)
        self.decision = self.machine.step(self.seen)
        return self.decision

    def block(self):
        """Report an obstacle for the present goal at one tick, and none at the next."""
        goal = self.decision.goal
        held = self.step(motion=GoalReport(goal.id, Result.BLOCKED, OBSTACLE))
        self.step(motion=GoalReport())
        return held

    def follow(self):
        """Start to drive to the waypoint."""
        self.step()
        self.step(desired=WANTS, car=COLLECTING)
        self.step(car=LOCATED)
        assert self.step().goal.waypoint == WAYPOINT and self.machine.state is State.FOLLOWING_WAYPOINT
        return self


@pytest.fixture
def robot():
    return Robot().follow()


def fault(robot):
    robot.step(age_s=SILENT)
    assert robot.machine.state is State.FAULT and not robot.decision.hold_id
    robot.step(age_s=ALL_WELL)


def test_robot_whose_dispatcher_died_under_an_order_is_held_before_the_order_is_there_again(robot):
    robot.step(age_s={**ALL_WELL, Part.DISPATCHER: 0.6})
    assert robot.machine.state is State.FAULT
    # A restarted dispatcher has not received messages of an application yet.
    held = robot.step(age_s=ALL_WELL, desired=DesiredState())
    assert held.hold_id
    assert robot.step(desired=WANTS).goal == NO_GOAL
    assert robot.step(desired=replace(WANTS, resume_hold_id=held.hold_id)).goal.waypoint == WAYPOINT


def test_robot_whose_dispatcher_died_without_an_order_is_not_held(robot):
    robot.step(desired=IDLE)
    robot.step(age_s={**ALL_WELL, Part.DISPATCHER: 0.6})
    assert not robot.step(age_s=ALL_WELL, desired=DesiredState()).hold_id


def manual(robot):
    robot.step(drive=Drive(is_manual=True, manual_drives=1))
    robot.step(drive=Drive(is_manual=False, manual_drives=1))


def manual_for_a_moment(robot):
    robot.step(drive=replace(robot.seen.drive, manual_drives=robot.seen.drive.manual_drives + 1))


def blocked_for_a_moment(robot):
    robot.step(drive=replace(robot.seen.drive, blockages=robot.seen.drive.blockages + 1))


def board_restarted(robot):
    robot.step(firmware_resets=robot.seen.firmware_resets + 1)


def lift_gave_up(robot):
    robot.step(lift_jams=robot.seen.lift_jams + 1)


def emergency_stop(robot):
    stops = robot.seen.emergency.stops + 1
    for _ in range(15):
        robot.step(emergency=Emergency(is_engaged=True, stops=stops))
    robot.step(emergency=Emergency(is_engaged=False, stops=stops))


def service_mode(robot):
    stops = robot.seen.emergency.stops + 1
    for _ in range(3):
        robot.step(desired=replace(robot.seen.desired, stop=True),
                   emergency=Emergency(is_engaged=True, stops=stops, is_service=True))
    robot.step(desired=replace(robot.seen.desired, stop=False), emergency=Emergency(stops=stops))


def emergency_stop_for_a_moment(robot):
    robot.step(emergency=Emergency(is_engaged=False, stops=robot.seen.emergency.stops + 1))


def stopped_by_operator(robot):
    for _ in range(5):
        robot.step(desired=STOPPED)
    robot.step(desired=WANTS)


def stopped_for_a_tick(robot):
    robot.step(desired=STOPPED)
    robot.step(desired=WANTS)


def silent_link(robot, lost_s=1.1):
    """Report the link as lost for this time, from the first tick to the last."""
    for _ in range(round(10.0 * lost_s) + 1):
        robot.step(desired=SILENT_LINK)
    robot.step(desired=WANTS)


CAUSES = {"fault": (fault, "state_machine.held_fault"), "manual": (manual, "state_machine.held_manual"),
          "manual-between-ticks": (manual_for_a_moment, "state_machine.held_manual"),
          "blocked": (Robot.block, "state_machine.held_blocked_because"),
          "blocked-between-ticks": (blocked_for_a_moment, "state_machine.held_blocked"),
          "emergency": (emergency_stop, "state_machine.held_emergency"),
          "emergency-between-ticks": (emergency_stop_for_a_moment, "state_machine.held_emergency"),
          "service": (service_mode, "state_machine.held_service"),
          "board": (board_restarted, "state_machine.held_board"),
          "stop": (stopped_by_operator, "state_machine.held_stop"),
          "stop-for-a-tick": (stopped_for_a_tick, "state_machine.held_stop"),
          "link": (silent_link, "state_machine.held_link"),
          "lift": (lift_gave_up, "state_machine.held_lift")}
every_cause = pytest.mark.parametrize("cause, code", CAUSES.values(), ids=list(CAUSES))


@every_cause
def test_robot_stands_after_the_cause_until_the_operator_has_it_go_on(robot, cause, code):
    first = robot.decision.goal
    cause(robot)
    for _ in range(50):
        held = robot.step()
        assert held.goal == NO_GOAL and held.hold_id and held.message.code == code
    resumed = robot.step(desired=replace(WANTS, resume_hold_id=held.hold_id))
    assert not resumed.hold_id and resumed.goal.waypoint == WAYPOINT and resumed.goal.attempt > first.attempt


@every_cause
def test_robot_near_which_nobody_comes_goes_on_by_itself(cause, code):
    robot = Robot(resume_by_operator=False).follow()
    cause(robot)
    assert robot.step().goal.waypoint == WAYPOINT and not robot.decision.hold_id


@every_cause
@pytest.mark.parametrize("wrong", [1, 2 ** 63])
def test_another_holds_word_does_not_count(robot, cause, code, wrong):
    cause(robot)
    assert robot.step(desired=replace(WANTS, resume_hold_id=wrong)).hold_id


@every_cause
@pytest.mark.parametrize("between", [STOPPED, replace(WANTS, link_alive=False, stop=True),
                                     replace(WANTS, waypoint=replace(WAYPOINT, id=8))],
                         ids=["stop", "silence", "another-waypoint"])
def test_neither_stop_nor_silence_nor_another_waypoint_is_the_operators_word(robot, cause, code, between):
    cause(robot)
    hold_id = robot.decision.hold_id
    robot.step(desired=between)
    assert robot.step(desired=replace(between, stop=False, link_alive=True)).hold_id == hold_id
    assert robot.decision.goal == NO_GOAL


@pytest.mark.parametrize("lost_s", [0.0, 0.1, 0.9, 1.0])
def test_short_silence_of_the_link_resumes_by_itself(robot, lost_s):
    first = robot.decision.goal
    silent_link(robot, lost_s)
    assert not robot.decision.hold_id and robot.decision.goal.waypoint == WAYPOINT
    assert robot.decision.goal.attempt > first.attempt


def test_several_short_silences_are_no_long_one(robot):
    for _ in range(10):
        silent_link(robot, 0.9)
    assert not robot.decision.hold_id and robot.decision.goal.waypoint == WAYPOINT


def test_long_silence_makes_one_hold_and_the_next_silence_another(robot):
    silent_link(robot, 30.0)
    first = robot.decision.hold_id
    robot.step(desired=replace(WANTS, resume_hold_id=first))
    assert not robot.decision.hold_id
    numbers = set()
    for _ in range(300):
        numbers.add(robot.step(desired=replace(SILENT_LINK, resume_hold_id=first)).hold_id)
    assert len(numbers - {0}) == 1 and max(numbers) > first


@every_cause
def test_order_to_resume_from_before_a_long_silence_does_not_count(robot, cause, code):
    cause(robot)
    before = robot.decision.hold_id
    silent_link(robot)
    resumed = robot.step(desired=replace(WANTS, resume_hold_id=before))
    assert resumed.hold_id > before and resumed.goal == NO_GOAL and resumed.message.code == code
    assert robot.step(desired=replace(WANTS, resume_hold_id=resumed.hold_id)).goal.waypoint == WAYPOINT


def test_hold_does_not_end_while_the_operators_stop_lasts(robot):
    hold_id = robot.step(desired=STOPPED).hold_id
    assert hold_id and robot.step().hold_id == hold_id
    assert robot.step(desired=replace(STOPPED, resume_hold_id=hold_id)).hold_id > hold_id
    assert robot.decision.goal == NO_GOAL


@pytest.mark.parametrize("silence", [IDLE, DesiredState()], ids=["idle", "no-session"])
def test_neither_stop_nor_silence_without_an_order_holds(silence):
    robot = Robot()
    robot.step()
    for _ in range(50):
        robot.step(desired=replace(silence, link_alive=False, stop=True))
    robot.step(desired=replace(silence, link_alive=True, stop=True))
    robot.step(desired=replace(silence, link_alive=True, stop=False))
    assert not robot.decision.hold_id
    robot.follow()


def test_stop_hold_outlives_the_session_that_was_stopped(robot):
    robot.step(desired=STOPPED)
    hold_id = robot.decision.hold_id
    robot.step(desired=DesiredState())
    other = replace(WANTS, session_id=10)
    assert robot.step(desired=other).hold_id == hold_id and robot.decision.goal == NO_GOAL
    assert robot.step(desired=replace(other, resume_hold_id=hold_id)).goal.waypoint == WAYPOINT


@pytest.mark.parametrize("duration_s", [0.2, 2.0, 10.0])
def test_longest_silence_without_a_hold_is_a_parameter(duration_s):
    robot = Robot()
    robot.machine = StateMachine(Parameters(hold_after_lost_s=duration_s, signal_s=0.0))
    robot.follow()
    silent_link(robot, duration_s)
    assert not robot.decision.hold_id
    silent_link(robot, duration_s + 0.1)
    assert robot.decision.hold_id


def test_word_of_a_silent_application_does_not_count(robot):
    manual(robot)
    gone = replace(WANTS, link_alive=False, stop=True, resume_hold_id=robot.decision.hold_id)
    assert robot.step(desired=gone).hold_id


def test_second_cause_needs_a_second_look(robot):
    manual(robot)
    first = robot.decision.hold_id
    manual_for_a_moment(robot)
    second = robot.decision.hold_id
    assert second > first
    assert robot.step(desired=replace(WANTS, resume_hold_id=first)).hold_id == second
    assert not robot.step(desired=replace(WANTS, resume_hold_id=second)).hold_id


def test_hold_does_not_end_while_the_robot_is_driven_by_hand(robot):
    hold_id = robot.step(drive=Drive(is_manual=True, manual_drives=1)).hold_id
    assert robot.step(desired=replace(WANTS, resume_hold_id=hold_id)).hold_id > hold_id
    assert robot.decision.goal == NO_GOAL


def test_hold_does_not_end_while_the_emergency_stop_is_engaged(robot):
    hold_id = robot.step(emergency=Emergency(is_engaged=True, stops=1)).hold_id
    assert hold_id and robot.step().hold_id == hold_id
    assert robot.step(desired=replace(WANTS, resume_hold_id=hold_id)).hold_id > hold_id
    assert robot.decision.goal == NO_GOAL


def test_service_mode_holds_every_application_that_controls_the_robot_by_then():
    robot = Robot()
    robot.step()
    service_mode(robot)
    held = robot.step(desired=WANTS)
    assert held.message.code == "state_machine.held_service" and held.goal == NO_GOAL
    assert not robot.step(desired=replace(WANTS, resume_hold_id=held.hold_id)).hold_id


def test_hold_does_not_end_in_service_mode_and_a_stop_after_it_has_its_own_reason(robot):
    hold_id = robot.step(emergency=Emergency(True, 1, is_service=True)).hold_id
    again = robot.step(desired=replace(WANTS, resume_hold_id=hold_id))
    assert again.hold_id not in (0, hold_id) and again.message.code == "state_machine.held_service"
    assert robot.step(emergency=Emergency(True, 2)).message.code == "state_machine.held_emergency"


def test_service_mode_without_an_application_holds_nobody():
    robot = Robot()
    robot.step(desired=DesiredState())
    service_mode(robot)
    assert not robot.step(desired=IDLE).hold_id


def test_emergency_stop_that_is_released_before_an_order_holds_nobody():
    robot = Robot()
    robot.step()
    emergency_stop(robot)
    assert not robot.decision.hold_id
    robot.follow()


def test_manual_driving_without_an_order_is_free():
    robot = Robot()
    robot.step()
    manual(robot)
    assert not robot.decision.hold_id
    robot.follow()


def test_hold_is_no_motion_lock_so_that_the_robot_can_be_driven_by_hand(robot):
    robot.block()
    assert robot.decision.hold_id and not robot.decision.lock_reason


def test_car_that_was_not_found_holds_nobody():
    robot = Robot()
    robot.step()
    robot.step(desired=WANTS, car=COLLECTING)
    robot.step(car=Car(CarState.FAILED, message=Problem(text="No Car was found.")))
    assert robot.machine.state is State.FAULT
    robot.step(desired=replace(WANTS, waypoint=replace(WAYPOINT, id=8)), car=COLLECTING)
    assert robot.machine.state is State.MAPPING_CAR and not robot.decision.hold_id


def test_state_machine_that_was_restarted_during_a_test_moves_nothing_by_itself():  # A9b, A11
    robot = Robot()
    robot.step(desired=WANTS, car=LOCATED)
    robot.step()
    assert robot.decision.hold_id and robot.decision.goal == NO_GOAL
    assert robot.decision.message.code == "state_machine.held_start"


def test_what_happened_before_a_restart_is_no_cause_of_another_hold():
    robot = Robot()
    robot.seen = replace(robot.seen, drive=Drive(manual_drives=3, blockages=3), firmware_resets=3,
                         emergency=Emergency(stops=3))
    robot.step(desired=WANTS, car=LOCATED)
    robot.step()
    assert robot.decision.message.code == "state_machine.held_start"


def test_obstacle_that_is_reported_for_a_former_goal_holds_nobody(robot):
    former = robot.decision.goal.id._replace(attempt=robot.decision.goal.attempt - 1)
    assert not robot.step(motion=GoalReport(former, Result.BLOCKED, OBSTACLE)).hold_id


@pytest.mark.parametrize("order", [replace(IDLE, map_car_id=1), replace(IDLE, check_car_id=1)], ids=["map", "check"])
def test_robot_that_is_ordered_to_map_or_to_check_is_held(order):
    robot = Robot()
    robot.step()
    robot.step(desired=order)
    emergency_stop_for_a_moment(robot)
    assert robot.decision.hold_id


def test_hold_in_the_same_microsecond_has_another_id(robot):
    manual_for_a_moment(robot)
    first = robot.decision.hold_id
    robot.now_s -= 0.1
    manual_for_a_moment(robot)
    assert robot.decision.hold_id > first


def test_state_machine_that_was_stopped_for_a_while_during_a_test_moves_nothing_by_itself(robot):
    robot.now_s += 0.35
    assert not robot.step().hold_id, "a tick that is late is no pause"
    robot.now_s += 0.45
    assert robot.step().hold_id and robot.decision.goal == NO_GOAL
    assert robot.decision.message.code == "state_machine.held_pause" and "0.6 s" in robot.decision.message.text
    hold_id = robot.decision.hold_id
    assert robot.step(desired=replace(WANTS, resume_hold_id=hold_id)).goal.waypoint == WAYPOINT


def test_goal_and_hold_after_a_restart_have_ids_that_none_of_before_had():  # A9b
    before = Robot(now_s=50.0).follow()
    manual(before)
    after = Robot(now_s=before.now_s + 1.0)
    after.step(desired=WANTS, car=COLLECTING)
    hold_id = after.decision.hold_id
    assert hold_id > before.decision.hold_id
    first = before.machine._goals._attempts
    assert after.step(desired=replace(WANTS, resume_hold_id=hold_id)).goal.attempt > first


@pytest.mark.parametrize("revisions", [(5, 0, 5), (5, 6, 5)])
def test_map_that_comes_by_its_old_number_again_is_another_one(robot, revisions):  # A11
    robot = Robot(resume_by_operator=False)
    robot.step(map_revision=revisions[0])
    robot.step(desired=WANTS, car=COLLECTING)
    robot.step(car=LOCATED)
    assert robot.machine.state is State.FOLLOWING_WAYPOINT
    for revision in revisions[1:]:
        robot.step(map_revision=revision)
    assert robot.machine.state is State.FAULT and "map the Car again" in robot.decision.message.text


def emptied(robot, charge, duration_s=EMPTY_FOR_S + 0.2):
    """Return the decision after the battery has had this charge for a time."""
    for _ in range(round(duration_s / 0.1)):
        robot.step(battery=charge)
    return robot.decision


@pytest.mark.parametrize("charge", [0.049, 0.02, 0.0])
def test_battery_that_is_nearly_empty_holds_the_robot_once(robot, charge):
    assert not emptied(robot, 0.051).hold_id
    held = emptied(robot, charge)
    assert held.hold_id and robot.step().goal == NO_GOAL and "battery" in robot.decision.message.text
    robot.step(desired=replace(WANTS, resume_hold_id=held.hold_id))
    # The last metres to the charger cause no other hold, although the charge varies.
    for later in (charge, 0.06, 0.09, 0.04, 0.01):
        assert not emptied(robot, later).hold_id and robot.decision.goal != NO_GOAL


def test_charged_battery_that_gets_empty_again_holds_again(robot):
    first = emptied(robot, 0.04).hold_id
    robot.step(desired=replace(WANTS, resume_hold_id=first))
    robot.step(battery=0.9)
    assert emptied(robot, 0.04).hold_id > first


@pytest.mark.parametrize("charge", [math.nan, 1.0, 0.05, 0.09, 0.2])
def test_battery_that_is_unknown_or_charged_holds_nobody(robot, charge):
    assert not emptied(robot, charge).hold_id


def test_corrupt_charges_and_load_steps_hold_nobody(robot):
    for charge in (0.0, 0.5, 0.04, math.nan) * 5:
        assert not emptied(robot, charge, 0.9 * EMPTY_FOR_S).hold_id


def test_empty_battery_holds_when_the_robot_is_ordered_and_not_before():
    robot = Robot()
    assert not emptied(robot, 0.04).hold_id
    robot.step(desired=WANTS, car=COLLECTING)
    assert robot.decision.hold_id and robot.decision.goal == NO_GOAL


def test_robot_that_only_has_a_key_height_is_held_when_its_lift_gave_up(robot):
    robot.step(desired=IDLE)
    lift_gave_up(robot)
    held = robot.step()
    assert held.hold_id and held.message.code == "state_machine.held_lift"
    assert not robot.step(desired=replace(IDLE, resume_hold_id=held.hold_id)).hold_id


def test_lift_that_gave_up_by_hand_holds_nobody(robot):
    robot.step(desired=DesiredState())
    lift_gave_up(robot)
    assert not robot.step().hold_id
