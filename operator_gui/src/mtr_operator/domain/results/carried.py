"""How the Remote key was carried when something was measured, and what the Car obeyed, as they are recorded."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import math
from typing import Any

from ..actions.distance import Distance

# What the columns of every scenario say.
LATERAL_DOC = "how far the Remote key was beside the line, positive to the left seen from the Car,"
HEADING_DOC = "how far the robot was turned from the line, counterclockwise,"
HEIGHT_DOC = "height of the Remote key above ground"
SPEED_DOC = "speed of the robot, negative in reverse,"
CAUSE_DOC = "passive_entry, key_button, handle, or unknown if its bus does not say"
KEY_NUMBER_DOC = "number of the key that did, as the Car's bus has it; empty if that does not say"
DOORS_DOC = "doors that it unlocked; empty for all of them, and if its bus does not tell them apart"
UNKNOWN_CAUSE = "unknown"


def carried_values(prefix: str, distance: Distance | None) -> dict[str, Any]:
    """Columns of one measurement by name; nothing for one that has no distance."""
    if distance is None:
        return {}
    values = {"lateral_offset_m": distance.lateral_m, "heading_offset_deg": math.degrees(distance.heading_rad),
              "key_height_m": distance.key_height_m, "speed_mps": distance.speed_mps}
    return {**{prefix + name: round(value, 6) if math.isfinite(value) else None for name, value in values.items()},
            f"{prefix}cause": distance.source or UNKNOWN_CAUSE,
            f"{prefix}key_number": distance.key_number, f"{prefix}doors": distance.doors}
