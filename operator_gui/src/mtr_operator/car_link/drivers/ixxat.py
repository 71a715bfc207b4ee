"""Listen-only mode of IXXAT adapters: python-can's driver has no option for it, but the vendor's interface has one.

The flag is added to the mode with which the driver initializes the controller, before its start, and is read back.
Sources: python-can 4.6 and the modes of VCI (CAN_OPMODE_LISTONLY); tested with a substitute of the library.
"""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import contextlib
import ctypes
from typing import Any, Iterator

from .options import Unsupported

# Bit of VCI's operating modes, from python-can's can.interfaces.ixxat.constants.
_LISTEN_ONLY = 0x08
# The driver's default for classic CAN is 16 frames, which a full bus fills in 4 ms; this is its default for CAN FD.
ROOM = {"rx_fifo_size": 1024}


@contextlib.contextmanager
def ordered_to_listen() -> Iterator[None]:
    """Initialize controllers in listen-only mode within this context."""
    try:
        from can.interfaces.ixxat import canlib_vcinpl, canlib_vcinpl2
    except ImportError:
        raise Unsupported("python-can's driver ixxat is for Windows with the vendor's VCI; on Linux use the kernel's "
                          "interface of the adapter (socketcan).") from None
    with contextlib.ExitStack() as stack:
        # Libraries for classic CAN and CAN FD; None if not installed.
        for library in (canlib_vcinpl._canlib, canlib_vcinpl2._canlib):
            if library is not None:
                former = library.canControlInitialize
                stack.callback(setattr, library, "canControlInitialize", former)
                library.canControlInitialize = _listening(former)
        yield


def _listening(initialize: Any) -> Any:
    def initialized(handle: Any, mode: int, *rest: Any) -> Any:
        return initialize(handle, mode | _LISTEN_ONLY, *rest)
    return initialized


def takes_part(bus: Any) -> bool:
    """Return True unless the controller reports listen-only mode. bus: python-can's."""
    from can.interfaces.ixxat import canlib_vcinpl, canlib_vcinpl2, structures
    inner = bus.bus
    is_fd = isinstance(inner, canlib_vcinpl2.IXXATBus)
    status = structures.CANLINESTATUS2() if is_fd else structures.CANLINESTATUS()
    library = (canlib_vcinpl2 if is_fd else canlib_vcinpl)._canlib
    library.canControlGetStatus(inner._control_handle, ctypes.byref(status))
    return not status.bOpMode & _LISTEN_ONLY
