"""Sentences about CAN databases that the library refuses, and silence of the library itself."""
# SPDX-License-Identifier: Apache-2.0
import subprocess
import sys

import pytest

from mtr_operator.car_link.profile import load_profile
from mtr_operator.domain.errors import ConnectionFailed

PROFILE = "database: {}\nmessage: DOORS\nsignal: LOCK\nstates: {{1: locked, 2: unlocked}}\ncycle_time_s: 0.1\n"
KCD = ('<NetworkDefinition xmlns="http://kayak.2codeornot2code.org/1.0"><Document name="x"/><Bus name="b">{}</Bus>'
       "</NetworkDefinition>")
KCD_DOORS = '<Message id="0x321" name="DOORS" length="8"><Signal name="LOCK" offset="0" length="2"/></Message>'
SYM = """FormatVersion=6.0 // Do not edit this line!
Title="x"

{SIGNALS}
Sig=LOCK unsigned 2

{SENDRECEIVE}

[DOORS]
ID=321h
Len=8
Sig=LOCK 0
"""
ARXML = '<AUTOSAR xmlns="http://autosar.org/schema/r4.0">{}</AUTOSAR>'
HOSTILE = "A&#10;all is well&#x9b;31m" + 50_000 * "y"


def written(folder, text, suffix):
    """Path of a profile with its database."""
    (folder / f"car{suffix}").write_text(text)
    path = folder / "car.yaml"
    path.write_text(PROFILE.format(f"car{suffix}"))
    return str(path)


def refusal(folder, text, suffix):
    """The sentence with which a profile with this database is refused."""
    with pytest.raises(ConnectionFailed) as raised:
        load_profile(written(folder, text, suffix))
    sentence = str(raised.value)
    assert sentence.isprintable() and len(sentence) < 600 + len(str(folder))
    return sentence


NAMES_TWICE = {
    ".kcd": KCD.format(KCD_DOORS + 2 * f'<Message id="0x400" name="{HOSTILE}" length="8"/>'),
    ".sym": SYM + 2 * f'\n["{5_000 * "z"}"]\nID=400h\nLen=8\n',
    ".dbc": 'BU_: A\nBO_ 801 DOORS: 8 A\n SG_ LOCK : 0|2@1+ (1,0) [0|3] "" A\n' + 2 * f"BO_ 5 {5_000 * 'z'}: 8 A\n"}


@pytest.mark.parametrize(("suffix", "root"), [
    (".kcd", ""), (".kcd", "import logging; logging.basicConfig(); "), (".sym", ""), (".dbc", "")])
def test_library_prints_nothing_of_a_stranger(tmp_path, suffix, root):
    code = root + "import sys; from mtr_operator.car_link.profile import load_profile; load_profile(sys.argv[1])"
    found = subprocess.run([sys.executable, "-c", code, written(tmp_path, NAMES_TWICE[suffix], suffix)],
                           capture_output=True, text=True, check=False)
    assert (found.returncode, found.stdout, found.stderr) == (0, "", "")


@pytest.mark.parametrize(("suffix", "text", "words"), [
    (".sym", SYM.replace("Sig=LOCK unsigned", "Sig=LOCKS unsigned"),
     'line 9, cannot be used: the signal LOCK has no definition.'),
    (".sym", SYM.replace("Sig=LOCK unsigned", "Sig=LOCKS unsigned").replace("Sig=LOCK 0", 'Sig="L\tK\x01" 0'),
     'cannot be used: the signal L K? has no definition.'),
    (".sym", SYM.replace("Len=8", "Len=8\nMux=A 8,8 1h") + "\n[DOORS]\nLen=8\nSig=LOCK 0\n",
     'cannot be used: a message is multiplexed, and a part of it has no line Mux.'),
    (".sym", SYM.replace("Len=8", "Len=-8"), "cannot be used: its length is negative."),
    (".kcd", KCD.format(KCD_DOORS.replace('length="8"', 'length="-8"')), "cannot be used: its length is negative."),
    (".kcd", KCD.format(KCD_DOORS.replace('"0x321"', '"-5"')), "cannot be used: its identifier is negative."),
    (".kcd", KCD.format(KCD_DOORS.replace("/></M", "><LabelSet><Label name='a'/></LabelSet></Signal></M")),
     'Message DOORS of CAN database {folder}/car.kcd cannot be used: value is missing.'),
    (".arxml", ARXML.format(3000 * "<AR-PACKAGES><AR-PACKAGE>" + 3000 * "</AR-PACKAGE></AR-PACKAGES>"),
     'ARXML: "it is nested too deeply".')],
    ids=["no definition", "no definition of a hostile name", "no Mux", "SYM length", "KCD length", "KCD identifier",
         "missing attribute", "nested"])
def test_fault_is_stated_in_words(tmp_path, suffix, text, words):
    assert words.format(folder=tmp_path) in refusal(tmp_path, text, suffix)
