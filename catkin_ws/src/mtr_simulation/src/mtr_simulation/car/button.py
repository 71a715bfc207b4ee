"""Contact below a button of the Remote key, pressed by a servo."""
# SPDX-License-Identifier: Apache-2.0
from typing import NamedTuple, Optional, Tuple

from .parameters import RemoteParameters

# Pulse widths of a hobby servo: released, and additional width at full travel (contract of FirmwareState.servo_us).
RELEASED_US = 1000
TRAVEL_US = 1000


class Closing(NamedTuple):
    """One closing of the contact: time and place of its beginning, and whether it lasted long enough to count."""

    time_ns: int
    key_xyz: Tuple[float, float, float]
    counts: bool


class ButtonContact:
    """Follows a servo's pulse width; a press counts when the contact stays closed for a minimum time."""

    def __init__(self, parameters: RemoteParameters):
        self._threshold_us = RELEASED_US + parameters.contact_travel * TRAVEL_US
        self._needed_ns = parameters.contact_ms * 1_000_000
        self._closed: Optional[Closing] = None
        self._reported = False

    def update(self, time_ns: int, servo_us: float, key_xyz: Tuple[float, float, float]) -> Optional[Closing]:
        """Return the closing whose result is decided now, if any; each one is reported once."""
        if servo_us < self._threshold_us:
            bounced = None if self._reported else self._closed
            self._closed, self._reported = None, False
            return bounced
        if self._closed is None:
            self._closed = Closing(time_ns, key_xyz, False)
        if self._reported or time_ns - self._closed.time_ns < self._needed_ns:
            return None
        self._reported = True
        return self._closed._replace(counts=True)
