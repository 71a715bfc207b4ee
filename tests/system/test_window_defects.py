"""The defects of the window's table, looked for by mouse and keyboard under a window manager on a small laptop."""
# SPDX-License-Identifier: Apache-2.0
import json
import pathlib

import pytest
from gui_defects import CHECKS
from gui_desk import on_a_desk

SESSION = pathlib.Path(__file__).with_name("gui_defects.py")
NUMBERS = sorted({number for numbers, _ in CHECKS for number in numbers.split()})


@pytest.fixture(scope="module")
def found(out):
    """What a person has found, by defect."""
    done = on_a_desk(SESSION, out)
    assert done.returncode == 0, done.stderr
    return json.loads((out / "defects.json").read_text(encoding="utf-8"))


@pytest.mark.parametrize("number", NUMBERS)
def test_defect_is_mended(found, number):
    assert not found[number], found[number]
