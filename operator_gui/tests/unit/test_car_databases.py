"""CAN databases as people have them: what is wrong with one message costs no other; what a profile names is exact."""
# SPDX-License-Identifier: Apache-2.0
import math
import random

import cantools
import pytest

from mtr_operator.car_link.database.codec import SignalReader, encode
from mtr_operator.car_link.database.load import load_database
from mtr_operator.car_link.further.spoken_frames import SpokenFrames
from mtr_operator.car_link.profile import PROFILE_FOLDER, load_profile
from mtr_operator.cli import main
from mtr_operator.cli.cars.trying import try_profile
from mtr_operator.domain.errors import ConnectionFailed
from mtr_operator.domain.ports import LockState

HEAD = """VERSION ""

NS_ :
\tCM_
\tBA_DEF_

BS_:

BU_: Body Tester

"""
DOORS = """BO_ 801 DOORS: 8 Body
 SG_ LOCK : 0|2@1+ (1,0) [0|3] "" Tester
 SG_ COUNT : 8|8@1+ (1,0) [0|255] "" Tester

"""
SPEED = """BO_ 416 SPEED: 4 Body
 SG_ KMH : 0|16@1+ (0.01,0) [0|655] "km/h" Tester

"""
TABLE = 'VAL_ 801 LOCK 1 "locked" 2 "unlocked" ;\n'
DATABASE = HEAD + DOORS + SPEED + TABLE
PROFILE = "database: car.dbc\nmessage: DOORS\nsignal: LOCK\nstates: {1: locked, 2: unlocked}\ncycle_time_s: 0.1\n"
LOCKED, UNLOCKED = b"\x01" + bytes(7), b"\x02" + bytes(7)


def written(folder, database=DATABASE, profile=PROFILE, encoding="cp1252"):
    """Path of a profile with its database."""
    (folder / "car.dbc").write_bytes(database.encode(encoding))
    path = folder / "car.yaml"
    path.write_text(profile)
    return str(path)


def spoken_states(profile):
    """What the profile understands of a simulated Car that is locked and then unlocked."""
    frames, heard = SpokenFrames(profile), []
    for is_locked in (True, False, True):
        frames.is_locked = is_locked
        for _, message in frames.next():
            reading = profile.decode(message.arbitration_id, message.is_extended_id, bytes(message.data))
            heard += [] if reading is None else [reading.state]
    return heard


def swapped(old, new):
    assert old in DATABASE
    return DATABASE.replace(old, new)


