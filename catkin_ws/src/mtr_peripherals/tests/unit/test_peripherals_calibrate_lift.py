"""Calibration from the command line: one valid order until the firmware answers, and the correct result."""
# SPDX-License-Identifier: Apache-2.0
import pytest

from mtr_core.crc import is_sound
from mtr_core.errors import ConfigurationError
from mtr_peripherals.calibrate_lift import main, message_of
from mtr_peripherals.lift_calibration import DONE, REFUSED, UNDER_WAY, Calibration, Report, order_of


class Firmware:
    """Accepts the order after some repetitions and ends with a given state."""

    def __init__(self, takes_after=2, ends=DONE, last_id=41):
        self.state, self.orders = Report(last_id, DONE), []
        self._takes_after, self._ends, self._left = takes_after, ends, 5

    def take(self, order):
        self.orders.append(order)
        if len(self.orders) == self._takes_after:
            self.state = Report(order.id, UNDER_WAY)

    def pass_time(self, _seconds):
        if self.state and self.state.calibration_state == UNDER_WAY:
            self._left -= 1
            if self._left == 0:
                self.state = self.state._replace(calibration_state=self._ends)

    def calibrated(self, stroke_m=1.2):
        return Calibration(self.take, lambda: self.state, self.pass_time).run(stroke_m)


def test_order_is_repeated_with_one_new_id_until_the_end():
    firmware = Firmware(takes_after=3)
    assert firmware.calibrated() == (True, "The lift is calibrated.")
    assert [order.id for order in firmware.orders] == [42] * 7
    assert is_sound(message_of(firmware.orders[0]))


def test_each_order_may_be_obeyed_for_half_a_second_of_the_firmwares_clock():  # B8
    firmware = Firmware()
    firmware.state = Report(41, DONE, time_us=2 ** 32 - 100_000)
    firmware.calibrated()
    assert firmware.orders[0].latest_us == 400_000
    assert message_of(firmware.orders[0]).latest_us == 400_000


@pytest.mark.parametrize("firmware, word", [
    (Firmware(ends=REFUSED), "refused"), (Firmware(takes_after=999), "not taken"),
    (Firmware(ends=UNDER_WAY), "not ended")])
def test_failure_says_what_has_happened(firmware, word):
    done, sentence = firmware.calibrated()
    assert not done
    assert word in sentence


def test_silent_firmware_is_ordered_nothing():
    firmware = Firmware()
    firmware.state = None
    assert "silent" in firmware.calibrated()[1]
    assert firmware.orders == []


def test_id_is_never_zero():
    assert order_of(1.0, 2 ** 32 - 1).id == 1


@pytest.mark.parametrize("stroke_m", [0.0, 2.5, float("nan")])
def test_stroke_out_of_range_is_named(stroke_m):
    with pytest.raises(ConfigurationError, match="stroke"):
        order_of(stroke_m, 0)


def test_stroke_out_of_range_ends_the_program_with_a_sentence(capsys):
    assert main(["calibrate_lift", "9"]) == 1
    assert "stroke" in capsys.readouterr().err


def test_dry_run_prints_the_sealed_order_without_a_master(capsys):
    assert main(["calibrate_lift", "1.2", "--dry-run"]) == 0
    printed = capsys.readouterr().out
    assert "stroke_m: 1.2" in printed and f"crc: {message_of(order_of(1.2, 0)).crc}" in printed
