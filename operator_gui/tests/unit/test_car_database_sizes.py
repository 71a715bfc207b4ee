"""Databases that say of a signal or message that it is larger than any. C6"""
# SPDX-License-Identifier: Apache-2.0
import resource

import pytest
from database_kinds import Frame, dbc, kcd, sym, written

from mtr_operator.car_link.database.load import load_database
from mtr_operator.car_link.further.sizes import MAX_SIZE, too_large
from mtr_operator.car_link.profile import PROFILE_FOLDER, load_profile
from mtr_operator.domain.errors import ConnectionFailed

HUGE = 4_294_967_296
MAX_GROWTH_KIB = 100 * 1024
DBC = (PROFILE_FOLDER / "mtr_honest_car.dbc").read_text(encoding="latin-1")


@pytest.mark.parametrize(("good", "bad"), [
    (" : 8|8@1+", f" : {HUGE}|8@1+"), (" : 8|8@1+", f" : 8|{HUGE}@1+"), (" : 8|8@1+", " : 8 | " + "9" * 3000 + " @1+"),
    ("LockStatus: 4 ", f"LockStatus: {HUGE} ")])
def test_database_with_a_huge_size_is_a_sentence_and_takes_no_memory(tmp_path, good, bad):
    assert good in DBC
    (tmp_path / "mtr_honest_car.dbc").write_text(DBC.replace(good, bad), encoding="latin-1")
    profile = tmp_path / "car.yaml"
    profile.write_bytes((PROFILE_FOLDER / "mtr_honest_car.yaml").read_bytes())
    before = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    with pytest.raises(ConnectionFailed, match=r"it says \d{1,20} where a place or .* allowed is up to 32760: .*\.$"):
        load_profile(str(profile))
    assert resource.getrusage(resource.RUSAGE_SELF).ru_maxrss - before < MAX_GROWTH_KIB


@pytest.mark.parametrize(("suffix", "text"), [
    (".DBC", "SG_ A : 0|{}@1+"), (".dbc", "BO_ 1 A : {} B"), (".kcd", '<Signal name="a" offset="{}"/>'),
    (".kcd", "<Message length='{}'/>"), (".sym", "Len={}"), (".sym", "Var=A unsigned 0,{}"), (".sym", "Sig=\"A 1\" {}"),
    (".sym", " Mux=A2 {},8 1h"),
    (".arxml", "<START-POSITION>{}</START-POSITION>"), (".arxml", "<LENGTH>0{}</LENGTH>")])
def test_sizes_of_each_kind_are_found_and_usual_ones_left(suffix, text):
    assert too_large(text.format(MAX_SIZE + 1), suffix).endswith(str(MAX_SIZE + 1))
    assert too_large(text.format(MAX_SIZE), suffix) == ""


def test_hexadecimal_size_of_an_arxml_is_read_and_another_kind_left():
    assert too_large("<LENGTH>0x8000</LENGTH>", ".arxml") == "0x8000" and too_large("<LENGTH>0x40<", ".arxml") == ""
    assert too_large("99999|99999@", ".txt") == ""


def test_identifiers_limits_and_texts_of_a_database_are_no_sizes():
    text = "BO_ 2566844926 A: 8 B\n SG_ C : 0|32@1- (1,0) [-2147483648|2147483647] \"\" B\nVAL_ 99999 C 99999 \"D\" ;"
    assert too_large(text, ".dbc") == "" and not any(too_large(path.read_text(encoding="latin-1"), ".dbc")
                                                    for path in PROFILE_FOLDER.glob("*.dbc"))


NAMED, OTHER = Frame("DOORS", 0x321, [("LOCK", 0, 2)]), Frame("SPEED", 0x1A0, [("KMH", 4, 17)])


@pytest.mark.parametrize(("suffix", "text", "old", "new"), [
    (".dbc", dbc([NAMED, OTHER]), "4|17@", f"4|{HUGE}@"), (".dbc", dbc([NAMED, OTHER]), "4|17@", f"{HUGE}|17@"),
    (".dbc", dbc([NAMED, OTHER]), "4|17@", "4\n|\n70000\n@"),
    (".dbc", dbc([NAMED, OTHER]), "SPEED: 8", f"SPEED: {HUGE}"),
    (".kcd", kcd([NAMED, OTHER]), '"17"', f'"{HUGE}"'), (".kcd", kcd([NAMED, OTHER]), 'offset="4"', f'offset="{HUGE}"'),
    (".sym", sym([NAMED, OTHER]), "4,17", f"4,{HUGE}"), (".sym", sym([NAMED, OTHER]), "4,17", f"{HUGE},17"),
    (".sym", sym([OTHER, NAMED]), "4,17", "4," + "9" * 5000), (".kcd", kcd([OTHER, NAMED]), '"17"', f'"{"9" * 5000}"')])
def test_huge_size_of_another_message_costs_nothing_and_takes_no_memory(tmp_path, suffix, text, old, new):
    assert text.count(old) == 1
    before = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    assert load_profile(written(tmp_path, suffix, text.replace(old, new))).decode(0x321, False, b"\x01" + bytes(7))
    database = load_database(tmp_path / f"car{suffix}")
    with pytest.raises(ConnectionFailed, match=r"SPEED.* cannot be used: it says \d{1,20} where a place or a size of"):
        database.signal(database.message("SPEED"), "KMH")
    assert resource.getrusage(resource.RUSAGE_SELF).ru_maxrss - before < MAX_GROWTH_KIB


@pytest.mark.parametrize("comment", ['CM_ BO_ 416 "was 0|70000@1+ before";', 'CM_ "as\nBO_ 5 X: 99999 A\nwas";',
                                     "// SG_ X : 0|70000@1+"])
@pytest.mark.parametrize("fault", ["", "@ no DBC\n"])
def test_size_in_a_comment_is_no_size(tmp_path, comment, fault):
    text = f"{dbc([NAMED, OTHER])}{comment}\n{fault}"
    assert load_profile(written(tmp_path, ".dbc", text)).decode(0x321, False, b"\x01" + bytes(7))


def test_quotation_mark_in_a_comment_hides_no_size(tmp_path):
    text = dbc([NAMED]) + f'CM_ "as\nwas"; BO_ 5 X: {HUGE} A\n// "\n'
    before = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    assert load_profile(written(tmp_path, ".dbc", text)).decode(0x321, False, b"\x01" + bytes(7))
    assert resource.getrusage(resource.RUSAGE_SELF).ru_maxrss - before < MAX_GROWTH_KIB
