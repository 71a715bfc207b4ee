"""The long proofs, short: kills at random instants, mutated files and Statuses (C1, C2, C3, C5, N2, N3, N5, N6)."""
# SPDX-License-Identifier: Apache-2.0
import json
import os
import pathlib
import subprocess
import sys

import pytest

PROOFS = pathlib.Path(__file__).resolve().parents[1] / "proofs"


SUPPORT = PROOFS.parent / "support"


def test_short_form_of_the_benchmark_of_results_loses_nothing(tmp_path):
    command = [sys.executable, PROOFS / "results.py", "--tests", "6", "--lines", "8", "--short", "--out", tmp_path]
    done = subprocess.run(command, capture_output=True, text=True, check=False,
                          env={**os.environ, "PYTHONPATH": os.pathsep.join([*sys.path, str(SUPPORT)])})
    assert done.returncode == 0, done.stdout + done.stderr
    rows = json.loads((tmp_path / "results.json").read_text(encoding="utf-8"))["table"]
    assert len([row for row in rows if row["must"] == 0]) == 4
    assert {"SQLite: import", "PostgreSQL: import"} <= {row["name"] for row in rows}


def test_short_form_of_the_benchmark_of_campaigns_loses_nothing_when_a_worker_is_killed(tmp_path):
    command = [sys.executable, PROOFS / "campaigns.py", "--runs", "8", "--pairs", "0", "--short", "--out", tmp_path]
    done = subprocess.run(command, capture_output=True, text=True, check=False,
                          env={**os.environ, "PYTHONPATH": os.pathsep.join(sys.path)})
    assert done.returncode == 0, done.stdout + done.stderr
    rows = json.loads((tmp_path / "campaign.json").read_text(encoding="utf-8"))["table"]
    assert len([row for row in rows if row["must"] == 0]) == 4
    assert {"radio: 1 workers", "radio: 4 workers"} <= {row["name"] for row in rows}


@pytest.mark.parametrize(("name", "arguments"), [("kills", ("--kills", "8")),
                                                 ("fuzz", ("--files", "300", "--statuses", "2000"))])
def test_short_form_of_a_proof_finds_nothing(tmp_path, name, arguments):
    done = subprocess.run([sys.executable, PROOFS / f"{name}.py", *arguments, "--out", tmp_path], capture_output=True,
                          text=True, env={**os.environ, "PYTHONPATH": os.pathsep.join(sys.path)}, check=False)
    assert done.returncode == 0, done.stdout + done.stderr
    rows = json.loads((tmp_path / f"{name}.json").read_text(encoding="utf-8"))["table"]
    assert rows and all(row["value"] == 0 for row in rows)
