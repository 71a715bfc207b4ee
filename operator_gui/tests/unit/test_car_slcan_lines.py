"""Lines of an slcan adapter that are none, at the driver. C6"""
# SPDX-License-Identifier: Apache-2.0
import pytest

from mtr_operator.car_link.drivers.slcan import StampedSlcanBus

LIMIT_S = 10.0


@pytest.fixture(name="bus")
def bus_fixture():
    """A driver whose own commands have come back and are forgotten."""
    bus = StampedSlcanBus("loop://", bitrate=500_000)
    bus.serialPortOrig.reset_input_buffer()
    yield bus
    bus.shutdown()


@pytest.mark.parametrize(("line", "can_id"), [
    (b"T1FFFFFFF1AA\r", 0x1FFFFFFF), (b"t7FF1AA\r", 0x7FF), (b"T200000001AA\r", None), (b"t8001AA\r", None),
    (b"DFFFFFFFF1AA\r", None)])
def test_identifier_has_29_or_11_bits(bus, line, can_id):
    bus.serialPortOrig.write(line + b"t1231AA\r")
    message = bus.recv(LIMIT_S)
    assert (message.arbitration_id, bus.malformed) == ((0x123, 1) if can_id is None else (can_id, 0))


@pytest.mark.parametrize("line", [
    b"t1231AA-F15\r", b"t1231AA+015\r", b"t1231AA 015\r", b"t1231AA0_15\r", b"t1231+A\r", b"t1231 A\r", b"t+231AA\r",
    b"t 231AA\r", b"t1_31AA\r", b"T-00001231AA\r", b"d123+AA\r"])
def test_what_is_no_digit_is_no_part_of_a_number(bus, line):
    bus.serialPortOrig.write(line + b"t4561BB0015\r")
    message = bus.recv(LIMIT_S)
    assert (message.arbitration_id, bytes(message.data), bus.stamp_ms, bus.malformed) == (0x456, b"\xbb", 0x15, 1)
