"""Statements of a DBC file that end elsewhere than their lines are read as the library reads them, or refused."""
# SPDX-License-Identifier: Apache-2.0
import cantools
import pytest
from database_kinds import written

from mtr_operator.car_link.database.dbc_lines import dbc_messages
from mtr_operator.car_link.database.dbc_messages import built
from mtr_operator.car_link.profile import load_profile
from mtr_operator.domain.errors import ConnectionFailed

SIGNALS = """ SG_ LOCK m1 : 0|32@1- (1,0) [0|3] "km; SG_ A : //" A,B
 SG_ MX M : 32|4@1+ (1,0) [0|0] "" B
 SG_ NX M : 36|4@1+ (1,0) [0|0] "" B
"""
BASE = 'VERSION ""\nNS_ :\n\tCM_\n\tBA_DEF_\n\tSG_MUL_VAL_\n\nBS_:\n\nBU_: A B\n\nBO_ 801 DOORS: 8 A\n' + SIGNALS + (
    'BO_ 416 SPEED: 4 B\n SG_ KMH : 0|16@1+ (0.01,0) [0|655] "km/h" A\n\n'
    'CM_ SG_ 416 KMH "speed";\nSG_MUL_VAL_ 801 LOCK MX 3-4;\nSIG_VALTYPE_ 801 LOCK : 1;\n')
FAULT = "garb age;\n"


def facts(messages):
    """Everything on which the values of signals depend."""
    return [(each.name, each.frame_id, each.length, each.cycle_time, [
        (signal.name, signal.start, signal.length, signal.byte_order, signal.is_signed, signal.is_float, signal.scale,
         signal.offset, signal.minimum, signal.maximum, signal.unit, signal.multiplexer_ids, signal.multiplexer_signal)
        for signal in each.signals]) for each in messages]


@pytest.mark.parametrize(("old", "new"), [
    ("", ""), ("_ 801 LOCK : 1", "_ 801\n LOCK : 1"), ("_ 801 LOCK : 1", "_\n801\nLOCK\n:\n1\n"),
    ("801 LOCK : 1", "801 LOCK:1"),
    ("SIG_VALTYPE_ 801 LOCK", "SIG_VALTYPE_ 801 MX : 0; SIG_VALTYPE_ 801 LOCK"),
    ('"speed";\n', '"speed"; '), ('CM_ SG_ 416 KMH "speed";\nSG_MUL', 'CM_\nSG_ 416 KMH "a\n// b"; SG_MUL'),
    ("_ 801 LOCK MX 3-4;", "_ 801\n LOCK MX 3-4;"), ("MX 3-4;", "MX 1-1,\n 3-4;"), ("MX 3-4;\n", "MX\n3-4\n; "),
    ("_ 801 LOCK MX 3-4;", "_ 801 // SG_MUL_VAL_ 801 LOCK MX 1-1;\n LOCK MX 3-4;"),
    ("801 DOORS: 8 A", "801\n DOORS: 8 A"), ("801 DOORS: 8 A", "801 DOORS\n:\n8\nA"), ("DOORS: 8 A\n", "DOORS: 8 A"),
    ("BO_ 801", "BO_\n801"), ("SG_ LOCK m1 :", "SG_ LOCK\n m1 :"), ("SG_ LOCK m1 :", "SG_\nLOCK m1\n:"),
    ("0|32@1- (1,0) [0|3]", "0\n|\n32@1-\n(1\n,\n0)\n[0\n|\n3]\n"), ("A,B\n", "A,\n B\n"), ("A,B\n", "\nA\n, B "),
    ('" A,B\n SG_ MX', '" A,B SG_ MX'), ("BO_ 416", 'CM_ BO_ 801 "as\nBO_ 5 X: 8 A\nwas";\nBO_ 416'),
    ("[0|0]", "[0|0] // SG_ X : 0|1@1+ (1,0) [0|0] \"\" A\n"), ("\n", "\r\n"), ("A\n\nCM_", "A CM_"),
    ("SPEED: 4 B", "SPEED: 4 B // BO_ 5 X: 8 A"),
    ("SIG_VALTYPE_", 'BA_DEF_ BO_ "GenMsgCycleTime" INT 0 9; BA_DEF_DEF_ "GenMsgCycleTime" 0;\n'
     'BA_ "GenMsgCycleTime"\n BO_ 801\n 50; SIG_VALTYPE_'),
    ("SIG_VALTYPE_", 'CM_ BO_ 801 "SIG_VALTYPE_ 801 MX : 1; SG_MUL_VAL_ 801 LOCK MX 7-7;";\nSIG_VALTYPE_')])
def test_fault_elsewhere_changes_no_value(old, new):
    text = BASE.replace(old, new) if old else BASE
    expected = cantools.database.load_string(text, "dbc", strict=False).messages
    found = built(dbc_messages(text + FAULT))
    assert facts(found) == facts(expected) and found[0].get_signal_by_name("LOCK").is_float


@pytest.mark.parametrize("text", [
    BASE.replace(" : 1;", " : 1") + FAULT, BASE.replace(" : 1;", " : x;"),
    BASE.replace("_ 801 LOCK :", "_ 0x321 LOCK :"),
    BASE.replace("_ 801 LOCK :", "_ LOCK :"), BASE.replace("MX 3-4;", "MX 3;"),
    BASE.replace("MX 3-4;", "MX 3-4; SG_MUL_VAL_ 801 LOCK NX 1-1;") + FAULT,
    # One string of the file has no end, so that the statement may be within a string or not.
    BASE.replace("SIG_VALTYPE_", 'CM_ "a\nb"; SIG_VALTYPE_') + 'CM_ "c;\n',
    BASE.replace("SIG_VALTYPE_ 801", 'CM_ "a\nb"; SIG_VALTYPE_\n801') + 'CM_ "c;\n'],
    ids=["no end", "no type", "identifier", "no identifier", "no range", "two pages", "string", "wrapped string"])
def test_signal_that_a_statement_may_change_is_refused_with_the_line_of_the_statement(tmp_path, text):
    with pytest.raises(ConnectionFailed, match=r"Signal LOCK .* cannot be used: line [12]\d describes it as \"S"):
        load_profile(written(tmp_path, ".dbc", text))


@pytest.mark.parametrize("statement", [
    "B0_ 802 OTHER: 8 A", "BO 802 OTHER: 8 A", "x B0_ 802 OTHER: 8 A", "A, B0_ 802 A: 8"])
@pytest.mark.parametrize("end", ["\n", " "])
def test_signals_behind_a_misspelled_message_belong_to_no_other(statement, end):
    text = BASE.replace("BO_ 416 SPEED: 4 B\n", statement + end)
    assert [[signal.name for signal in message.signals] for message in dbc_messages(text)] == [["LOCK", "MX", "NX"]]
