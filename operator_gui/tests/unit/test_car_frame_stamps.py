"""Frames are timed by the kernel or the adapter where the interface does it, else by their arrival."""
# SPDX-License-Identifier: Apache-2.0
import math
import time

import can
import pytest

from mtr_operator.car_link.clocks.frame_stamps import frame_time
from mtr_operator.car_link.clocks.stamp_kind import StampKind

NOW_S = 500.0


def message(timestamp):
    """A frame with what the driver calls its time."""
    return can.Message(arbitration_id=0x320, timestamp=timestamp)


def test_b9_frame_that_waited_for_the_program_has_the_kernels_time():
    arrival_s, stamp_s, kind = frame_time("socketcan", message(time.time() - 0.25), NOW_S)
    assert arrival_s == pytest.approx(NOW_S - 0.25, abs=0.02)
    assert (stamp_s, kind) == (None, StampKind.KERNEL)


@pytest.mark.parametrize("age_s", [-3600.0, 5.0, 3600.0, math.nan])
def test_b9_kernels_stamp_of_a_clock_that_was_set_is_not_taken(age_s):
    assert frame_time("socketcan", message(time.time() - age_s), NOW_S) == (NOW_S, None, StampKind.ARRIVAL)


@pytest.mark.parametrize("interface", ["pcan", "kvaser", "vector", "ixxat"])
def test_b9_frame_of_an_adapter_with_a_clock_has_its_stamp(interface):
    assert frame_time(interface, message(12.345), NOW_S) == (NOW_S, 12.345, StampKind.ADAPTER)


@pytest.mark.parametrize("interface, timestamp", [
    ("pcan", 0.0), ("pcan", math.nan), ("virtual", 12.0), ("slcan", 12.0)])
def test_b9_frame_without_a_stamp_has_its_arrival(interface, timestamp):
    assert frame_time(interface, message(timestamp), NOW_S) == (NOW_S, None, StampKind.ARRIVAL)
