"""A short form of `make bench-real-time`: no node of the robot is silent on the machine's clock while others compute.

The robot maps the Car, whose fit is its longest work, drives and is stopped, beside four processes that want all
processors and one that writes to the disk. The whole test suite may run meanwhile; what a robot of its own computer
must keep is judged by the benchmark.
"""
# SPDX-License-Identifier: Apache-2.0
import json
import subprocess
import sys

from mtr_benchmarks.real_time.arrivals import VOICES
from mtr_benchmarks.real_time.judge import SILENCE, STOP, Machine

# Start, map, a short drive and three stops take two minutes on a machine with so much else to do.
LIMIT_S = 400.0


def test_all_nodes_speak_on_while_the_machine_is_busy(out):
    done = subprocess.run([sys.executable, "-m", "mtr_benchmarks.real_time", "--short", "--machines",
                           Machine.BUSY.value, "--restarts", "--out", str(out)], text=True, capture_output=True,
                          timeout=LIMIT_S, check=False)
    path = out / "real_time.json"
    assert path.exists(), done.stdout + done.stderr
    found = json.loads(path.read_text(encoding="utf-8"))
    silences = found["silences"][Machine.BUSY.value]
    assert set(VOICES) < set(silences)
    # After so much silence the state machine calls a node dead.
    late = {node: silences[node]["longest_s"] for node in VOICES
            if silences[node]["longest_s"] >= SILENCE[Machine.BUSY].must}
    assert not late, done.stdout
    assert found["stop_s"][Machine.BUSY.value]["max"] <= STOP[Machine.BUSY].must, done.stdout
