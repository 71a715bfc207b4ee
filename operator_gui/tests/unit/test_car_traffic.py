"""How full the bus is, and how often the lock message comes."""
# SPDX-License-Identifier: Apache-2.0
import pytest

from mtr_operator.car_link.can_frame import CanFrame
from mtr_operator.car_link.traffic import WINDOW_S, TrafficMeter


def fed(meter, count, period_s, *, is_lock=True, is_extended=False):
    for index in range(count):
        meter.frame(CanFrame(0x100, is_extended, bytes(8), index * period_s), is_lock)


def test_load_is_the_part_of_the_bits_that_frames_take():
    meter = TrafficMeter(500_000)
    fed(meter, 4001, 0.001)
    # 1000 frames a second of 47 + 64 bits.
    assert meter.traffic(4.0, 0.1).load == pytest.approx(0.222, abs=0.001)


def test_extended_frames_take_more():
    meter = TrafficMeter(500_000)
    fed(meter, 4001, 0.001, is_extended=True)
    assert meter.traffic(4.0, 0.1).load == pytest.approx(0.262, abs=0.001)


def test_cycle_is_that_of_the_lock_message_alone():
    meter = TrafficMeter(500_000)
    fed(meter, 21, 0.1)
    fed(meter, 100, 0.02, is_lock=False)
    traffic = meter.traffic(2.0, 0.2)
    assert (traffic.cycle_s, traffic.expected_cycle_s) == (pytest.approx(0.1), 0.2)


def test_nothing_heard_has_no_cycle_and_no_load():
    assert TrafficMeter(500_000).traffic(5.0, 0.1).cycle_s is None
    meter = TrafficMeter(500_000)
    fed(meter, 1, 0.1)
    assert meter.traffic(0.0, 0.1) == TrafficMeter(500_000).traffic(0.0, 0.1)


def test_what_is_long_past_does_not_count():
    meter = TrafficMeter(500_000)
    fed(meter, 100, 0.01)
    old = meter.traffic(2.0 * WINDOW_S, 0.1)
    assert (old.load, old.cycle_s) == (0.0, None)
