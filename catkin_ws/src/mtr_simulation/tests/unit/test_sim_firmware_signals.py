"""Stop input, buzzer and beacon of the simulated firmware behave as on the real firmware."""
# SPDX-License-Identifier: Apache-2.0
import math

import pytest

from mtr_core.crc import is_sound
from mtr_simulation.conversions import inputs_message
from mtr_simulation.firmware.signals import StopState
from mtr_simulation.firmware.simulated import LED_SETS_OFF, SimulatedFirmware

MS = 1_000_000
START_NS = 1000 * MS
REFUSED = 3
RELEASED = (1000, 1000)


class Bench:
    """A firmware whose host commands a height and the signals every 100 ms."""

    def __init__(self):
        self.firmware, self.time_ns = SimulatedFirmware(), START_NS
        self.height_m, self.signals = 1.0, (0, False, True)
        self.firmware.step(self.time_ns)

    def run(self, milliseconds):
        """Advance the simulation and return the state that the firmware then reports."""
        for _ in range(milliseconds // 20):
            if self.time_ns % (100 * MS) == 0:
                if self.signals:
                    self.firmware.signals(*self.signals)
                self.firmware.command(self.height_m, 2)
            self.time_ns += 20 * MS
            self.firmware.step(self.time_ns)
        return self.firmware.input_state()


@pytest.fixture
def bench():
    return Bench()


def test_chain_that_is_fitted_and_closed_stops_nothing(bench):
    assert bench.run(1000).stop == StopState.CLOSED and bench.firmware.lift_height_m > 0.05


def test_open_contact_stops_lift_and_servos_until_it_was_closed_for_a_while(bench):
    bench.run(1000)
    bench.firmware.press(1, 3, 1.0, 10_000)
    bench.run(400)
    bench.firmware.inputs.contact_is_open = True
    assert bench.run(1000).stop == StopState.OPEN
    height_m = bench.firmware.lift_height_m
    bench.firmware.press(2, 1, 1.0, 100)
    bench.run(1000)
    assert bench.firmware.lift_height_m == height_m and bench.firmware.servo_us == RELEASED
    assert (bench.firmware.state().press_id, bench.firmware.state().press_state) == (2, REFUSED)
    bench.firmware.inputs.contact_is_open = False
    assert bench.run(60).stop == StopState.OPEN
    assert bench.run(1000).stop == StopState.CLOSED and bench.firmware.lift_height_m > height_m


def test_undeclared_chain_is_not_in_use_and_a_declared_one_stays_so(bench):
    bench.signals = (0, False, False)
    bench.firmware.inputs.contact_is_open = True
    assert bench.run(500).stop == StopState.UNUSED and bench.firmware.lift_height_m > 0.0
    bench.signals = (0, False, True)
    assert bench.run(200).stop == StopState.OPEN
    bench.signals = (0, False, False)
    assert bench.run(500).stop == StopState.OPEN


def test_each_opening_is_counted(bench):
    bench.run(500)
    for count in (1, 2):
        bench.firmware.inputs.contact_is_open = True
        bench.run(100)
        bench.firmware.inputs.contact_is_open = False
        assert bench.run(300).stops == count


def test_signal_ends_with_its_orders_and_the_beacon_remains(bench):
    bench.signals = (1, True, False)
    assert bench.run(300)[3:] == (1, 1) and bench.firmware.state().led_pattern == LED_SETS_OFF
    bench.signals = None
    assert bench.run(1200)[3:] == (0, 1) and bench.firmware.state().led_pattern == 2


@pytest.mark.parametrize("signal", [-1, 3, 255])
def test_unknown_signal_is_refused_and_the_one_in_force_remains(bench, signal):
    bench.signals = (2, True, False)
    bench.run(200)
    refused = bench.firmware.refused_commands
    bench.signals = None
    bench.firmware.signals(signal, False, False)
    assert bench.firmware.refused_commands == refused + 1 and bench.run(100).signal == 2


def test_report_has_a_check_sum(bench):
    message = inputs_message(bench.run(300))
    assert is_sound(message) and message.stop == StopState.CLOSED and not math.isnan(bench.firmware.lift_height_m)
