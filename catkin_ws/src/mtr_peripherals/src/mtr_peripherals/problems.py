"""Sentences of the peripherals for the Operator."""
# SPDX-License-Identifier: Apache-2.0
from mtr_core.problems import Sentence

# Requests that the lift or a servo cannot execute
KEY_HEIGHT = Sentence("peripherals.key_height", "Key height {value} m was refused; allowed is {low} to {high} m.")
NO_BUTTON = Sentence("peripherals.no_button", "A press without a button was refused.")
UNKNOWN_BUTTON = Sentence("peripherals.unknown_button",
                          "Button {button} was refused; this key's mount has servos for {known}.")
STRENGTH = Sentence("peripherals.strength", "Strength {value} was refused; allowed is {low} to {high}.")
DURATION = Sentence("peripherals.duration", "Duration {value} s was refused; allowed is above 0 to {high} s.")

# Reasons for stopped lift and servos
EMERGENCY_STOP = Sentence("peripherals.emergency_stop", "Lift and servos stand still: {cause}")
EMERGENCY_ENGAGED = Sentence("peripherals.emergency_engaged", "The emergency stop of {owner} is engaged.")
EMERGENCY_SILENT = Sentence("peripherals.emergency_silent", "The emergency stop of {owner} is silent.")
EMERGENCY_NOT_HEARD = Sentence("peripherals.emergency_not_heard", "The emergency stop of {owner} was not heard yet.")
EMERGENCY_NOT_RELEASED = Sentence(
    "peripherals.emergency_not_released",
    "The emergency stop of {owner} was engaged when it fell silent; engage it and release it again.")
SECOND_PUBLISHER = Sentence("peripherals.second_publisher",
                            "Node {node} also publishes on {topic}. End that node; rosnode cleanup removes one that "
                            "has died.")
STOPPED = Sentence("peripherals.stopped", "The robot is stopped.")

# The firmware
FIRMWARE_NOT_REPORTED = Sentence("peripherals.firmware_not_reported",
                                 "The firmware of lift and buttons has not reported yet.")
FIRMWARE_SILENT = Sentence(
    "peripherals.firmware_silent",
    "The firmware of lift and buttons has been silent for {age_s:.1f} s; check cable and power.")
LIFT_JAMMED = Sentence("peripherals.lift_jammed", "The lift is jammed.")
LIFT_GAVE_UP = Sentence("peripherals.lift_gave_up",
                        "The lift jammed again after one retry; its motor is off. Free the lift before you resume.")
LIFT_SENSOR_BROKEN = Sentence("peripherals.lift_sensor_broken", "The position sensor of the lift is broken.")
NO_COMMANDS = Sentence("peripherals.no_commands", "The firmware hears no commands.")
OTHER_FAULT = Sentence("peripherals.other_fault", "The firmware reports fault {fault}.")

# A press
PRESS_REFUSED = Sentence("peripherals.press_refused", "The firmware refused the press.")
PRESS_CUT_SHORT = Sentence("peripherals.press_cut_short", "The press was cut short; it may have pressed or not.")
PRESS_STOPPED = Sentence("peripherals.press_stopped", "The press was not begun: {cause}")
PRESS_UNKNOWN = Sentence("peripherals.press_unknown", "The node of lift and buttons started again during the press; "
                         "it may have pressed or not.")
PRESS_RESTARTED = Sentence("peripherals.press_restarted", "The firmware started again during the press.")
PRESS_LATE = Sentence("peripherals.press_late", "The firmware did not report the press as done in time.")

# Calibration of the lift
CALIBRATION_REFUSED = Sentence(
    "peripherals.calibration_refused",
    "The lift is not calibrated while an application or the manual controller is in control.")
CALIBRATION_ENDED = Sentence("peripherals.calibration_ended",
                             "The calibration of the lift was ended: calibrate_lift is silent.")
