"""A short form of `make bench-stalls`: nodes of a robot that drives in real time are stopped for a while.

On the machine's clock, and on a simulated one that waits for nobody, as another simulator's does.
"""
# SPDX-License-Identifier: Apache-2.0
import json
import re
import subprocess
import sys

import pytest

# Start and three stops take 20 s on a machine of their own.
LIMIT_S = 180.0
NODES = ("drive_control", "localization", "peripherals")


@pytest.mark.parametrize("clock, nodes", [((), NODES), (("--simulated-clock",), NODES[:1])])
def test_stopped_nodes_let_neither_commands_nor_wheels_surge_when_they_go_on(out, clock, nodes):
    done = subprocess.run([sys.executable, "-m", "mtr_benchmarks.liveness", "--short", *clock, "--nodes", *nodes,
                           "--steps", "--out", str(out)], text=True, capture_output=True, timeout=LIMIT_S, check=False)
    assert done.returncode == 0, done.stdout + done.stderr
    log = (out / "liveness" / "stack.log").read_text(encoding="utf-8", errors="replace")
    assert not re.search(r"silent for \d{4,}", log), "an age is that of a stamp of another clock"
    found = json.loads((out / "liveness.json").read_text(encoding="utf-8"))
    stops = found["stalls"]
    assert [stop["node"] for stop in stops] == list(nodes)
    assert all(abs(stop["speed_mps"]) > 0.25 for stop in stops), "the robot was not under way"
    assert len(found["table"]) == 4 and all(row["met"] for row in found["table"])
