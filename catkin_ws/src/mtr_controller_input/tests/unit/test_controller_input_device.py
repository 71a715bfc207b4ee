"""A Linux input device, simulated with evdev's own events, yields a stream of states."""
# SPDX-License-Identifier: Apache-2.0
import os

import evdev
import pytest

from mtr_controller_input.evdev_joy.device import EV_SYN, SYN_DROPPED, find, states
from mtr_controller_input.evdev_joy.gamepad import EV_ABS, EV_KEY

X, Y = evdev.ecodes.ABS_X, evdev.ecodes.ABS_Y
A, L1 = evdev.ecodes.BTN_GAMEPAD, evdev.ecodes.BTN_TL
PERIOD_S = 0.01


class FakeDevice:
    """A gamepad with one stick and two buttons; a pipe replaces the kernel's queue.

    Attributes:
        sticks: current raw values as returned by the kernel.
        held: codes of the held buttons.
    """

    name, path = "fake gamepad", "/dev/input/event7"

    def __init__(self):
        self.fd, self._hand = os.pipe()
        self._queue = []
        self.sticks, self.held, self.is_gone = {X: 128, Y: 128}, [], False

    def happen(self, kind, code, value):
        """Generate one event."""
        self._queue.append(evdev.InputEvent(0, 0, kind, code, value))
        os.write(self._hand, b".")

    def unplug(self):
        """From now on each call fails, as for a device that is gone."""
        self.is_gone = True

    def capabilities(self):
        self._fail_when_gone()
        axes = [(code, evdev.AbsInfo(value, 0, 255, 0, 15, 0)) for code, value in self.sticks.items()]
        return {EV_KEY: [A, L1], EV_ABS: axes}

    def absinfo(self, code):
        self._fail_when_gone()
        return dict(self.capabilities()[EV_ABS])[code]

    def active_keys(self):
        return self.held

    def read(self):
        self._fail_when_gone()
        os.read(self.fd, 100)
        events, self._queue = self._queue, []
        return iter(events)

    def close(self):
        os.close(self.fd)
        os.close(self._hand)

    def _fail_when_gone(self):
        if self.is_gone:
            raise OSError(19, "No such device")


@pytest.fixture
def device():
    fake = FakeDevice()
    yield fake
    fake.close()


def test_still_controller_gives_a_sign_of_life(device):
    stream = states(device, PERIOD_S)
    assert next(stream) == next(stream) == ([0.0, 0.0], [0, 0])


def test_events_that_come_together_are_one_state(device):
    stream = states(device, PERIOD_S)
    device.happen(EV_ABS, Y, 0)
    device.happen(EV_KEY, L1, 1)
    assert next(stream) == ([0.0, 1.0], [0, 1])


def test_button_held_before_it_was_opened_is_held(device):
    device.held = [L1]
    assert next(states(device, PERIOD_S)) == ([0.0, 0.0], [0, 1])


def test_state_is_asked_for_again_when_events_were_lost(device):
    device.held, device.sticks[Y] = [L1], 0
    stream = states(device, PERIOD_S)
    assert next(stream) == ([0.0, 1.0], [0, 1])
    device.held, device.sticks[Y] = [], 128
    device.happen(EV_SYN, SYN_DROPPED, 0)
    assert next(stream) == ([0.0, 0.0], [0, 0])


def test_unplugged_controller_ends_the_stream_though_nothing_is_to_be_read(device):
    stream = states(device, PERIOD_S)
    next(stream)
    device.unplug()
    assert list(stream) == []


def test_unplugged_controller_ends_the_stream_and_its_last_events_move_nothing(device):
    stream = states(device, PERIOD_S)
    device.happen(EV_ABS, Y, 0)
    device.unplug()
    assert list(stream) == []


def test_first_gamepad_among_the_devices_is_found(device):
    class Keyboard(FakeDevice):
        def capabilities(self):
            return {EV_KEY: [evdev.ecodes.KEY_A]}

    def open_device(path):
        if path == "gone":
            raise OSError(19, "No such device")
        return device if path == "gamepad" else Keyboard()

    assert find(["gone", "keyboard", "gamepad"], open_device) is device
    assert find(["gone", "keyboard"], open_device) is None
