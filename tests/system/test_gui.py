"""A person clicks through a whole short test against the simulated robot and Car, on an X server of its own."""
# SPDX-License-Identifier: Apache-2.0
import csv
import os
import pathlib
import shutil
import subprocess
import sys

import pytest

from mtr_simulation.demo import THRESHOLD_LIMITS, compare

SESSION = pathlib.Path(__file__).with_name("gui_session.py")
SCREEN = "-screen 0 1440x900x24 -nolisten tcp"


@pytest.fixture(scope="module")
def session(stack, out):
    """Files that a person has left."""
    command = ["xvfb-run", "-a", "-s", SCREEN, sys.executable, str(SESSION), str(stack.status_port),
               str(stack.command_port), str(stack.can_link), str(out)]
    done = subprocess.run(command, text=True, capture_output=True, check=False,
                          env=dict(os.environ, QT_QPA_PLATFORM="xcb"))
    assert done.returncode == 0, done.stderr
    return out


def test_csv_and_png_are_saved(session):
    folder, = (session / "results").iterdir()
    lines = (folder / "results.csv").read_text(encoding="utf-8").splitlines()
    rows = list(csv.DictReader(line for line in lines if not line.startswith("#")))
    assert [row["angle_deg"] for row in rows] == ["0.000", "180.000"]
    assert (folder / "protocol.png").read_bytes().startswith(b"\x89PNG")


def test_results_agree_with_the_truth(session):
    folder, = (session / "results").iterdir()
    shutil.copytree(folder, session / "key_press")
    assert compare(session / "truth_events.csv", session / "key_press", *THRESHOLD_LIMITS) == 0


def test_finished_test_is_not_offered_again(session):
    assert '"unfinished": null' in (session / "settings.json").read_text(encoding="utf-8")
