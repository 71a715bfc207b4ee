"""Databases of each kind that repeat names and identifiers: accepted when equal, refused when they contradict."""
# SPDX-License-Identifier: Apache-2.0
import pytest
from database_kinds import Frame, arxml, dbc, kcd, sym, written

from mtr_operator.car_link.database.codec import occupied
from mtr_operator.car_link.learn.database_names import bits_of
from mtr_operator.car_link.profile import load_profile
from mtr_operator.domain.errors import ConnectionFailed
from mtr_operator.domain.ports import LockState

KINDS = {".dbc": dbc, ".kcd": kcd, ".sym": sym, ".arxml": arxml}
LOCK, MOVED, COUNT = ("LOCK", 0, 2), ("LOCK", 8, 2), ("COUNT", 16, 8)
DOORS = Frame("DOORS", 0x321, [LOCK, COUNT])
SPEED = Frame("SPEED", 0x1A0, [("KMH", 0, 16)])
HARMLESS = {
    "once": [DOORS, SPEED],
    "same again": [DOORS, SPEED, DOORS],
    "same signal again": [DOORS._replace(signals=[LOCK, COUNT, LOCK])],
    "another message twice": [DOORS, SPEED, SPEED._replace(identifier=0x1A1)],
    "another identifier twice": [DOORS, SPEED, SPEED._replace(name="PACE", signals=[("PACE", 0, 8)])],
    "signal of another message twice": [DOORS, SPEED._replace(signals=[("KMH", 0, 16), ("KMH", 16, 16)])],
    "second name": [DOORS, DOORS._replace(name="DOORS_TOO")],
    "other bits under the identifier": [DOORS, Frame("WINDOWS", 0x321, [("WINDOW", 32, 4)])],
    "unnamed signal under the identifier": [DOORS, Frame("WINDOWS", 0x321, [LOCK, ("WINDOW", 16, 4)])],
}
TWICE = "cannot be used: it is there more than once"
WRONG = {
    "identifier": ([DOORS, DOORS._replace(identifier=0x322)], f"Message DOORS .*{TWICE}"),
    "signal moved": ([DOORS, DOORS._replace(signals=[MOVED, COUNT])], f"Message DOORS .*{TWICE}"),
    "signal missing": ([DOORS, DOORS._replace(signals=[COUNT])], f"Message DOORS .*{TWICE}"),
    "signal twice": ([DOORS._replace(signals=[LOCK, COUNT, MOVED])], f"Signal LOCK of message DOORS .*{TWICE}"),
    "signal longer": ([DOORS._replace(signals=[LOCK, ("LOCK", 0, 3)])], f"Signal LOCK of message DOORS .*{TWICE}"),
    "moved under the identifier": ([DOORS, Frame("OTHER", 0x321, [MOVED])],
                                   "Signal LOCK .* message OTHER.* has the same identifier 0x321 and contradicts it"),
    "other signal in the bits": ([DOORS, Frame("OTHER", 0x321, [("WINDOW", 1, 4)])],
                                 "Signal LOCK .* message OTHER.* has the same identifier 0x321 and contradicts it"),
}


def loaded(folder, suffix, text):
    """States that frames with the first bits 1 and 2 have."""
    profile = load_profile(written(folder, suffix, text))
    return [profile.decode(0x321, False, bytes([raw, *bytes(7)])).state for raw in (1, 2)]


@pytest.mark.parametrize("is_reversed", [False, True], ids=["", "reversed"])
@pytest.mark.parametrize("suffix", KINDS)
@pytest.mark.parametrize("case", HARMLESS)
def test_repetition_without_contradiction_is_accepted(tmp_path, suffix, case, is_reversed):
    frames = HARMLESS[case][::-1] if is_reversed else HARMLESS[case]
    assert loaded(tmp_path, suffix, KINDS[suffix](frames)) == [LockState.LOCKED, LockState.UNLOCKED]


@pytest.mark.parametrize("is_reversed", [False, True], ids=["", "reversed"])
@pytest.mark.parametrize("suffix", KINDS)
@pytest.mark.parametrize("case", WRONG)
def test_contradiction_is_refused_in_either_order(tmp_path, suffix, case, is_reversed):
    frames, words = WRONG[case]
    frames = [frame._replace(signals=frame.signals[::-1]) for frame in frames[::-1]] if is_reversed else frames
    with pytest.raises(ConnectionFailed, match=words) as raised:
        loaded(tmp_path, suffix, KINDS[suffix](frames))
    assert str(raised.value).isprintable() and ("line" in str(raised.value) or suffix != ".dbc")


def test_buses_of_one_file_are_told_apart(tmp_path):
    moved = DOORS._replace(signals=[MOVED])
    with pytest.raises(ConnectionFailed, match="on several buses; leave only the bus of the profile"):
        loaded(tmp_path, ".kcd", kcd([DOORS], [moved]))
    for buses in ([DOORS], [DOORS]), ([DOORS], [moved._replace(name="OTHER")]):
        assert loaded(tmp_path, ".kcd", kcd(*buses)) == [LockState.LOCKED, LockState.UNLOCKED]


