"""Sentences of the state machine for the Operator."""
# SPDX-License-Identifier: Apache-2.0
from mtr_core.problems import Sentence

# Parts of the robot
PART_NOT_REPORTED = Sentence("state_machine.part_not_reported", "The {part} has not reported yet.")
PART_SILENT = Sentence("state_machine.part_silent", "The {part} has been silent for {age_s:.1f} s.")
SECOND_PUBLISHER = Sentence("state_machine.second_publisher",
                            "Node {node} also publishes on {topic}; the robot is locked. End that node; "
                            "rosnode cleanup removes one that has died.")
LOCALIZATION_LOST = Sentence("state_machine.localization_lost", "Localization is lost.")
LOCALIZATION_LOST_BECAUSE = Sentence("state_machine.localization_lost_because", "Localization is lost. {cause}")
FIRMWARE_SILENT = Sentence("state_machine.firmware_silent", "The firmware of lift and buttons is silent.")

# The Car
CAR_NOT_FOUND = Sentence("state_machine.car_not_found", "The Car was not found.")
CAR_LOST = Sentence("state_machine.car_lost",
                    "The position of the Car is no longer known; order the robot to map the Car again.")
OTHER_MAP = Sentence("state_machine.other_map",
                     "Localization has another map than the one in which the Car was found. {cause}")
CAR_ELSEWHERE = Sentence("state_machine.car_elsewhere", "The Car does not stand where it was measured.")

# Reasons for a hold until the Operator resumes the robot
HELD_FAULT = Sentence("state_machine.held_fault",
                      "The robot stands after a fault until the Operator has it go on. {cause}")
HELD_BLOCKED = Sentence("state_machine.held_blocked",
                        "The robot stands after an obstacle until the Operator has it go on.")
HELD_BLOCKED_BECAUSE = Sentence("state_machine.held_blocked_because",
                                "The robot stands after an obstacle until the Operator has it go on. {cause}")
HELD_MANUAL = Sentence("state_machine.held_manual",
                       "The robot was driven by hand; it stands until the Operator has it go on.")
HELD_EMERGENCY = Sentence("state_machine.held_emergency",
                          "The robot stands after an emergency stop until the Operator has it go on.")
HELD_SERVICE = Sentence("state_machine.held_service",
                        "The robot was in service mode; it is on hold until the Operator resumes.")
HELD_STOP = Sentence("state_machine.held_stop",
                     "The Operator has stopped the robot; it is on hold until the Operator resumes.")
HELD_LINK = Sentence("state_machine.held_link",
                     "The Operator's application was silent for too long; the robot is on hold until the Operator "
                     "resumes.")
HELD_BOARD = Sentence("state_machine.held_board",
                      "The board of lift and servos started again; the robot stands until the Operator has it go on.")
HELD_LIFT = Sentence("state_machine.held_lift",
                     "The lift jammed again after one retry; the robot is on hold. Free the lift, then resume.")
HELD_BATTERY = Sentence("state_machine.held_battery",
                        "The battery is at {percent:.0f} %; the robot is on hold. Charge it, or resume to finish what "
                        "is under way.")
HELD_START = Sentence("state_machine.held_start",
                      "The robot's state machine started anew; the robot stands until the Operator has it go on.")
HELD_PAUSE = Sentence(
    "state_machine.held_pause",
    "The robot's state machine had stopped for {pause_s:.1f} s; the robot stands until the Operator has it go on.")

# Actions and waits
WAITS_FOR_WAYPOINT = Sentence("state_machine.waits_for_waypoint", "Waits for the first waypoint to map the Car.")
SETS_OFF = Sentence("state_machine.sets_off", "Warning signal: the robot is about to set off.")
SIGNAL_NOT_GIVEN = Sentence(
    "state_machine.signal_not_given",
    "The robot does not set off: the board does not give the warning signal. Check its cable and firmware version.")
CHECKS_CAR = Sentence("state_machine.checks_car", "Looks at the Car again.")
