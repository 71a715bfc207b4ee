"""Signals of the Car's bus that stop the robot: ignition, gear, speed, and doors or lids."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import enum
from dataclasses import dataclass, replace
from typing import Sequence

GEAR, IGNITION, SPEED, DOOR = "gear", "ignition", "speed", "door"


class SignalState(enum.Enum):
    """State of a signal. CLEAR: the robot may move. ACTIVE: it must not. UNKNOWN: nothing was received, or a value
    without information."""

    CLEAR = "clear"
    ACTIVE = "active"
    UNKNOWN = "unknown"


@dataclass(frozen=True)
class CarSignal:
    """One signal that the Car's profile names.

    kind: IGNITION, GEAR, SPEED or DOOR. source: signal and message, for a person. name: of a door or lid, else empty.
    """

    kind: str
    source: str
    state: SignalState
    name: str = ""

    @property
    def sentence(self) -> str:
        """Sentence of an active signal."""
        if self.kind == IGNITION:
            return f"The Car's ignition is on (signal {self.source})."
        if self.kind == GEAR:
            return f"The Car's gear is not P (signal {self.source})."
        if self.kind == SPEED:
            return f"The Car moves (signal {self.source})."
        return f"A door or lid of the Car is open: {self.name} (signal {self.source})."


CarSignals = Sequence[CarSignal]


def first_active(signals: CarSignals, kinds: Sequence[str] = (IGNITION, GEAR, SPEED)) -> CarSignal | None:
    """Return the first active signal of these kinds; None without one."""
    return next((each for each in signals if each.kind in kinds and each.state is SignalState.ACTIVE), None)


def unknown_unless_active(signals: CarSignals) -> tuple[CarSignal, ...]:
    """Return the signals for an unreliable bus: active ones stay active, all others are unknown."""
    return tuple(each if each.state is SignalState.ACTIVE else replace(each, state=SignalState.UNKNOWN)
                 for each in signals)
