"""A short form of `make bench-faults`: cells of the matrix of states and faults, on the robot in lock-step."""
# SPDX-License-Identifier: Apache-2.0
import json
import os
import subprocess
import sys

# A start and some cells take 40 s on a machine of their own.
LIMIT_S = 400.0


def test_robot_does_what_the_matrix_says_of_each_fault(out):
    done = subprocess.run([sys.executable, "-m", "mtr_benchmarks.faults", "--short", "--out", str(out)], text=True,
                          capture_output=True, timeout=LIMIT_S, check=False)
    assert done.returncode == 0, done.stdout + done.stderr
    found = json.loads((out / "faults.json").read_text(encoding="utf-8"))
    assert found["cells"] and not any(cell["wrong"] for cell in found["cells"])


def test_fault_where_no_robot_was_started_for_it_is_refused_in_a_sentence():
    nowhere = dict(os.environ, ROS_MASTER_URI="http://127.0.0.1:1")
    asked = subprocess.run(["rosrun", "mtr_fault_injection", "inject", "imu", "off"], env=nowhere, text=True,
                           capture_output=True, check=False)
    assert asked.returncode == 2 and "fault_injection:=true" in asked.stderr
