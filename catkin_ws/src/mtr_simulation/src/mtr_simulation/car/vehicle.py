"""Ignition and speed that the simulated Car reports in addition to its locks. The Car is stopped whatever it
reports."""
# SPDX-License-Identifier: Apache-2.0
from dataclasses import dataclass

# Values of the DBC's TerminalState.
_OFF, _ON = 0, 2
# Limit of the DBC's SpeedKmh, below the end of its range.
MAX_SPEED_KMH = 650.0


@dataclass
class Vehicle:
    """Reported state of the rest of the Car, set by a request instead of physics.

    Attributes:
        ignition_on: reported by TerminalState.
        speed_kmh: reported by SpeedKmh, 0 to MAX_SPEED_KMH.
    """

    ignition_on: bool = False
    speed_kmh: float = 0.0

    @property
    def terminal_state(self) -> int:
        """Value of TerminalState in the DBC."""
        return _ON if self.ignition_on else _OFF