HARMLESS = {
    "as it is": DATABASE,
    "identifier of 29 bits without its bit": swapped("BO_ 416", "BO_ 318734247"),
    "identifier of 32 bits": swapped("BO_ 416", f"BO_ {2 ** 31 + 2 ** 30}"),
    "name with a digit first": swapped("416 SPEED", "416 2SPEED"),
    "signal with a digit first, and its comment": DATABASE.replace("KMH", "0KMH") + 'CM_ SG_ 416 0KMH "speed";\n',
    "digit first beside the lock, in every place": DATABASE.replace("COUNT", "0_COUNT") + (
        'CM_ SG_ 801 0_COUNT "c";\nVAL_ 801 0_COUNT 0 "none" ;\nBA_DEF_ SG_ "A" INT 0 1;\nBA_DEF_DEF_ "A" 0;\n'
        'BA_ "A" SG_ 801 0_COUNT 1;\nSIG_VALTYPE_ 801 0_COUNT : 0;\nSIG_GROUP_ 801 G 1 : LOCK 0_COUNT;\n'),
    "point in a name": swapped("KMH", "K.M.H"),
    "umlaut in a name": swapped("KMH", "Türe"),
    "blank in a name": swapped("KMH", "K M H"),
    "signal that is cut off": swapped("0|16@1+", "0|16"),
    "signal of no bit": swapped("0|16@1+", "0|0@1+"),
    "signal beyond its message": swapped("0|16@1+", "60|16@1+"),
    "float of nine bits": DATABASE.replace("0|16@1+", "0|9@1+") + "SIG_VALTYPE_ 416 KMH : 1;\n",
    "scale that is no number": swapped("(0.01,0)", "(one,0)"),
    "limits that are no numbers": swapped("[0|655]", "[0|1.#INF]"),
    "no receiver": swapped('"km/h" Tester', '"km/h"'),
    "message without a sender": swapped("SPEED: 4 Body", "SPEED: 4"),
    "message without a length": swapped("SPEED: 4 Body", "SPEED: Body"),
    "message of which only a part is there": swapped("BO_ 416 SPEED: 4 Body", "BO_ 416"),
    "no BS_ and no BU_": DATABASE.replace("BS_:\n\nBU_: Body Tester\n", ""),
    "no NS_": DOORS + SPEED,
    "table of values of no signal": DATABASE + 'VAL_ 416 SPEED_OF_NOTHING 1 "a" ;\nVAL_ 99 NONE 1 "a" ;\n',
    "table of values without its end": DATABASE + 'VAL_ 416 KMH 1 "a"\n',
    "comment that does not end": DATABASE + 'CM_ SG_ 416 KMH "speed;\n',
    "comment of several lines with a message": DATABASE + 'CM_ BO_ 416 "as\nBO_ 801 DOORS: 2 Body\nwas";\n@\n',
    "attribute that is not defined": DATABASE + 'BA_ "Nobody" BO_ 416 1;\n',
    "two messages of one name": DATABASE + SPEED.replace("416", "417") + "@\n",
    "one message twice, the same": DATABASE + DOORS,
    "two signals of one name": swapped(' SG_ KMH', ' SG_ KMH : 16|8@1+ (1,0) [0|1] "" Tester\n SG_ KMH'),
    "page without a multiplexer": swapped("SG_ KMH", "SG_ KMH m1"),
    "two multiplexers without a table": swapped(
        " SG_ KMH", ' SG_ A M : 16|2@1+ (1,0) [0|1] "" Tester\n SG_ B M : 18|2@1+ (1,0) [0|1] "" Tester\n SG_ KMH m1'),
    "multiplexer that is no number": swapped("SG_ KMH", "SG_ KMH mX"),
    "overlap elsewhere": swapped(" SG_ KMH", ' SG_ ALL : 0|32@1- (1,0) [0|1] "" Tester\n SG_ KMH'),
    "overlap with the lock": swapped("COUNT : 8|8", "COUNT : 1|8"),
    "overlap with the lock, big endian": swapped("COUNT : 8|8@1+", "COUNT : 7|8@0-"),
    "signal beside the lock beyond the message": swapped("COUNT : 8|8", "COUNT : 60|8"),
    "signal beside the lock that is no signal": swapped("COUNT : 8|8@1+", "COUNT : 8"),
    "carriage returns": DATABASE.replace("\n", "\r\n"),
    "garbage between messages": swapped(SPEED, "?? §§\n" + SPEED),
}


@pytest.mark.parametrize("database", HARMLESS.values(), ids=HARMLESS)
def test_what_the_profile_does_not_name_costs_nothing(tmp_path, database):
    profile = load_profile(written(tmp_path, database))
    assert profile.decode(801, False, LOCKED).state is LockState.LOCKED
    assert profile.decode(801, False, b"\x02\xff\xff").state is LockState.UNLOCKED
    assert spoken_states(profile) == [LockState.LOCKED, LockState.UNLOCKED, LockState.LOCKED]


@pytest.mark.parametrize("encoding", ["utf-8-sig", "utf-8", "utf-16", "cp1252", "latin-1"])
def test_each_encoding_is_read(tmp_path, encoding):
    profile = load_profile(written(tmp_path, DATABASE + 'CM_ BO_ 416 "Türe";\n', encoding=encoding))
    assert profile.decode(801, False, LOCKED).state is LockState.LOCKED
    assert set(profile.message_names.values()) == {"DOORS", "SPEED"}


