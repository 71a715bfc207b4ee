"""Sentences of the manual controller's node for the Operator."""
# SPDX-License-Identifier: Apache-2.0
from mtr_core.problems import Sentence

EMERGENCY_STOP = Sentence("controller_input.emergency_stop", "The emergency stop of the manual controller is pressed.")
NOT_RELEASED = Sentence("controller_input.not_released",
                        "The manual controller was started: hold its release buttons to release its emergency stop.")
NOT_HEARD = Sentence("controller_input.not_heard", "The manual controller has not been heard since its start.")
LOST = Sentence("controller_input.lost",
                "The manual controller is lost; the robot stands until it is back and released.")
FROZEN = Sentence("controller_input.frozen",
                  "The manual controller does not change any more; release it to go on.")
OLD_STAMPS = Sentence("controller_input.old_stamps",
                      "Messages of the manual controller are stamped {age_s:.1f} s before their arrival; they are "
                      "ignored. Stop the playback of a recording, or correct the clock of the driver.")
SECOND_PUBLISHER = Sentence("controller_input.second_publisher",
                            "Node {node} also publishes on {topic}; the robot is locked. End that node; "
                            "rosnode cleanup removes one that has died.")
UNWATCHED = Sentence("controller_input.unwatched",
                     "The manual controller reports nothing while it is idle, so its loss would not be noticed. Try "
                     "its stop button before each test.")
