"""A short form of `make bench-stalls`: nodes of a robot that drives in real time are stopped for a while.

On the machine's clock, and on a simulated one that waits for nobody, as another simulator's does.
"""
# SPDX-License-Identifier: Apache-2.0
import json
import re
import subprocess
import sys

import pytest

from mtr_benchmarks.liveness.clock_steps import ALARMS

# Start and four stops take 25 s on a machine of their own, two steps of the clock 6 s more.
LIMIT_S = 180.0
NODES = ("drive_control", "base_guard", "localization", "peripherals")


STEPS_S = (0.4, -3600.0)


@pytest.mark.parametrize("clock, nodes, steps_s", [((), NODES, STEPS_S), (("--simulated-clock",), NODES[:1], ())])
def test_stopped_nodes_let_neither_commands_nor_wheels_surge_when_they_go_on(out, clock, nodes, steps_s):
    done = subprocess.run([sys.executable, "-m", "mtr_benchmarks.liveness", "--short", *clock, "--nodes", *nodes,
                           "--steps", *map(str, steps_s), "--out", str(out)], text=True, capture_output=True,
                          timeout=LIMIT_S, check=False)
    assert (out / "liveness.json").exists(), done.stdout + done.stderr
    log = (out / "liveness" / "stack.log").read_text(encoding="utf-8", errors="replace")
    assert not re.search(r"silent for \d{4,}", log), "an age is that of a stamp of another clock"
    found = json.loads((out / "liveness.json").read_text(encoding="utf-8"))
    stops = found["stalls"]
    assert [stop["node"] for stop in stops] == list(nodes)
    assert all(abs(stop["speed_mps"]) > 0.25 for stop in stops), "the robot was not under way"
    assert [step["counted"] for step in found["clock_steps"]] == [1] * len(steps_s), "the clock was not set"
    # A machine with much else to do has alarms whatever its clock does; `make bench-stalls` asks for none.
    rows = [row for row in found["table"] if row["name"] != ALARMS.name]
    assert len(rows) == 4 + 2 * bool(steps_s) and all(row["met"] for row in rows), done.stdout
