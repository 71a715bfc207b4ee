"""Events of a Linux input device yield the same numbers as joy_node."""
# SPDX-License-Identifier: Apache-2.0
import pytest

from mtr_controller_input.evdev_joy.gamepad import EV_ABS, EV_KEY, AxisRange, Gamepad, is_gamepad

STICK, TRIGGER, CROSS = AxisRange(0, 255, 0), AxisRange(0, 255, 0), AxisRange(-1, 1, 0)
# A PS4 controller: sticks 0, 1, 3, 4, triggers 2, 5, cross 16, 17.
PS4_AXES = {0: STICK, 1: STICK, 2: TRIGGER, 3: STICK, 4: STICK, 5: TRIGGER, 16: CROSS, 17: CROSS}
PS4_BUTTONS = [304, 305, 307, 308, 310, 311, 312, 313, 314, 315, 316, 317, 318]
L1, CIRCLE, SHARE = 310, 305, 314


@pytest.fixture
def gamepad():
    return Gamepad(PS4_AXES, PS4_BUTTONS, dict.fromkeys(PS4_AXES, 0))


def test_buttons_and_axes_are_numbered_in_the_order_of_their_codes(gamepad):
    for code in (L1, CIRCLE, SHARE):
        gamepad.take(EV_KEY, code, 1)
    gamepad.take(EV_ABS, 17, -1)
    axes, buttons = gamepad.state()
    assert [index for index, value in enumerate(buttons) if value] == [1, 4, 8]
    assert axes[7] == 1.0


@pytest.mark.parametrize("raw, deflection", [(0, 1.0), (255, -1.0), (300, -1.0)])
def test_up_and_left_are_positive_and_bounded(gamepad, raw, deflection):
    gamepad.take(EV_ABS, 1, raw)
    assert gamepad.state()[0][1] == deflection


def test_stick_within_its_flat_middle_is_released():
    gamepad = Gamepad({0: AxisRange(-128, 127, 15)}, [], {0: 14})
    assert gamepad.state()[0] == [0.0]


def test_repeated_event_is_no_change(gamepad):
    assert gamepad.take(EV_KEY, L1, 1)
    assert not gamepad.take(EV_KEY, L1, 2)
    assert gamepad.take(EV_KEY, L1, 0)


@pytest.mark.parametrize("kind, code", [(0, 0), (EV_KEY, 999), (EV_ABS, 40)])
def test_foreign_event_changes_nothing(gamepad, kind, code):
    assert not gamepad.take(kind, code, 1)


def test_axis_without_range_stays_released():
    assert Gamepad({0: AxisRange(0, 0, 0)}, [], {0: 5}).state() == ([0.0], [])


def test_only_what_has_stick_and_buttons_is_a_gamepad():
    assert is_gamepad(PS4_AXES, PS4_BUTTONS)
    assert not is_gamepad(PS4_AXES, [])
    assert not is_gamepad({3: STICK}, PS4_BUTTONS)
