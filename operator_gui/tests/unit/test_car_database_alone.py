"""Faulty messages of KCD, SYM and ARXML databases: they cost no other message, and hide no contradiction."""
# SPDX-License-Identifier: Apache-2.0
import pytest
from database_kinds import Frame, arxml, kcd, sym, written

from mtr_operator.car_link.database.load import load_database
from mtr_operator.car_link.profile import load_profile
from mtr_operator.domain.errors import ConnectionFailed
from mtr_operator.domain.ports import LockState

KINDS = {".kcd": kcd, ".sym": sym, ".arxml": arxml}
LOCK, COUNT = ("LOCK", 0, 2), ("COUNT", 16, 8)
DOORS, SPEED = Frame("DOORS", 0x321, [LOCK, COUNT]), Frame("SPEED", 0x1A0, [("KMH", 4, 16)])
SYM_DEFINED = "{{SIGNALS}}\nSig=KMH {}\n{{SENDRECEIVE}}"
# What of the message SPEED is replaced, by what, and what of it is reported.
FAULTS = {
    ".kcd": {
        "29 bits": ('id="416"', 'id="0x12FFFFFF"', "Standard frame id 0x12ffffff is more than 11 bits"),
        "no identifier": ('id="416" ', "", "its identifier is missing"),
        "identifier": ('id="416"', 'id="0xZZ"', '"0xZZ" is not a number'),
        "length": ('name="SPEED" length="8"', 'name="SPEED" length="four"', '"four" is not a number'),
        "offset": ('offset="4"', 'offset="abc"', '"abc" is not a number'),
        "no offset": ('offset="4" ', "", "its signal KMH has no offset"),
        "signal length": ('length="16"', 'length="auto"', '"auto" is not a number'),
        "no bit": ('length="16"', 'length="0"', "The signal KMH length 0 is not greater than 0"),
        "slope": ('length="16"/>', 'length="16"><Value slope="x"/></Signal>', '"x" is not a number'),
        "interval": ('name="SPEED"', 'name="SPEED" interval="often"', '"often" is not a number'),
        "label": ('length="16"/>', 'length="16"><LabelSet><Label name="a"/></LabelSet></Signal>', "value is missing")},
    ".sym": {
        "type": ("KMH unsigned", "KMH foo", "Enum 'foo' is not defined"),
        "enum": ("KMH unsigned 4,16", "KMH unsigned 4,16 /e:NOPE", "Enum 'NOPE' is not defined"),
        "place": ("KMH unsigned 4,16", "KMH unsigned", "Invalid syntax: "),
        "identifier": ("ID=1A0h", "ID=XYZh", "Invalid syntax: "),
        "undefined": ("Var=KMH unsigned 4,16", "Sig=KMH 0", "the signal KMH has no definition"),
        "factor": ("KMH unsigned 4,16", "KMH unsigned 4,16 /f:abc", "Invalid syntax: "),
        "string": ("KMH unsigned 4,16", 'KMH unsigned 4,16 /u:"km h', "Invalid syntax: "),
        "garbage": ("Var=KMH", "garbage\nVar=KMH", "Invalid syntax: "),
        "no bit": ("KMH unsigned 4,16", "KMH unsigned 4,0", "The signal KMH length 0 is not greater than 0"),
        "length": ("Len=8\nVar=KMH", "Len=x\nVar=KMH", "Invalid syntax: ")},
    ".arxml": {
        "no identifier": ("<IDENTIFIER>416</IDENTIFIER>", "", "its identifier is missing"),
        "identifier": ("<IDENTIFIER>416<", "<IDENTIFIER>foo<", '"foo" is not a number'),
        "29 bits": ("<IDENTIFIER>416<", "<IDENTIFIER>4160000<", "Standard frame id 0x3f7a00 is more than 11 bits"),
        "signal": ("S0/KMH</I-SIGNAL-REF>", "S0/NOPE</I-SIGNAL-REF>", "Encountered dangling reference I-SIGNAL-REF"),
        "system signal": ("{P}/S0/sys", "{P}/S0/nope", "Encountered dangling reference SYSTEM-SIGNAL-REF"),
        "PDU": ("{P}/pdu", "{P}/nope", "Encountered dangling reference PDU-REF"),
        "no length": ("<LENGTH>16</LENGTH>", "", "a required part is missing or is not a number"),
        "no bit": ("<LENGTH>16<", "<LENGTH>0<", "The signal KMH length 0 is not greater than 0"),
        "length": ("<LENGTH>16<", "<LENGTH>x<", '"x" is not a number'),
        "empty length": ("<LENGTH>16</LENGTH>", "<LENGTH/>", "a required part is missing or is not a number")},
}
CASES = [(suffix, case) for suffix, cases in FAULTS.items() for case in cases]


