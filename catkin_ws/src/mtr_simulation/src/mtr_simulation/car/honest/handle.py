"""Output of the test on the Car's bus that pulls the driver's handle, like an actuator at a real handle."""
# SPDX-License-Identifier: Apache-2.0
import enum
from typing import Any, Optional

import cantools

from ..can_port import SentFrame
from ..ecu import Command

HANDLE_MESSAGE = "HandleActuator"
_SIGNAL = "HandleRequest"


class HandleOrder(enum.IntEnum):
    """Values of HandleRequest in the honest Car's DBC."""

    RELEASED = 0
    OPEN = 1
    LOCK = 2


_COMMANDS = {HandleOrder.OPEN: Command.UNLOCK, HandleOrder.LOCK: Command.LOCK}


class HandleActuator:
    """Follows the output message: each change from released to pulled is one request."""

    def __init__(self, database: Any):
        self._message = database.get_message_by_name(HANDLE_MESSAGE)
        self._order = HandleOrder.RELEASED

    def request(self, frame: SentFrame) -> Optional[Command]:
        """Return the command of a frame from the host; None for other messages and for frames without a change."""
        if frame.can_id != self._message.frame_id:
            return None
        try:
            order = HandleOrder(self._message.decode(frame.data, decode_choices=False)[_SIGNAL])
        except (ValueError, cantools.database.DecodeError):
            return None
        before, self._order = self._order, order
        return _COMMANDS.get(order) if order is not before else None
