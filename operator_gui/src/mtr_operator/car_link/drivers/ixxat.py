"""IXXAT adapters that only listen: python-can's driver has no option for it, and the vendor's interface has.

The order is added to the one with which the driver sets the controller up, before it is started, and is read back.
From the sources of python-can 4.6 and the modes of VCI (CAN_OPMODE_LISTONLY); tried with a stand-in for the library.
"""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import contextlib
import ctypes
from typing import Any, Iterator

from .options import Unsupported

# The bit of VCI's operating modes, in python-can's can.interfaces.ixxat.constants.
_LISTEN_ONLY = 0x08
# The driver's own for classic CAN is 16 frames, which a full bus fills in 4 ms; this is its own for CAN FD.
ROOM = {"rx_fifo_size": 1024}


@contextlib.contextmanager
def ordered_to_listen() -> Iterator[None]:
    """A controller that is set up meanwhile sends nothing."""
    try:
        from can.interfaces.ixxat import canlib_vcinpl, canlib_vcinpl2
    except ImportError:
        raise Unsupported("python-can's driver ixxat is for Windows with the vendor's VCI; on Linux use the kernel's "
                          "interface of the adapter (socketcan).") from None
    with contextlib.ExitStack() as stack:
        # Classic CAN and CAN FD, each with a library of its own; None where it is not installed.
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
    """True when the controller does not say that it only listens. bus: python-can's."""
    from can.interfaces.ixxat import canlib_vcinpl, canlib_vcinpl2, structures
    inner = bus.bus
    is_fd = isinstance(inner, canlib_vcinpl2.IXXATBus)
    status = structures.CANLINESTATUS2() if is_fd else structures.CANLINESTATUS()
    library = (canlib_vcinpl2 if is_fd else canlib_vcinpl)._canlib
    library.canControlGetStatus(inner._control_handle, ctypes.byref(status))
    return not status.bOpMode & _LISTEN_ONLY
