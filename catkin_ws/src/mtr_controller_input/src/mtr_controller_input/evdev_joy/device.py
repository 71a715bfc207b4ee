"""A Linux input device as a stream of states of a gamepad."""
# SPDX-License-Identifier: Apache-2.0
import contextlib
import select
from typing import Callable, Dict, Iterable, Iterator, List, Optional, Tuple

import evdev

from .gamepad import EV_ABS, EV_KEY, AxisRange, Gamepad, is_gamepad

# linux/input-event-codes.h: the kernel's queue has overflowed, and events are missing.
EV_SYN, SYN_DROPPED = 0, 3

State = Tuple[List[float], List[int]]


def find(paths: Iterable[str], open_device: Callable[[str], evdev.InputDevice] = evdev.InputDevice
         ) -> Optional[evdev.InputDevice]:
    """Return the first controller among these devices, opened, or None."""
    for path in paths:
        with contextlib.suppress(OSError):
            device = open_device(path)
            if is_gamepad(_axes(device), _buttons(device)):
                return device
            device.close()
    return None


def states(device: evdev.InputDevice, alive_period_s: float) -> Iterator[State]:
    """Yield the state on each change, and after each period without a change; end when the device is gone."""
    try:
        gamepad = gamepad_of(device)
        while True:
            ready, _, _ = select.select([device.fd], [], [], alive_period_s)
            # Reading the state fails for a device that is gone, even if no event is pending.
            device.absinfo(evdev.ecodes.ABS_X)
            events = list(device.read()) if ready else []
            if any((event.type, event.code) == (EV_SYN, SYN_DROPPED) for event in events):
                gamepad = gamepad_of(device)
                yield gamepad.state()
            elif any([gamepad.take(event.type, event.code, event.value) for event in events]) or not ready:
                yield gamepad.state()
    except OSError:
        return


def gamepad_of(device: evdev.InputDevice) -> Gamepad:
    """Return the controller with its current state, in which a button may already be held."""
    raw: Dict[int, int] = {code: info.value for code, info in device.capabilities().get(EV_ABS, [])}
    return Gamepad(_axes(device), _buttons(device), raw, device.active_keys())


def _axes(device: evdev.InputDevice) -> Dict[int, AxisRange]:
    return {code: AxisRange(info.min, info.max, info.flat) for code, info in device.capabilities().get(EV_ABS, [])}


def _buttons(device: evdev.InputDevice) -> List[int]:
    return list(device.capabilities().get(EV_KEY, []))
