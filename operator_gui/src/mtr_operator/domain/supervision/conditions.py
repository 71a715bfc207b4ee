"""Operating conditions that a person confirms before a test, because no sensor of the robot shows them."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from typing import Sequence

# Names as in the table odd of docs/safety/hazards.yaml, with the requirement shown to the confirming person.
CONDITIONS = {
    "area": "closed or marked area, 2 m free around the paths; no edge, stairs, dock or kerb inside",
    "people": "trained adults only; no person lies, kneels or works at the Car",
    "ground": "dry or wet asphalt or concrete, steps and cables below 15 mm, slope at most 2 degrees",
    "weather": "no ice, snow, heavy rain or fog; no low sun into a LiDAR; mean wind below 8 m/s",
    "light": "lit area",
    "car": "parking brake, gear P, chocks; cabin empty; doors, lids and windows closed; alarm off or announced",
    "attendance": "one trained person within 10 m, in sight of the robot, with a hardware emergency stop",
}


def unconfirmed(confirmed: Sequence[str]) -> list[str]:
    """Return the conditions that were not confirmed, in their order."""
    return [name for name in CONDITIONS if name not in confirmed]
