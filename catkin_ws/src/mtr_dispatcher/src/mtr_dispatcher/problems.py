"""Sentences of the dispatcher for the Operator."""
# SPDX-License-Identifier: Apache-2.0
from mtr_core.problems import Sentence

# Reasons for a stopped robot
NO_APPLICATION = Sentence("dispatcher.no_application", "No application controls the robot.")
APPLICATION_SILENT = Sentence("dispatcher.application_silent",
                              "The application has been silent for more than {limit_s} s.")
STOPPED_BY_OPERATOR = Sentence("dispatcher.stopped_by_operator", "The Operator stopped the robot.")
COMMAND_REFUSED = Sentence("dispatcher.command_refused", "Command refused: {cause}")

# Service mode
SERVICE_MODE = Sentence("dispatcher.service_mode",
                        "The robot is in service mode: wheels, lift and servos are disabled until the robot and the "
                        "Operator both release it. {cause}")
SERVICE_BY_OPERATOR = Sentence("dispatcher.service_by_operator", "The Operator has entered it.")
SERVICE_AT_ROBOT = Sentence("dispatcher.service_at_robot", "A person at the robot has entered it.")
SERVICE_RESTORED = Sentence("dispatcher.service_restored", "It was active before the robot's software restarted.")
SERVICE_UNREADABLE = Sentence("dispatcher.service_unreadable",
                              "Whether it was active before the restart cannot be read: {why}.")
SERVICE_NOT_STORED = Sentence("dispatcher.service_not_stored",
                              "It cannot be stored and would end with a restart of the robot's software: {why}.")
SERVICE_END_NOT_STORED = Sentence("dispatcher.service_end_not_stored",
                                  "Its end cannot be stored, so it remains active: {why}.")
SERVICE_NOT_ACTIVE = Sentence("dispatcher.service_not_active", "The robot is not in service mode.")
SERVICE_STOP_ENGAGED = Sentence("dispatcher.service_stop_engaged",
                                "An emergency stop is engaged or silent: release it first, then release service mode.")

# Messages without effect
OVERSIZED = Sentence("dispatcher.oversized", "A message of {size} bytes was ignored; allowed are {maximum}.")
UNDECODABLE = Sentence("dispatcher.undecodable", "A message of {size} bytes that is no Command was ignored.")
INCOMPLETE = Sentence("dispatcher.incomplete", "A Command without session or id was ignored.")
EXPIRED = Sentence("dispatcher.expired", "Command {id} had expired when it arrived and was ignored.")
REFUSED = Sentence("dispatcher.refused", "Command {id} was refused: {cause}")
FOREIGN_APPLICATION = Sentence(
    "dispatcher.foreign_application",
    "Application {controlling} controls the robot; Commands of application {foreign} are ignored.")

# Refused senders and connections
KEY_UNKNOWN = Sentence("dispatcher.key_unknown",
                       "Commands with a key that the robot does not know are ignored; pair anew.")
VIEWER_COMMAND = Sentence("dispatcher.viewer_command",
                          "The key of {name} is for looking only; its Commands are ignored. Pair it as a controller.")
TOO_MANY_COMMANDS = Sentence("dispatcher.too_many_commands",
                             "{name} sends more Commands than the robot takes; the others are ignored.")
SESSION_OF_ANOTHER = Sentence("dispatcher.session_of_another",
                              "{name} has sent a Command in the name of another; it was ignored.")
CONNECTIONS_REFUSED = Sentence("dispatcher.connections_refused",
                               "{count} connections without a key that the robot knows were refused since its start.")
CONNECTIONS_CUT_OFF = Sentence(
    "dispatcher.connections_cut_off",
    "{count} connections were cut off since the robot's start: each brought more than messages, or was one too many.")
UNENCRYPTED = Sentence("dispatcher.unencrypted",
                       "The link is not encrypted: whoever is in its network can move the robot.")

# Checks of a Command
WAYPOINT_WITHOUT_ID = Sentence("dispatcher.waypoint_without_id", "Waypoint without an id; ids count from 1.")
WAYPOINT_DIRECTION = Sentence("dispatcher.waypoint_direction",
                              "Waypoint {id}: direction is {value}; allowed are 0, 1 and 2.")
