"""Converts events of a Linux input device to axes and buttons of sensor_msgs/Joy, numbered like in joy_node."""
# SPDX-License-Identifier: Apache-2.0
from typing import Dict, List, Mapping, NamedTuple, Sequence, Tuple

# linux/input-event-codes.h
EV_KEY, EV_ABS = 1, 3
BTN_GAMEPAD = 0x130
ABS_X, ABS_Y = 0, 1
# Axes from this code on are not sticks, triggers or crosses, but volume, pressure, multi-touch.
ABS_END = 0x18


class AxisRange(NamedTuple):
    """Raw values of an axis: its ends, and the width of its rest zone around the middle."""

    low: int
    high: int
    flat: int


class Gamepad:
    """Stores the state of one controller.

    Axes and buttons are numbered in the order of their codes; left and up are positive.
    """

    def __init__(self, axes: Mapping[int, AxisRange], buttons: Sequence[int], raw: Mapping[int, int],
                 held: Sequence[int] = ()):
        """raw: current values of the axes by code; held: codes of the held buttons."""
        self._axes: Dict[int, AxisRange] = {code: axes[code] for code in sorted(axes) if code < ABS_END}
        self._values: Dict[int, float] = {code: self._deflection(code, raw.get(code)) for code in self._axes}
        self._buttons: Dict[int, int] = {code: int(code in held) for code in sorted(buttons)}

    def take(self, kind: int, code: int, value: int) -> bool:
        """Process one event; return True if it changed the state."""
        before = self.state()
        if kind == EV_ABS and code in self._axes:
            self._values[code] = self._deflection(code, value)
        elif kind == EV_KEY and code in self._buttons:
            # The value 2 is a keyboard's autorepeat.
            self._buttons[code] = 1 if value else 0
        return self.state() != before

    def state(self) -> Tuple[List[float], List[int]]:
        """Return the axes from -1 to 1, and the buttons, 1 while held."""
        return list(self._values.values()), list(self._buttons.values())

    def _deflection(self, code: int, raw: object) -> float:
        low, high, flat = self._axes[code]
        middle, half = (low + high) / 2.0, (high - low) / 2.0
        if not isinstance(raw, int) or half <= 0.0 or abs(raw - middle) <= flat:
            return 0.0
        return max(-1.0, min(1.0, (middle - raw) / half))


def is_gamepad(axes: Mapping[int, AxisRange], buttons: Sequence[int]) -> bool:
    """Return True for a device with a stick and a gamepad's buttons; motion sensors and touch pads are separate
    devices."""
    return ABS_X in axes and ABS_Y in axes and BTN_GAMEPAD in buttons
