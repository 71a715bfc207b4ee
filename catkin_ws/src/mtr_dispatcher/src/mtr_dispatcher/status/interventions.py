"""Interventions that the Operator did not order, counted since the dispatcher's start."""
# SPDX-License-Identifier: Apache-2.0
from typing import Dict

from .inputs import Inputs

# Fields of the nodes' messages, with the same names in the proto.
COUNTS = {"drive": ("manual_drives", "blockages", "lock_stops"), "motion": ("replans",),
          "peripherals": ("manual_lifts", "firmware_resets")}


class Interventions:
    """Sums of counts that restart at zero with their node: the sums never decrease."""

    def __init__(self) -> None:
        self._sums: Dict[str, int] = {name: 0 for names in COUNTS.values() for name in names}
        self._newest: Dict[str, int] = {}

    def update(self, inputs: Inputs) -> Dict[str, int]:
        """Add the newest counts and return all sums by their names in the proto."""
        for part, names in COUNTS.items():
            message = getattr(inputs, part)
            for name in names if message is not None else ():
                self._count(name, getattr(message, name))
        return {**self._sums, "clock_steps": inputs.clock_steps}

    def _count(self, name: str, newest: int) -> None:
        # Counts from before the dispatcher's first message belong to an earlier session.
        known = self._newest.get(name, newest)
        self._sums[name] += newest - known if newest >= known else newest
        self._newest[name] = newest
