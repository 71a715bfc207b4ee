"""Encodings of CAN databases, and lengths that a KCD leaves to its signals."""
# SPDX-License-Identifier: Apache-2.0
import codecs

import pytest
from database_kinds import Frame, arxml, dbc, kcd, sym, written

from mtr_operator.car_link.database.load import load_database
from mtr_operator.car_link.profile import load_profile
from mtr_operator.domain.ports import LockState

DOORS = Frame("DOORS", 0x321, [("LOCK", 0, 2), ("LÜCKE", 16, 8)])
KINDS = {".dbc": dbc, ".kcd": kcd, ".sym": sym, ".arxml": arxml}
ENCODED = {
    "UTF-8 with mark": lambda text: text.encode("utf-8-sig"), "UTF-16 with mark": lambda text: text.encode("utf-16"),
    "UTF-16 with mark, big": lambda text: codecs.BOM_UTF16_BE + text.encode("utf-16-be"),
    "UTF-16": lambda text: text.encode("utf-16-le"), "UTF-16, big": lambda text: text.encode("utf-16-be"),
    "UTF-16, lines of Windows": lambda text: text.replace("\n", "\r\n").encode("utf-16-le"),
    "UTF-16, lines of old computers": lambda text: text.replace("\n", "\r").encode("utf-16"),
    "Windows": lambda text: text.encode("cp1252")}


@pytest.mark.parametrize("has_fault", [False, True], ids=["", "fault"])
@pytest.mark.parametrize("suffix", KINDS)
@pytest.mark.parametrize("encoding", ENCODED)
def test_each_kind_is_read_in_each_encoding(tmp_path, encoding, suffix, has_fault):
    frames = [Frame("A", 2, [("KMH", 0, 17)]), DOORS]
    text = KINDS[suffix](frames)
    if has_fault:
        old, new = {".dbc": ("0|17@", "0|x@"), ".sym": ("KMH unsigned", "KMH foo")}.get(suffix, ("17", "x"))
        text = text.replace(old, new)
    path = written(tmp_path, suffix, "")
    (tmp_path / f"car{suffix}").write_bytes(ENCODED[encoding](text))
    assert load_profile(path).decode(0x321, False, b"\x01" + bytes(7)).state is LockState.LOCKED
    names = [each.name for each in load_database(tmp_path / f"car{suffix}").message("DOORS").signals]
    assert "LÜCKE" in names or suffix == ".dbc" and has_fault


@pytest.mark.parametrize("has_fault", [False, True], ids=["", "fault"])
@pytest.mark.parametrize(("signals", "length"), [
    ('<Signal name="LOCK" offset="0" length="2"/>', 1), ('<Signal name="LOCK" offset="7" length="2"/>', 2),
    ('<Signal name="LOCK" offset="0" length="2"/><Signal name="B" offset="8"/>', 2),
    # The signal that begins last is not the one that ends last.
    ('<Signal name="LOCK" offset="8" length="2"/><Signal name="B" offset="4" length="40"/>', 6),
    ('<Signal name="LOCK" offset="6" length="2" endianess="big"/><Signal name="B" offset="0" length="24" '
     'endianess="big"/>', 3),
    ('<Multiplex name="P" offset="0" length="8"><MuxGroup count="1"><Signal name="LOCK" offset="30" length="3"/>'
     '</MuxGroup></Multiplex><Signal name="B" offset="31"/>', 5)])
@pytest.mark.parametrize("attribute", ['length="auto" ', ""])
def test_length_of_a_kcd_message_is_that_of_its_farthest_signal(tmp_path, attribute, signals, length, has_fault):
    text = kcd([DOORS._replace(signals=[]), Frame("A", 2, [("KMH", 0, 17)])])
    text = text.replace('name="DOORS" length="8"', f'{attribute}name="DOORS"')
    text = text.replace("</Message>", signals + "</Message>", 1)
    if has_fault:
        text = text.replace('"17"', '"x"')
    load_profile(written(tmp_path, ".kcd", text))
    assert load_database(tmp_path / "car.kcd").message("DOORS").length == length