def spoilt(suffix, case, frames):
    """A database whose message with the signal KMH has the fault."""
    old, new, _ = FAULTS[suffix][case]
    number = next(index for index, frame in enumerate(frames) if frame.signals[0][0] == "KMH")
    text, old, new = KINDS[suffix](frames), old.replace("{P}", f"/P{number}"), new.replace("{P}", f"/P{number}")
    assert text.count(old) == 1
    return text.replace(old, new)


@pytest.mark.parametrize("is_reversed", [False, True], ids=["", "reversed"])
@pytest.mark.parametrize(("suffix", "case"), CASES)
def test_fault_of_another_message_costs_nothing(tmp_path, suffix, case, is_reversed):
    frames = [SPEED, DOORS] if is_reversed else [DOORS, SPEED]
    profile = load_profile(written(tmp_path, suffix, spoilt(suffix, case, frames)))
    states = [profile.decode(0x321, False, bytes([raw, *bytes(7)])).state for raw in (1, 2)]
    assert states == [LockState.LOCKED, LockState.UNLOCKED]


@pytest.mark.parametrize(("suffix", "case"), CASES)
def test_fault_of_the_message_is_refused_with_its_name(tmp_path, suffix, case):
    database = load_database(_database(tmp_path, suffix, spoilt(suffix, case, [SPEED, DOORS])))
    with pytest.raises(ConnectionFailed) as raised:
        database.message("SPEED")
    sentence = str(raised.value)
    assert sentence.startswith("Message SPEED of CAN database ") and sentence.isprintable() and len(sentence) < 600
    assert f" cannot be used: {FAULTS[suffix][case][2]}" in sentence
    assert not any(each in sentence for each in ("object", "instances", "literal", "line 1,"))
    with pytest.raises(ConnectionFailed, match="has no message OTHER; message SPEED.* could not be read: "):
        database.message("OTHER")


@pytest.mark.parametrize(("suffix", "case"), CASES)
@pytest.mark.parametrize("is_reversed", [False, True], ids=["", "reversed"])
def test_faulty_message_hides_no_contradiction(tmp_path, suffix, case, is_reversed):
    for other, words in ((DOORS._replace(identifier=0x1A0, signals=SPEED.signals), "Message DOORS .* cannot be used: "),
                         (DOORS._replace(identifier=0x322), "Message DOORS .* cannot be used: it is there more than")):
        frames = [DOORS, other] if other.identifier == 0x1A0 else [DOORS, other, SPEED]
        try:
            text = spoilt(suffix, case, frames[::-1] if is_reversed else frames)
        except AssertionError:
            continue
        with pytest.raises(ConnectionFailed, match=words):
            load_profile(written(tmp_path, suffix, text))


def test_frame_that_is_nowhere_is_reported_if_the_message_is_missing(tmp_path):
    text = arxml([DOORS, SPEED])
    load_profile(written(tmp_path, ".arxml", text.replace("/P1/SPEED<", "/P1/NOPE<")))
    with pytest.raises(ConnectionFailed, match="no message DOORS; message NOPE could not be read: Encountered"):
        load_profile(written(tmp_path, ".arxml", text.replace("/P0/DOORS<", "/P0/NOPE<")))


