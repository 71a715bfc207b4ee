"""A short form of `make fuzz`: each border in a process of its own. C3, C5, C6"""
# SPDX-License-Identifier: Apache-2.0
import json
import pathlib
import subprocess
import sys

import pytest

HERE = pathlib.Path(__file__).resolve().parent
BORDERS = sorted(path.stem for path in (HERE / "borders").glob("[a-z]*.py"))


@pytest.mark.parametrize("border", BORDERS)
def test_no_spoilt_bytes_crash_hang_or_are_taken_for_something(tmp_path, border):
    done = subprocess.run([sys.executable, str(HERE / "run.py"), border, "--share", "0.02", "--out", str(tmp_path)],
                          text=True, capture_output=True, check=False)
    assert done.returncode == 0, done.stdout + done.stderr
    found = json.loads((tmp_path / "fuzz.json").read_text(encoding="utf-8"))
    assert found[border]["cases"] >= 20 and len(found["table"]) == 4