WRONG = {
    "line 11.* the identifier 318734247 has more than 11 bits; one of 29 bits is written with 2147483648 added":
        swapped("BO_ 801", "BO_ 318734247"),
    'line 11.* cannot be used: the line is not complete: "BO_ 801 DOORS: Bo': swapped("DOORS: 8 Body", "DOORS: Body"),
    r'line 12.* cannot be used: the line is not complete: "SG_ LOCK : 0\|2': swapped("0|2@1+", "0|2"),
    "line 12.* cannot be used: it has no bit": swapped("0|2@1+", "0|0@1+") + "@\n",
    "line 12.* cannot be used: it ends at bit 65, and the message has 64 bits": swapped("0|2@1+", "63|2@1+"),
    "line 12.* cannot be used: it is a page of a multiplexer that the message does": swapped("LOCK :", "LOCK m1 :"),
    "line 15.* cannot be used: it is there more than once, in lines 11, 15":
        DATABASE.replace(SPEED, DOORS.replace("0|2", "2|2")),
    "line 13.* cannot be used: it is there more than once, in lines 12, 13":
        swapped(" SG_ COUNT : 8|8", " SG_ LOCK : 8|8"),
    "line 12.* cannot be used: it begins before the first bit": swapped("0|2@1+", "-1|2@1+"),
    "line 12.* cannot be used: it begins before the first bit of": swapped("0|2@1+", "-2|2@0+"),
    "line 12.* cannot be used: its scale or offset is not a finite": swapped("0|2@1+ (1,0)", f"0|2@1+ ({400 * '1'},0)"),
    "line 12.* cannot be used: its scale or offset is not a finite number":
        swapped("0|2@1+ (1,0)", f"0|2@1+ (1,{400 * '1'})"),
    "line 13.* cannot be used: its multiplexer PAGE cannot be used: it begins": swapped(
        " SG_ LOCK :", ' SG_ PAGE M : -1|2@1+ (1,0) [0|1] "" Tester\n SG_ LOCK m1 :'),
    "line 13.* cannot be used: its multiplexer PAGE cannot be used: it ends at bit 66": swapped(
        " SG_ LOCK :", ' SG_ PAGE M : 64|2@1+ (1,0) [0|1] "" Tester\n SG_ LOCK m1 :'),
    "has no message DOORS": swapped("801 DOORS", "801 DOOR"),
    "has no signal LOCK": swapped("LOCK :", "LOCKS :"),
    "values for locked and unlocked that the signal LOCK of 1 bits cannot carry": swapped("0|2@1+", "0|1@1+"),
}


@pytest.mark.parametrize(("words", "database"), WRONG.items(), ids=[words[:60] for words in WRONG])
def test_what_the_profile_names_is_exact_or_refused_with_its_line(tmp_path, words, database):
    with pytest.raises(ConnectionFailed, match=words) as raised:
        load_profile(written(tmp_path, database))
    assert "\n" not in str(raised.value) and len(str(raised.value)) < 600


@pytest.mark.parametrize("limits", [f"[0|{400 * '1'}]", f"[-{400 * '1'}|255]", "[0|1e999]"])
def test_counter_whose_limits_are_no_finite_numbers_uses_all_of_its_bits(tmp_path, limits):
    profile = load_profile(written(tmp_path, swapped("(1,0) [0|255]", f"(1,0) {limits}"),
                                   PROFILE + "alive_signal: COUNT\n"))
    assert (profile.counts("COUNT").low, profile.counts("COUNT").high) == (0, 255)


def test_database_without_a_usable_message_is_refused_by_the_line_of_the_one_that_is_named(tmp_path):
    with pytest.raises(ConnectionFailed, match=", line 11, cannot be used: the identifier 318734247 has more than 11"):
        load_profile(written(tmp_path, HEAD + DOORS.replace("801", "318734247")))


