"""What the simulated Car reports next to its locks: ignition and speed. It stands still whatever it reports."""
# SPDX-License-Identifier: Apache-2.0
from dataclasses import dataclass

# Numbers of the DBC's TerminalState.
_OFF, _ON = 0, 2
# Of the DBC's SpeedKmh, below the end of its range.
MAX_SPEED_KMH = 650.0


@dataclass
class Vehicle:
    """State of the rest of the Car; a fault that was ordered, not physics.

    Attributes:
        ignition_on: reported by TerminalState.
        speed_kmh: reported by SpeedKmh, 0 to MAX_SPEED_KMH.
    """

    ignition_on: bool = False
    speed_kmh: float = 0.0

    @property
    def terminal_state(self) -> int:
        """As the DBC has it."""
        return _ON if self.ignition_on else _OFF
