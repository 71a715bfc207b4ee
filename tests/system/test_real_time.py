"""A short form of `make bench-real-time`: no node of the robot is silent on the machine's clock while others compute.

The robot maps the Car, whose fit is its longest work, drives and is stopped, beside four processes that want all
processors and one that writes to the disk. The whole test suite may run meanwhile; what a robot of its own computer
must keep is judged by the benchmark.
"""
# SPDX-License-Identifier: Apache-2.0
import json
import subprocess
import sys
from typing import Any, Dict

from mtr_benchmarks.real_time.arrivals import VOICES
from mtr_benchmarks.real_time.judge import BUSY_SILENCE_S, STOP, Machine

# Start, map, a short drive and three stops take two minutes on a machine with so much else to do.
LIMIT_S = 400.0


def short_form(out, *options: str) -> Dict[str, Any]:
    """Figures of the benchmark, and what it printed."""
    done = subprocess.run([sys.executable, "-m", "mtr_benchmarks.real_time", "--short", *options, "--out", str(out)],
                          text=True, capture_output=True, timeout=LIMIT_S, check=False)
    path = out / "real_time.json"
    assert path.exists(), done.stdout + done.stderr
    return {**json.loads(path.read_text(encoding="utf-8")), "printed": done.stdout}


def test_all_nodes_speak_on_while_the_machine_is_busy(out):
    found = short_form(out, "--machines", Machine.BUSY.value, "--restarts")
    silences = found["silences"][Machine.BUSY.value]
    assert set(VOICES) < set(silences)
    # After so much silence the state machine calls a node dead.
    late = {node: silences[node]["longest_s"] for node in VOICES if silences[node]["longest_s"] >= BUSY_SILENCE_S}
    assert not late, found["printed"]
    assert found["stop_s"][Machine.BUSY.value]["max"] <= STOP[Machine.BUSY].must, found["printed"]


def test_car_and_map_outlive_the_nodes_that_made_them(out):
    found = short_form(out, "--machines", "--restarts", "car_locator", "localization")
    made = {each["node"]: each for each in found["restarts"]}
    assert set(made) == {"car_locator", "localization"}, found["printed"]
    for each in made.values():
        assert each["stood_s"] is not None and each["recovered_s"] is not None, found["printed"]
        assert not each["mapped_again"], found["printed"]