def test_name_with_a_digit_first_is_found_by_either_spelling(tmp_path):
    for name in ("0_LOCK", "_0_LOCK"):
        path = written(tmp_path, DATABASE.replace("LOCK", "0_LOCK"), PROFILE.replace("LOCK", name))
        assert load_profile(path).decode(801, False, UNLOCKED).state is LockState.UNLOCKED


def test_lines_are_read_as_the_library_reads_them(tmp_path):
    for path in sorted(PROFILE_FOLDER.glob("*.dbc")):
        whole, broken = load_database(path), tmp_path / path.name
        broken.write_text(path.read_text(encoding="cp1252") + "\n@ no DBC\n", encoding="cp1252")
        facts = [[(each.name, each.frame_id, each.is_extended_frame, each.length, each.cycle_time, [
            (signal.name, signal.start, signal.length, signal.byte_order, signal.is_signed, signal.scale, signal.offset,
             signal.unit, signal.multiplexer_ids, signal.multiplexer_signal, signal.is_multiplexer)
            for signal in each.signals]) for each in database.messages] for database in (whole, load_database(broken))]
        assert facts[0] == facts[1] and facts[0]


def all_messages():
    """Of the shipped databases, and one with pages, signs and both orders of bytes."""
    text = HEAD + """BO_ 2566848513 PAGED: 8 Body
 SG_ PAGE M : 7|3@0+ (1,0) [0|7] "" Tester
 SG_ A m1 : 4|13@0- (1,0) [0|1] "" Tester
 SG_ B m2 : 9|11@1- (1,0) [0|1] "" Tester
 SG_ ALWAYS : 32|16@1+ (1,0) [0|1] "" Tester
 SG_ FLOAT : 63|16@0- (1,0) [0|1] "" Tester
SIG_VALTYPE_ 2566848513 FLOAT : 0;
BO_ 7 REAL: 8 Body
 SG_ F : 7|32@0- (1,0) [0|1] "" Tester
 SG_ G : 32|32@1- (1,0) [0|1] "" Tester
SIG_VALTYPE_ 7 F : 1;
SIG_VALTYPE_ 7 G : 1;
"""
    texts = [text, *(path.read_text(encoding="cp1252") for path in sorted(PROFILE_FOLDER.glob("*.dbc")))]
    return [message for each in texts for message in cantools.database.load_string(each, "dbc", strict=False).messages]


@pytest.mark.parametrize("message", all_messages(), ids=lambda message: message.name)
def test_values_are_those_of_the_library(message):
    chance = random.Random(1)
    names = [signal.name for signal in message.signals]
    pages = {each for signal in message.signals for each in signal.multiplexer_ids or ()}
    for _ in range(200):
        data = chance.randbytes(message.length)
        try:
            expected = message.decode(data, decode_choices=False, scaling=False)
        except cantools.database.DecodeError:
            assert pages
            continue
        found = SignalReader(message, names).values(data)
        assert repr(sorted(found.items())) == repr(sorted(expected.items()))
        if not pages and not any(map(math.isnan, found.values())):
            again = encode(message, found)
            assert again == bytes(message.encode(found, scaling=False, strict=False))


@pytest.mark.parametrize(("sign", "order", "states"), [
    ("-", "0|1@1", "{0: locked, 1: unlocked}"), ("-", "0|1@1", "{1: locked, 0: unlocked}"),
    ("-", "7|1@0", "{0: locked, -1: unlocked}"), ("-", "0|2@1", "{3: locked, 1: unlocked}"),
    ("-", "0|8@1", "{255: locked, 127: unlocked, 128: unknown}"), ("+", "0|8@1", "{255: locked, 0: unlocked}")])
def test_signed_states_are_known_by_either_value(tmp_path, sign, order, states):
    path = written(tmp_path, swapped("0|2@1+", order + sign), PROFILE.replace("{1: locked, 2: unlocked}", states))
    assert spoken_states(load_profile(path)) == [LockState.LOCKED, LockState.UNLOCKED, LockState.LOCKED]


