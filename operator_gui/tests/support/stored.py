"""What a progress file holds of the lines that are measured."""
# SPDX-License-Identifier: Apache-2.0
import json


def stored(path):
    return json.loads(path.read_text(encoding="utf-8"))["results"]


def presses(result):
    """What was measured; what all radials say together may move the distance that follows."""
    return result["radial"], result["robot_time_s"], result["worked_at_m"], result["failed_at_m"]
