"""How serial-line adapters are opened: by Lawicel's manual, and the CANable, whose firmware has words of its own."""
# SPDX-License-Identifier: Apache-2.0
import contextlib
import os
import select

import pytest
from serial_adapter import LOCK_ID, Adapter, wait_for

from mtr_operator.car_link.adapter import AdapterSettings, open_adapter, shut_down
from mtr_operator.car_link.drivers.health import REFUSES, AdapterHealth


class Wordy(Adapter):
    """An adapter that knows more of its commands. answers: to each command, by the manual OK.

    Attributes: is_open, is_silent: of its controller.
    """

    is_open = is_silent = False

    def answer(self, command):
        raise NotImplementedError

    def _serve(self):
        line = b""
        while self._wake[0] not in select.select([self.master, self._wake[0]], [], [])[0]:
            *commands, line = (line + os.read(self.master, 1000)).split(b"\r")
            for command in commands:
                self.commands.append(command)
                os.write(self.master, self.answer(command))


class Canable(Wordy):
    """canable-fw: says nothing but its version, and knows no L."""

    def answer(self, command):
        if command in (b"O", b"C"):
            self.is_open = command == b"O"
        elif command in (b"M0", b"M1") and not self.is_open:
            self.is_silent = command == b"M1"
        return b"b158aa7 github.com/normaldotcom/canable-fw.git\r" if command == b"V" else b""


class Lawicel(Wordy):
    """By the manual; knows_l: it is of version 3. M sets a filter, by eight digits."""

    knows_l = True

    def answer(self, command):
        if command == b"V":
            return b"V1013\r"
        if command == b"F":
            return b"F00\r" if self.is_open else b"\a"
        is_unknown = len(command) == 2 and command[:1] == b"M" or command == b"L" and not self.knows_l
        if is_unknown or command == b"C" and not self.is_open:
            return b"\a"
        self.is_open = command in (b"O", b"L") or self.is_open and command != b"C"
        self.is_silent = command == b"L" or self.is_silent and command != b"O"
        return b"\r"


@contextlib.contextmanager
def opened(adapter, is_listening=True):
    bus = open_adapter(AdapterSettings("slcan", adapter.path, is_listening=is_listening))
    try:
        yield bus
    finally:
        shut_down(bus)
        adapter.close()


def received(bus, adapter):
    for _ in range(20):
        bus.recv(0.05)
    adapter.send(b"\x01\x02", 0.0)
    return next(message for message in iter(lambda: bus.recv(0.5), None))


@pytest.mark.parametrize("kind", [Canable, Lawicel])
@pytest.mark.parametrize("is_listening", [True, False])
def test_adapter_listens_or_takes_part_in_its_own_words(kind, is_listening):
    adapter = kind(stamps=False)
    adapter.is_silent = not is_listening
    with opened(adapter, is_listening) as bus:
        message = received(bus, adapter)
        assert (message.arbitration_id, bytes(message.data)) == (LOCK_ID, b"\x01\x02")
        assert adapter.is_open and adapter.is_silent is is_listening
        # By the manual an adapter would take part from the first O on.
        assert kind is Canable or not is_listening or b"O" not in adapter.commands
        assert not bus.refuses


class Sink:
    """What health finds."""

    text = ""

    def fault(self, text):
        self.text = text


def test_adapter_that_does_not_know_how_to_listen_is_told_and_stays_closed():
    adapter = Lawicel(stamps=False)
    adapter.knows_l = False
    with opened(adapter) as bus:
        sink = Sink()
        health = AdapterHealth("slcan", sink)
        wait_for(lambda: bus.recv(0.01) is None and bus.refuses)
        health.look(bus, 1.0)
        assert sink.text == REFUSES and not adapter.is_open