@pytest.mark.parametrize(("old", "new"), [("(1,0)", "(2,0)"), ("(1,0)", "(1,1)"), ("[0|0]", "[0|2]")])
def test_scale_offset_and_limits_are_part_of_a_definition(tmp_path, old, new):
    text = dbc([DOORS])
    with pytest.raises(ConnectionFailed, match=TWICE):
        loaded(tmp_path, ".dbc", text + dbc([DOORS]).replace("BU_: A\n", "").replace(old, new))
    assert loaded(tmp_path, ".dbc", text + text.replace("BU_: A\n", "").replace("(1,0)", "(1.0,0.0)"))


SYM = """FormatVersion=6.0 // Do not edit this line!
Title="x"

{SIGNALS}
Sig=LOCK unsigned 2 // Lock
Sig="COUNT" unsigned 8 /u:"ID=1 // [a]"

{SENDRECEIVE}

[DOORS]
ID=321h // of the doors
Len=8
Sig=LOCK 0
Sig=COUNT 8
"""
PAGES = SYM.replace("Len=8\n", "Len=8\nMux=A 16,8 01h\n") + "\n[DOORS]\nLen=8\nMux=B 16,8 2h\nSig=LOCK 0\n"


@pytest.mark.parametrize(("old", "new", "words"), [
    ("Sig=LOCK unsigned 2 //", "Sig=LOCK unsigned 5\nSig=LOCK unsigned 2 //", "in lines 5, 6"),
    ("Sig=LOCK unsigned 2 //", "Sig = \"LOCK\" signed 2 Sig=LOCK unsigned 2 //", "in lines 5, 5"),
    ("ID=321h", "ID=322h\nID=321h", "Message DOORS .*line 10, .*its ID is there more than once, in lines 11, 12"),
    ("Len=8", "Len=8\nLen=7", "its Len is there more than once, in lines 12, 13"),
    ("Len=8", "Len=8\nType=Extended\nType=Standard", "its Type is there more than once, in lines 13, 14"),
    ("ID=321h", "ID=321h-323h", "more than once, with the identifiers 0x321, 0x322, 0x323"),
    ("{SENDRECEIVE}", "{SEND}\n[DOORS]\nID=322h\n{RECEIVE}", "with the identifiers 0x321, 0x322")])
def test_contradiction_in_a_sym_file_is_refused_with_its_lines(tmp_path, old, new, words):
    with pytest.raises(ConnectionFailed, match=words):
        loaded(tmp_path, ".sym", SYM.replace(old, new))


@pytest.mark.parametrize(("old", "new"), [
    ("Sig=LOCK u", "Sig=LOCK unsigned 2 /u:km//h /e:E\nSig=LOCK u"), ("ID=321h", "ID=321h\nID=321h // again"),
    ('Sig="COUNT"', 'Sig=COUNT signed 3\nSig="COUNT"'), ("{SEND", '{ENUMS}\nEnum=F(0="Sig=LOCK", 1="[")\n{SEND')])
def test_repetition_in_a_sym_file_that_changes_no_value_is_accepted(tmp_path, old, new):
    text = SYM.replace(old, new).replace("{SIGNALS}", '{ENUMS}\nEnum=E(0="a")\n{SIGNALS}')
    assert loaded(tmp_path, ".sym", text) == [LockState.LOCKED, LockState.UNLOCKED]


def test_signal_that_pages_repeat_is_read_on_each_of_them(tmp_path):
    profile = load_profile(written(tmp_path, ".sym", PAGES))
    states = [profile.decode(0x321, False, bytes([1, 0, page, *bytes(5)])) for page in (1, 2, 3)]
    assert [each and each.state for each in states] == [LockState.LOCKED, LockState.LOCKED, None]


@pytest.mark.parametrize(("old", "new", "words"), [
    ("2h\nSig=LOCK 0", "2h\nSig=LOCK 8", f"Signal LOCK .*{TWICE}"),
    ("Mux=B 16,8", "Mux=B 24,8", "its Mux is there more than once, in lines 13, 19"),
    ("Mux=B 16,8 2h", "Mux=B 16,8 2h -m", "its Mux is there more than once, in lines 13, 19")])
def test_pages_that_contradict_are_refused(tmp_path, old, new, words):
    assert old in PAGES
    with pytest.raises(ConnectionFailed, match=words):
        load_profile(written(tmp_path, ".sym", PAGES.replace(old, new)))


def test_multiplexer_that_is_there_twice_is_refused_for_its_signals(tmp_path):
    page = '<Multiplex name="PAGE" offset="{}" length="8"><MuxGroup count="{}">{}</MuxGroup></Multiplex>'
    text = kcd([DOORS._replace(signals=[])]).replace("</Message>", page.format(
        8, 1, '<Signal name="LOCK" offset="0" length="2"/>') + page.format(16, 2, "") + "</Message>")
    with pytest.raises(ConnectionFailed, match="its multiplexer PAGE cannot be used: it is there more than once"):
        loaded(tmp_path, ".kcd", text)


@pytest.mark.parametrize("order", ["little_endian", "big_endian"])
def test_occupied_bits_are_those_of_the_signal(order):
    for start in range(24):
        for length in range(1, 20):
            signal = type("Signal", (), {"start": start, "length": length, "byte_order": order})
            assert occupied(signal) == sum(1 << bit for bit in bits_of(signal))