WAYPOINT_X = Sentence("dispatcher.waypoint_x", "Waypoint {id}: x is {value} m; allowed is {low} to {high} m.")
WAYPOINT_Y = Sentence("dispatcher.waypoint_y", "Waypoint {id}: y is {value} m; allowed is {low} to {high} m.")
WAYPOINT_HEADING = Sentence("dispatcher.waypoint_heading",
                            "Waypoint {id}: heading is {value} rad; allowed is {low} to {high} rad.")
MAXIMUM_SPEED = Sentence("dispatcher.maximum_speed",
                         "Maximum speed is {value} m/s; allowed is {low} to {high} m/s.")
KEY_HEIGHT = Sentence("dispatcher.key_height", "Key height is {value} m; allowed is {low} to {high} m.")
PRESS_WITHOUT_ID = Sentence("dispatcher.press_without_id", "Button press without an id; ids count from 1.")
PRESS_BUTTONS = Sentence("dispatcher.press_buttons",
                         "Button press {id}: buttons are {buttons}; allowed are 1 to {maximum} different numbers "
                         "from 1 to {highest}.")
PRESS_STRENGTH = Sentence("dispatcher.press_strength",
                          "Button press {id}: strength is {value}; allowed is {low} to {high}.")
PRESS_DURATION = Sentence("dispatcher.press_duration",
                          "Button press {id}: duration is {value} s; allowed is {low} to {high} s.")

# The test area
AREA_WITHOUT_ID = Sentence("dispatcher.area_without_id", "Test area without an id; ids count from 1.")
AREA_NOT_PAIRS = Sentence("dispatcher.area_not_pairs",
                          "Test area {id}: {x_count} x and {y_count} y coordinates; each corner needs both.")
AREA_CORNERS = Sentence("dispatcher.area_corners",
                        "Test area {id}: {count} corners; the number must be between {low} and {high}.")
AREA_COORDINATE = Sentence("dispatcher.area_coordinate",
                           "Test area {id}: a corner is at {value} m; it must be within {high} m of the start.")
AREA_EDGE = Sentence("dispatcher.area_edge", "Test area {id}: two corners are closer together than {low} m.")
AREA_CROSSED = Sentence("dispatcher.area_crossed", "Test area {id}: its border crosses itself.")
AREA_SIZE = Sentence("dispatcher.area_size",
                     "Test area {id}: its size is {value:.1f} m2; it must be between {low:.0f} and {high:.0f} m2.")
NO_AREA = Sentence("dispatcher.no_area",
                   "No test area is set: draw it on the map before the robot maps the Car. A real robot drives by "
                   "itself only inside one.")
AREA_OF_OTHER_ORIGIN = Sentence(
    "dispatcher.area_of_other_origin",
    "The robot started a new map without a known position, so the test area no longer applies; draw it again.")
FIXED_AREA_OF_OTHER_ORIGIN = Sentence(
    "dispatcher.fixed_area_of_other_origin",
    "The robot started a new map without a known position, so the test area of its launch file no longer applies; "
    "start the robot again at its start place.")

# Nodes, battery and disk
NODE_CANNOT_START = Sentence("dispatcher.node_cannot_start", "The node {node} cannot start: {why}")
STATE_MACHINE_SILENT = Sentence("dispatcher.state_machine_silent",
                                "The robot's state machine is silent; the robot stands still.")
PERIPHERALS_SILENT = Sentence("dispatcher.peripherals_silent", "The node of lift and buttons is silent.")
POSITION_UNKNOWN = Sentence("dispatcher.position_unknown", "The robot does not know its position.")
NO_EMERGENCY_STOP = Sentence("dispatcher.no_emergency_stop",
                             "The robot has no manual controller: there is no emergency stop but the one on the robot.")
LOW_BATTERY = Sentence("dispatcher.low_battery", "The battery is at {percent:.0f} %.")
DISK_FULL = Sentence("dispatcher.disk_full",
                     "The robot's disk is full ({folder}); no test begins until {needed_mb:.0f} MB are free: delete "
                     "old logs and bags.")