@pytest.mark.parametrize(("suffix", "old", "new"), [
    (".kcd", 'length="16"', 'length="x"'), (".sym", "KMH unsigned", "KMH foo"),
    (".arxml", "<LENGTH>16<", "<LENGTH>x<")])
def test_unreadable_message_on_the_identifier_of_the_message_is_refused(tmp_path, suffix, old, new):
    text = KINDS[suffix]([DOORS, SPEED._replace(identifier=0x321)])
    with pytest.raises(ConnectionFailed, match="SPEED.* has the same identifier 0x321 and could not be read"):
        load_profile(written(tmp_path, suffix, text.replace(old, new)))


def test_bus_of_an_unreadable_message_counts(tmp_path):
    text = kcd([DOORS], [SPEED._replace(identifier=0x321)]).replace('length="16"', 'length="x"')
    assert load_profile(written(tmp_path, ".kcd", text)).message.name == "DOORS"


SYM = """FormatVersion=6.0 // Do not edit this line!
Title="x"
{ENUMS}
Enum=Table(0="[A]", 1="b // c", // d
 2="e")
{SIGNALS}
Sig="LOCK" Table 2 /u:"ID=1" // [DOORS]
Sig=COUNT/2 unsigned 8
Sig=PAGED unsigned 8 /e:Table
Sig=BAD unsigned x
{SEND}
[DOORS]
ID=321h // doors
Len=8
Mux=A 16,8 01h
Sig="LOCK" 0
Sig=COUNT/2 8

[DOORS]
Len=8
Mux=B 16,8 2h
Sig="LOCK" 0
Sig=PAGED 32
{RECEIVE}
[SPEED]
ID=1A0h
Sig=BAD 0
"""


def test_definitions_tables_and_pages_of_a_sym_message_are_kept(tmp_path):
    profile = load_profile(written(tmp_path, ".sym", SYM))
    states = [profile.decode(0x321, False, bytes([1, 0, page, *bytes(5)])) for page in (1, 2, 3)]
    assert [each and each.state for each in states] == [LockState.LOCKED, LockState.LOCKED, None]
    signals = load_database(tmp_path / "car.sym").message("DOORS").signals
    assert {each.name for each in signals} >= {"LOCK", "COUNT/2", "PAGED"}
    good = load_database(_database(tmp_path, ".sym", SYM.replace("unsigned x", "unsigned 8"))).message("DOORS").signals
    assert [repr(each) for each in signals] == [repr(each) for each in good]


@pytest.mark.parametrize(("old", "new"), [
    # A string without its end, up to the string of a later message, so that the messages between are no messages.
    ("Sig=BAD unsigned x",
     'Sig=BAD unsigned 8 /u:"x\n{SENDRECEIVE}\n[DOORS]\nID=322h\n{SIGNALS}\nSig=C unsigned 8 /u:"x'),
    ("ID=1A0h", 'ID=1A0h\nVar=X unsigned 8,8 /u:"x\n[DOORS]\nID=322h\nVar=LOCK unsigned 8,2 /u:"x'),
    ("ID=1A0h", 'ID=1A0h\nVar=X unsigned 8,8 /u:"x\n[OTHER]\nID=321h\nVar=Y unsigned 0,2 /u:"x'),
    ("{SEND}\n", "{SEND}\nID=321h\n"), ("{RECEIVE}", "{RECIEVE}\n[DOORS]\nID=322h\n{RECEIVE}"),
    ("{RECEIVE}", "[DOORS 2]\nID=321h\nVar=X unsigned 0,8\n{RECEIVE}")])
def test_message_that_a_fault_of_a_sym_file_may_hide_is_refused(tmp_path, old, new):
    with pytest.raises(ConnectionFailed):
        load_profile(written(tmp_path, ".sym", SYM.replace(old, new)))


def _database(folder, suffix, text):
    written(folder, suffix, text)
    return folder / f"car{suffix}"
