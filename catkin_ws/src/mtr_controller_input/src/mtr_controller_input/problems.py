"""What the manual controller's node says to the Operator."""
# SPDX-License-Identifier: Apache-2.0
from mtr_core.problems import Sentence

EMERGENCY_STOP = Sentence("controller_input.emergency_stop", "The emergency stop of the manual controller is pressed.")
LOST = Sentence("controller_input.lost",
                "The manual controller is lost; the robot stands until it is back and released.")
FROZEN = Sentence("controller_input.frozen",
                  "The manual controller does not change any more; release it to go on.")
