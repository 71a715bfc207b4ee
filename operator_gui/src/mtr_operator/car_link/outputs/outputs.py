"""The outputs of a profile on an adapter that may send."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import threading
from typing import Callable

import can

from ..profile import CarProfile
from .extender import BusExtender
from .handle import BusHandle

_HANDLE_IDLE = ("The car's profile names an output that takes the handle, and the CAN adapter only listens: a person "
                "takes it; choose normal mode (--can-normal) to have it switched.")
_EXTENDER_IDLE = ("The car's profile names an output that switches the extender, and the CAN adapter only listens: a "
                  "person switches it; choose normal mode (--can-normal) to have it switched.")


class Outputs:
    """Outputs of a profile. Attributes: handle, extender: None if the profile declares none, and on an adapter that
    only listens. notices: sentences on outputs that stay idle because of listen-only mode."""

    def __init__(self, profile: CarProfile, is_listening: bool, send: Callable[[can.Message], threading.Event],
                 refusal: Callable[[], str] = lambda: ""):
        """send, refusal: see OutputSwitch."""
        handle, extender = profile.handle_output, profile.extender_output
        self.handle = None if handle is None or is_listening else BusHandle(handle, send, refusal)
        self.extender = None if extender is None or is_listening else BusExtender(extender, send, refusal)
        declared = ((handle, _HANDLE_IDLE), (extender, _EXTENDER_IDLE))
        self.notices = tuple(notice for output, notice in declared if output is not None and is_listening)

    def reopened(self) -> None:
        """Handle that the adapter recovered from a failure, see OutputSwitch."""
        for output in (self.handle, self.extender):
            if output is not None:
                output.reopened()

    def close(self) -> None:
        """Release the handle and switch the extender off; safe to call twice."""
        if self.handle is not None:
            self.handle.release()
        if self.extender is not None:
            self.extender.close()
