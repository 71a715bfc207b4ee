"""Adapters and settings with which no link to the Car is opened, each with a sentence."""
# SPDX-License-Identifier: Apache-2.0
import pytest
from serial_adapter import Adapter, adapter_fixture, link_fixture

from mtr_operator.car_link.bus import CanCarLink
from mtr_operator.domain.errors import ConnectionFailed, InvalidParameter

__all__ = ["adapter_fixture", "link_fixture"]


def test_missing_adapter_is_named():
    with pytest.raises(ConnectionFailed, match="/dev/no_such_adapter"):
        CanCarLink("slcan", "/dev/no_such_adapter").connect()


def test_device_that_does_not_answer_is_no_adapter():
    silent = Adapter(answer=b"")
    silent.flags = b""
    try:
        with pytest.raises(ConnectionFailed, match="does not answer"):
            CanCarLink("slcan", silent.path).connect()
    finally:
        silent.close()


def test_device_that_speaks_another_language_is_no_adapter():
    receiver = Adapter(answer=b"$GPGGA,1,2,3\r\n")
    try:
        with pytest.raises(ConnectionFailed, match="something else than the slcan protocol"):
            CanCarLink("slcan", receiver.path).connect()
    finally:
        receiver.close()


def test_file_that_is_no_terminal_is_refused(tmp_path):
    path = tmp_path / "file"
    path.write_text("")
    with pytest.raises(ConnectionFailed, match="no serial port"):
        CanCarLink("slcan", str(path)).connect()


def test_device_that_is_no_serial_port_is_told_without_numbers_of_the_system__B18():
    with pytest.raises(ConnectionFailed, match="^/dev/null is no serial port; give the CAN adapter's"):
        CanCarLink("slcan", "/dev/null").connect()


@pytest.mark.parametrize(("arguments", "words"), [
    (("telepathy", "0"), "'telepathy'; allowed are .*slcan"), (("slcan", ""), "channel is empty"),
    (("slcan", "/dev/x", 5), "bit rate is 5; allowed is 10000 to 1000000")])
def test_invalid_setting_is_named(arguments, words):
    with pytest.raises(InvalidParameter, match=words):
        CanCarLink(*arguments)


def test_rate_that_the_adapter_does_not_know_is_refused(adapter):
    with pytest.raises(ConnectionFailed, match="bitrate"):
        CanCarLink("slcan", adapter.path, 123_456).connect()


def test_database_is_checked_before_the_adapter_is_opened(adapter):
    with pytest.raises(ConnectionFailed, match="no car profile"):
        CanCarLink("slcan", adapter.path, profile="my_car").connect()
    assert adapter.commands == []


def test_adapter_of_another_program_is_left_alone(adapter, link):
    before = list(adapter.commands)
    with pytest.raises(ConnectionFailed, match="another program uses it"):
        CanCarLink("slcan", adapter.path).connect()
    assert adapter.commands[:len(before)] == before
    assert adapter.commands.count(b"Z1") == before.count(b"Z1")