def test_value_that_a_simulated_car_cannot_send_is_a_sentence(tmp_path, capsys):
    path = written(tmp_path, profile=PROFILE + "key_number: {signal: COUNT, under_test: 300}\n")
    assert main(["try", path]) == 2
    assert "Signal COUNT of message DOORS cannot carry the value 300." in capsys.readouterr().err


def test_one_value_with_two_meanings_is_refused(tmp_path):
    states = PROFILE.replace("{1: locked, 2: unlocked}", "{1: locked, -1: unlocked, 0: unlocked}")
    with pytest.raises(ConnectionFailed, match="same bits, with two meanings"):
        load_profile(written(tmp_path, swapped("0|2@1+", "0|1@1-"), states))


TWO_MULTIPLEXERS = HEAD + """BO_ 801 DOORS: 8 Body
 SG_ MUX_A M : 0|4@1+ (1,0) [0|0] "" Tester
 SG_ MUX_B M : 4|4@1+ (1,0) [0|0] "" Tester
 SG_ LOCK m3 : 8|2@1+ (1,0) [0|0] "" Tester
 SG_ B1 m1 : 16|8@1+ (1,0) [0|0] "" Tester
 SG_ B2 m2 : 16|8@1+ (1,0) [0|0] "" Tester
SG_MUL_VAL_ 801 LOCK MUX_A 3-4;
SG_MUL_VAL_ 801 B1 MUX_B 1-1;
SG_MUL_VAL_ 801 B2 MUX_B 2-2;
"""


@pytest.mark.parametrize("end", ["", "@\n"], ids=["library", "lines"])
def test_other_multiplexers_have_an_allowed_value(tmp_path, end):
    profile = load_profile(written(tmp_path, TWO_MULTIPLEXERS + end))
    assert spoken_states(profile) == [LockState.LOCKED, LockState.UNLOCKED, LockState.LOCKED]
    (_, message), = SpokenFrames(profile).next()
    assert (message.data[0] & 15, message.data[0] >> 4) == (3, 1)
    assert profile.decode(801, False, b"\x14\x02").state is LockState.UNLOCKED
    assert profile.decode(801, False, b"\x15\x02") is None and profile.decode(801, False, b"\x14") is None


@pytest.mark.parametrize("database", [HARMLESS["overlap with the lock"], TWO_MULTIPLEXERS],
                         ids=["overlap", "two multiplexers"])
def test_try_understands_each_change(tmp_path, database):
    tried = try_profile(written(tmp_path, database))
    assert tried.is_good, tried


@pytest.mark.parametrize(("text", "reason"), [
    # Cut off within a word, a signal, or the line of the message itself, as an interrupted copy leaves it.
    ((HEAD + SPEED + DOORS)[:len(HEAD + SPEED) + 2], r"; not all of it could be read: .*line 14, column 1: .*"),
    ((HEAD + SPEED + DOORS)[:len(HEAD + SPEED) - 12], r"; not all of it could be read: .*line 12, column 37: .*"),
    ((HEAD + SPEED + DOORS)[:len(HEAD + SPEED) + 11],
     r"; message DOO, line 14, could not be read: the line is not complete: .*"),
    # Another message is refused by the library.
    (HEAD + SPEED.replace("416", "4160") + DOORS.replace("DOORS", "OTHER"),
     r"; not all of it could be read: .* in message SPEED.*"),
    (HEAD + SPEED, ""), (HEAD, "")])
def test_database_without_the_message_says_what_of_it_could_not_be_read(tmp_path, text, reason):
    with pytest.raises(ConnectionFailed, match=rf"has no message DOORS{reason}\.$") as raised:
        load_profile(written(tmp_path, text))
    assert "\n" not in str(raised.value) and len(str(raised.value)) < 600
    assert ("could" in str(raised.value)) is bool(reason)


def test_database_that_was_cut_off_before_the_signal_says_so(tmp_path):
    with pytest.raises(ConnectionFailed, match=r"has no signal LOCK; not all of it could be read: .*line 12"):
        load_profile(written(tmp_path, (HEAD + DOORS)[:len(HEAD) + 24]))
