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
