"""Extender between Car and key (a relay attack): transmits the Car's low-frequency field to a distant key."""
# SPDX-License-Identifier: Apache-2.0
from typing import Any

import cantools

from ..can_port import SentFrame

EXTENDER_MESSAGE = "ExtenderSwitch"
_SIGNAL = "ExtenderOn"


class Extender:
    """Extender that is off until the test's output message switches it on.

    gain_db: gain of the field at the key while it is on.
    """

    def __init__(self, database: Any, gain_db: float):
        self._message = database.get_message_by_name(EXTENDER_MESSAGE)
        self._gain_db = gain_db
        self.is_on = False

    def follow(self, frame: SentFrame) -> None:
        """Follow a frame of the host; other messages and damaged ones are ignored."""
        if frame.can_id != self._message.frame_id:
            return
        try:
            self.is_on = bool(self._message.decode(frame.data, decode_choices=False)[_SIGNAL])
        except (ValueError, cantools.database.DecodeError):
            return

    @property
    def now_db(self) -> float:
        """Current gain of the field."""
        return self._gain_db if self.is_on else 0.0
