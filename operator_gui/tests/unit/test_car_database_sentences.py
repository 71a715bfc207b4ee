"""Sentences about CAN databases that the library refuses, and silence of the library itself."""
# SPDX-License-Identifier: Apache-2.0
import subprocess
import sys

import pytest

from mtr_operator.car_link.profile import load_profile

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
HOSTILE = "A&#10;all is well&#x9b;31m" + 50_000 * "y"


def written(folder, text, suffix):
    """Path of a profile with its database."""
    (folder / f"car{suffix}").write_text(text)
    path = folder / "car.yaml"
    path.write_text(PROFILE.format(f"car{suffix}"))
    return str(path)


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
