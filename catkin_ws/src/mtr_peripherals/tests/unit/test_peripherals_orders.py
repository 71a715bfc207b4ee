"""Orders for the firmware with its own time: none before that time is known, and none after the end."""
# SPDX-License-Identifier: Apache-2.0
import math
from dataclasses import replace

import pytest

from mtr_core.crc import is_sound
from mtr_peripherals.core import STOPPED
from mtr_peripherals.firmware import ServoPress, Signal, SignalOrder
from mtr_peripherals.firmware_clock import FirmwareClock
from mtr_peripherals.orders import FirmwareOrders

SECOND = 1_000_000_000
OUTCOME = replace(STOPPED, stop=False, lift_height_m=0.5, press=ServoPress(3, 1, 1.0, 200, 11 * SECOND))


class Wire:
    """Stores the sent messages."""

    def __init__(self):
        self.clock, self.commands, self.presses, self.signals = FirmwareClock(), [], [], []
        self.orders = FirmwareOrders(self.clock, self.commands.append, self.presses.append, self.signals.append)


@pytest.fixture
def wire():
    """Return the link to a firmware whose clock shows 1 s at 10 s of the steady clock."""
    found = Wire()
    found.clock.observe(1_000_000, 10 * SECOND)
    return found


def test_nothing_is_ordered_before_the_firmwares_clock_is_known():
    wire = Wire()
    wire.orders.send(OUTCOME, SECOND)
    assert not wire.commands and not wire.presses


def test_order_says_until_when_it_may_be_obeyed_on_the_firmwares_clock(wire):  # B8
    for _ in range(2):
        wire.orders.send(OUTCOME, 10 * SECOND + SECOND // 10)
    assert [command.seq for command in wire.commands] == [1, 2]
    assert (wire.commands[0].latest_us, wire.presses[0].latest_us) == (1_600_000, 2_000_000)


def test_signals_leave_before_the_command_so_that_the_board_knows_of_its_stop_input(wire):
    sent = []
    orders = FirmwareOrders(wire.clock, sent.append, sent.append, sent.append)
    orders.send(replace(OUTCOME, signals=SignalOrder(Signal.SETS_OFF, True, True)), 10 * SECOND)
    assert [type(message).__name__ for message in sent] == ["FirmwareSignals", "FirmwareCommand", "FirmwarePress"]
    signals = sent[0]
    assert (signals.signal, signals.beacon, signals.stop_input, signals.latest_us) == (1, 1, 1, 1_500_000)
    assert is_sound(signals)


def test_stop_between_two_ticks_leaves_the_signals_as_they_are(wire):
    wire.orders.send(STOPPED, 10 * SECOND)
    assert wire.commands and not wire.signals


def test_lift_is_stopped_at_the_end_and_nothing_is_ordered_after_it(wire):
    wire.orders.end(10 * SECOND)
    wire.orders.send(OUTCOME, 10 * SECOND)
    assert [command.stop for command in wire.commands] == [1] and not wire.presses
    assert math.isnan(wire.commands[0].lift_height_m)
