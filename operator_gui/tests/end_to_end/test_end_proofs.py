"""The long proofs, short: kills at random instants, results and campaigns (C1, C2, N2, N3, N5)."""
# SPDX-License-Identifier: Apache-2.0
import json
import os
import pathlib
import subprocess
import sys

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
    # Whole robots take a minute each; tests/system/test_cores.py has them.
    command = [sys.executable, PROOFS / "campaigns.py", "--runs", "8", "--pairs", "0", "--cores", "0", "--short",
               "--out", tmp_path]
    done = subprocess.run(command, capture_output=True, text=True, check=False,
                          env={**os.environ, "PYTHONPATH": os.pathsep.join(sys.path)})
    assert done.returncode == 0, done.stdout + done.stderr
    rows = json.loads((tmp_path / "campaign.json").read_text(encoding="utf-8"))["table"]
    assert len([row for row in rows if row["must"] == 0]) == 4
    assert {"radio: 1 workers", "radio: 4 workers"} <= {row["name"] for row in rows}


def test_kills_at_random_instants_lose_nothing(tmp_path):
    done = subprocess.run([sys.executable, PROOFS / "kills.py", "--kills", "8", "--out", tmp_path], capture_output=True,
                          text=True, env={**os.environ, "PYTHONPATH": os.pathsep.join(sys.path)}, check=False)
    assert done.returncode == 0, done.stdout + done.stderr
    rows = json.loads((tmp_path / "kills.json").read_text(encoding="utf-8"))["table"]
    assert rows and all(row["value"] == 0 for row in rows)
