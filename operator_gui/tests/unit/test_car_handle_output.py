"""The Car's door handle as an output of the CAN adapter."""
# SPDX-License-Identifier: Apache-2.0
import pytest
from serial_adapter import Adapter, adapter_fixture, link_fixture, wait_for

from mtr_operator.car_link.bus import CanCarLink

__all__ = ["adapter_fixture", "link_fixture"]

HANDLE_TAKEN, HANDLE_RELEASED = b"t4B1101", b"t4B1100"


@pytest.fixture(name="handle_link")
def handle_link_fixture(adapter):
    """Link of a car whose profile declares an output."""
    link = CanCarLink("slcan", adapter.path, profile="mtr_honest_car", is_listening=False)
    link.connect()
    yield link
    link.close()


def test_output_is_switched_and_released_through_the_adapter(adapter, handle_link):
    handle = handle_link.handle
    assert not handle.is_taken()
    handle.request(1.5)
    wait_for(handle.is_taken)
    wait_for(lambda: HANDLE_TAKEN in adapter.commands)
    handle.release()
    wait_for(lambda: HANDLE_RELEASED in adapter.commands)
    handle.release()
    assert not handle.is_taken() and adapter.commands.count(HANDLE_TAKEN) == 1


def test_link_that_is_closed_lets_the_handle_go(adapter, handle_link):
    handle_link.handle.request(1.5)
    wait_for(handle_link.handle.is_taken)
    handle_link.close()
    wait_for(lambda: HANDLE_RELEASED in adapter.commands)


@pytest.fixture(name="second")
def second_fixture():
    """Adapter that comes in place of the first."""
    second = Adapter()
    yield second
    second.close()


class Cable:
    """A link whose adapter is pulled, and comes back as another one under the same name."""

    def __init__(self, adapter, second, folder):
        self._adapter, self._second = adapter, second
        self._name = folder / "can"
        self._name.symlink_to(adapter.path)
        self.link = CanCarLink("slcan", str(self._name), profile="mtr_honest_car", is_listening=False)
        self.link.connect()

    def pull(self):
        self._adapter.pull()
        wait_for(lambda: "adapter" in self.link.problem)

    def plug(self):
        self._name.unlink()
        self._name.symlink_to(self._second.path)
        wait_for(lambda: b"O" in self._second.commands and "adapter" not in self.link.problem)


@pytest.fixture(name="cable")
def cable_fixture(adapter, second, tmp_path):
    """Cable whose link is closed after the test."""
    cable = Cable(adapter, second, tmp_path)
    yield cable
    cable.link.close()


def test_request_that_an_adapter_could_not_send_is_not_sent_later(second, cable):
    cable.pull()
    handle = cable.link.handle
    handle.request(1.5)
    cable.plug()
    assert not handle.is_taken()
    # Frames leave in their order: one of before would stand ahead of this one.
    handle.release()
    wait_for(lambda: HANDLE_RELEASED in second.commands)
    assert HANDLE_TAKEN not in second.commands


def test_handle_that_was_let_go_while_the_adapter_was_away_is_let_go_when_it_is_back(second, cable):
    handle = cable.link.handle
    handle.request(1.5)
    wait_for(handle.is_taken)
    cable.pull()
    handle.release()
    assert not handle.is_taken()
    # A second in which the adapter is away passes: what was asked for before is no longer kept by the reader.
    refused = cable.link.problem
    wait_for(lambda: cable.link.problem != refused)
    cable.plug()
    wait_for(lambda: HANDLE_RELEASED in second.commands)
    assert HANDLE_TAKEN not in second.commands


def test_adapter_that_listens_switches_no_output_and_says_so(adapter):
    link = CanCarLink("slcan", adapter.path, profile="mtr_honest_car")
    link.connect()
    assert link.handle is None and "only listens: a person takes it" in link.notices[0]
    link.close()
    assert not any(command[:1] in (b"t", b"T", b"O") for command in adapter.commands)


def test_car_without_an_output_has_no_handle_and_nothing_is_sent(adapter, link):
    assert link.handle is None
    assert not any(command[:1] in (b"t", b"T") for command in adapter.commands)
