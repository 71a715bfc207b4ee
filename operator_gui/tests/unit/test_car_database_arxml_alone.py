"""Messages of an ARXML read one by one with versions of the library that have other private parts."""
# SPDX-License-Identifier: Apache-2.0
import time

import cantools.database.can.formats.arxml as library
import pytest
from database_kinds import Frame, arxml, written

from mtr_operator.car_link.database.arxml_alone import arxml_messages
from mtr_operator.car_link.database.load import load_database
from mtr_operator.domain.errors import ConnectionFailed

# Seconds of the processor; 600,000 signals take more than a minute.
MAX_S = 4.0
LOCK, KMH = ("LOCK", 0, 2), ("KMH", 4, 16)
GOOD = arxml([Frame("DOORS", 0x321, [LOCK]), Frame("SPEED", 0x1A0, [KMH])])
FAULTY = GOOD.replace("<LENGTH>16<", "<LENGTH>x<")


class OtherParameters(library.SystemLoader):
    def _load_message(self, bus_name, triggering, options=None):
        return super()._load_message(bus_name, triggering)


class MoreMessages(library.SystemLoader):
    def _load_messages(self, package_list):
        found = super()._load_messages(package_list)
        return [*found, *found]


class WithoutMethods:
    def __init__(self, root, strict):
        raise TypeError


def _refusal(folder):
    written(folder, ".arxml", FAULTY)
    with pytest.raises(ConnectionFailed) as raised:
        load_database(folder / "car.arxml")
    return str(raised.value)


@pytest.mark.parametrize("other", [OtherParameters, MoreMessages, WithoutMethods])
def test_other_reader_of_the_library_refuses_the_whole_file(tmp_path, monkeypatch, other):
    monkeypatch.setattr(library, "SystemLoader", other)
    assert "car.arxml cannot be read: " in _refusal(tmp_path)


@pytest.mark.parametrize("name", ["SystemLoader", "is_ecu_extract"])
def test_library_without_its_reader_refuses_the_whole_file(tmp_path, monkeypatch, name):
    monkeypatch.delattr(library, name)
    assert "car.arxml cannot be read: " in _refusal(tmp_path)


def test_ecu_extract_is_not_read_as_a_system():
    assert arxml_messages(FAULTY).faults == {"SPEED": '"x" is not a number'}
    assert arxml_messages(FAULTY.replace("<AR-PACKAGES>", "<AR-PACKAGES><AR-PACKAGE><SHORT-NAME>E</SHORT-NAME>"
                                         "<ELEMENTS><ECUC-VALUE-COLLECTION/></ELEMENTS></AR-PACKAGE>", 1)) is None


def test_signals_that_many_messages_refer_to_are_not_loaded_without_limit():
    signals = [(f"S{number}", 0, 1) for number in range(300)]
    text = arxml([Frame("DOORS", 1, signals)])
    begin, end = text.index("<CAN-FRAME-TRIGGERING>"), text.index("</FRAME-TRIGGERINGS>")
    triggers = "".join(text[begin:end].replace("T0", f"T{number}") for number in range(2000))
    start = time.process_time()
    with pytest.raises(OverflowError):
        arxml_messages(text[:begin] + triggers + text[end:])
    assert time.process_time() - start < MAX_S
