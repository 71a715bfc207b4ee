"""Device side of the serial-line CAN protocol: answers, stamps, invalid input from the host."""
# SPDX-License-Identifier: Apache-2.0
import pytest

from mtr_simulation.car.slcan_protocol import SlcanAdapter

OK, ERROR = b"\r", b"\a"


def opened(*commands):
    """An adapter that has processed some commands and opened its channel."""
    adapter = SlcanAdapter()
    for command in (*commands, b"S6\r", b"O\r"):
        assert adapter.receive(command) == OK
    return adapter


def test_channel_opens_only_once_configured_and_only_once():
    adapter = SlcanAdapter()
    assert adapter.receive(b"O\r") == ERROR
    assert adapter.receive(b"S6\rO\rO\r") == OK + OK + ERROR
    assert adapter.is_open


def test_timing_registers_configure_too():
    assert SlcanAdapter().receive(b"s031C\rL\r") == OK + OK


@pytest.mark.parametrize("line", [b"S9", b"S", b"S66", b"s12", b"sXYZW", b"Z2", b"Z", b"Q", b"?", b"V1", b"\xff\x00"])
def test_wrong_line_is_answered_with_bell(line):
    assert SlcanAdapter().receive(line + b"\r") == ERROR


def test_empty_line_is_answered_with_ok():
    assert SlcanAdapter().receive(b"\r\r") == OK + OK


def test_settings_are_refused_while_open():
    adapter = opened()
    assert adapter.receive(b"S6\rs031C\rZ1\r") == ERROR * 3


def test_close_answers_ok_when_open_and_bell_when_closed():
    adapter = opened()
    assert adapter.receive(b"C\rC\r") == OK + ERROR
    assert not adapter.is_open


def test_version_serial_number_and_status_have_the_form_of_the_manual():
    adapter = opened()
    assert adapter.receive(b"V\r") == b"V1013\r"
    assert adapter.receive(b"N\r") == b"NMTR1\r"
    assert adapter.receive(b"F\r") == b"F00\r"
    assert SlcanAdapter().receive(b"F\r") == ERROR


def test_commands_may_arrive_byte_by_byte():
    adapter = SlcanAdapter()
    assert b"".join(adapter.receive(bytes([byte])) for byte in b"S6\rO\r") == OK + OK


def test_frames_carry_no_stamp_by_default():
    assert opened().encode(0x320, bytes([1, 2, 0xAB]), 5_000_000) == b"t32030102AB\r"


def test_extended_identifier_has_eight_digits():
    assert opened().encode(0x18DAF110, b"", 0) == b"T18DAF1100\r"


@pytest.mark.parametrize(
    ("time_ns", "stamp"),
    [(0, b"0000"), (1_007_999_999, b"03EF"), (59_999_000_000, b"EA5F"), (60_000_000_000, b"0000")],
)
def test_stamp_counts_milliseconds_and_starts_again_each_minute(time_ns, stamp):
    assert opened(b"Z1\r").encode(0x320, b"\x01", time_ns) == b"t320101" + stamp + b"\r"


@pytest.mark.parametrize(
    ("line", "answer"),
    [
        (b"t12320102", b"z\r"),
        (b"T1234567800", ERROR),
        (b"T123456780", b"Z\r"),
        (b"r1238", b"z\r"),
        (b"R123456784", b"Z\r"),
        (b"t8000", ERROR),
        (b"t1239", ERROR),
        (b"t12320", ERROR),
        (b"t12", ERROR),
        (b"tXYZ0", ERROR),
        (b"T200000000", ERROR),
        (b"T1FFFFFFF8" + b"00" * 8, b"Z\r"),
        (b"T1FFFFFFF8" + b"00" * 9, ERROR),
    ],
)
def test_frame_from_the_host_is_checked(line, answer):
    assert opened().receive(line + b"\r") == answer


def test_listen_only_channel_does_not_transmit():
    adapter = SlcanAdapter()
    adapter.receive(b"S6\rL\r")
    assert adapter.receive(b"t1230\r") == ERROR
    assert adapter.transmitted == 0


def test_frames_of_the_host_lie_ready_for_the_car_without_their_number_growing():
    adapter = opened()
    adapter.receive(b"t4B1101\rr1230\rT0000123420A0B\rt4B13\r")
    assert list(adapter.sent) == [(0x4B1, b"\x01"), (0x1234, b"\x0a\x0b")]
    for _ in range(1000):
        adapter.receive(b"t1230\r")
    assert len(adapter.sent) < 100


def test_endless_line_is_answered_once_and_forgotten():
    adapter = SlcanAdapter()
    assert adapter.receive(b"t" * 100_000) == b""
    assert adapter.receive(b"\rV\r") == ERROR + b"V1013\r"


def test_status_tells_of_bus_off_and_once_of_an_overrun():
    adapter = opened()
    adapter.bus_off, adapter.overrun = True, True
    assert adapter.receive(b"F\rF\r") == b"FAC\rFA4\r"
    assert adapter.receive(b"t1230\r") == ERROR
