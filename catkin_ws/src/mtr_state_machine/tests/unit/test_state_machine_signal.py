"""Signal before motion: when it is due, its duration, and the behaviour without it."""
# SPDX-License-Identifier: Apache-2.0
from dataclasses import replace

import pytest
from state_machine_seen import COLLECTING, LOCATED, WANTS, WAYPOINT, reported, seen

from mtr_core.requests import Waypoint
from mtr_core.se2 import Pose2
from mtr_core.states import Result, State
from mtr_state_machine.conversions import mode_message, observation
from mtr_state_machine.core import StateMachine
from mtr_state_machine.observation import Drive, Part
from mtr_state_machine.parameters import Parameters

TICK_S = 0.1
MOVES, RESTS = Drive(is_moving=True), Drive()
NEXT = replace(WANTS, waypoint=Waypoint(8, "application/9", "car", Pose2(1.0, 1.0, 0.5), 2))
# Delay from the order to the board's report.
ANSWERS_S = 0.3


class Robot:
    """A robot that follows a waypoint, and a board that gives an ordered signal.

    Attributes:
        gives: False for a board without a signal.
    """

    def __init__(self, **parameters):
        self.machine = StateMachine(Parameters(resume_by_operator=False, **parameters))
        self.now_s, self.gives, self.drive, self.desired = 100.0, True, RESTS, WANTS
        self.orders = []
        self.decision = None
        self.step(car=COLLECTING)

    def step(self, **changes):
        answered = self.orders[-round(ANSWERS_S / TICK_S):]
        is_given = self.gives and len(answered) == round(ANSWERS_S / TICK_S) and all(answered)
        shown = {"car": LOCATED, "drive": self.drive, "desired": self.desired, **changes}
        self.decision = self.machine.step(seen(now_s=self.now_s, signals_motion=is_given, **shown))
        self.orders.append(self.decision.sets_off)
        self.now_s += TICK_S
        return self.decision

    def run(self, seconds, **changes):
        """Return the decisions of this time."""
        return [self.step(**changes) for _ in range(round(seconds / TICK_S))]

    def set_off(self):
        """Return the time in s until the robot gets the goal, or None."""
        for count in range(200):
            if self.step().goal.waypoint.id:
                return count * TICK_S
        return None


@pytest.mark.parametrize("signal_s", [0.5, 2.0, 10.0])
def test_robot_at_rest_has_no_goal_before_the_board_gave_the_signal_for_its_time(signal_s):
    robot = Robot(signal_s=signal_s)
    waited_s = robot.set_off()
    # The tick in which the fixture mapped the Car counts as well.
    assert signal_s + ANSWERS_S - 2 * TICK_S <= waited_s <= signal_s + ANSWERS_S + 2 * TICK_S
    assert robot.decision.goal.waypoint == WAYPOINT and not robot.decision.sets_off


def test_default_is_two_seconds_after_five_of_rest():
    assert (Parameters().signal_s, Parameters().signal_after_rest_s) == (2.0, 5.0)


def test_without_a_signal_the_robot_sets_off_at_once():
    robot = Robot(signal_s=0.0)
    assert robot.set_off() == 0.0 and not any(robot.orders)


def test_robot_whose_board_gives_no_signal_does_not_move_and_says_why():
    robot = Robot()
    robot.gives = False
    decisions = robot.run(60.0)
    assert not any(each.goal.waypoint.id for each in decisions) and all(each.sets_off for each in decisions)
    assert decisions[0].message.code == "state_machine.sets_off"
    assert decisions[-1].message.code == "state_machine.signal_not_given"


def test_signal_that_was_interrupted_begins_again():
    robot = Robot()
    robot.run(1.5)
    robot.gives = False
    robot.run(0.2)
    robot.gives = True
    assert robot.set_off() >= 2.0


def test_short_stop_needs_no_signal_and_a_long_one_does():
    robot = Robot()
    robot.set_off()
    robot.drive = MOVES
    robot.run(3.0)
    robot.drive = RESTS
    robot.run(4.8, motion=reported(robot.decision, Result.REACHED))
    robot.desired = NEXT
    assert robot.set_off() == 0.0
    robot.drive = MOVES
    robot.run(1.0)
    robot.drive = RESTS
    robot.run(5.2)
    robot.desired = WANTS
    assert robot.set_off() >= 2.0


def test_goal_under_way_is_not_interrupted_by_a_stop_of_any_length():
    robot = Robot()
    robot.set_off()
    robot.drive = MOVES
    robot.run(1.0)
    robot.drive = RESTS
    assert all(each.goal.waypoint.id and not each.sets_off for each in robot.run(30.0))


def test_operators_stop_ends_the_signal_and_the_next_order_needs_all_of_it():
    robot = Robot()
    robot.run(1.5)
    robot.desired = replace(WANTS, stop=True)
    assert not any(each.sets_off for each in robot.run(1.0))
    robot.desired = WANTS
    assert robot.set_off() >= 2.0


def test_robot_that_is_driven_by_hand_is_not_delayed_but_waits_after_a_rest():
    robot = Robot()
    robot.drive = Drive(is_manual=True, is_moving=True, manual_drives=1)
    assert not any(each.sets_off for each in robot.run(2.0))


def test_each_resumed_hold_after_a_rest_has_its_signal():
    robot = Robot()
    robot.set_off()
    robot.run(6.0, desired=replace(WANTS, stop=True))
    assert robot.set_off() >= 2.0


def test_signal_is_part_of_the_mode_and_read_from_the_peripherals():
    from genpy import Time

    from mtr_msgs.msg import DriveStatus, PeripheralsState

    robot = Robot()
    assert mode_message(robot.step(), Time(1)).sets_off and robot.machine.state is State.FOLLOWING_WAYPOINT
    messages = {Part.PERIPHERALS: PeripheralsState(alive=True, signal=1, lift_jams=3),
                Part.DRIVE_CONTROL: DriveStatus(angular_radps=0.1)}
    found = observation(messages, None, dict.fromkeys(messages, 0.1), 1.0)
    assert (found.signals_motion, found.lift_jams, found.drive.is_moving) == (True, 3, True)
    messages[Part.PERIPHERALS].signal = 2
    assert not observation(messages, None, dict.fromkeys(messages, 0.1), 1.0).signals_motion
    assert not observation({}, None, {}, 1.0).signals_motion
