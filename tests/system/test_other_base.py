"""Another four-wheel base, by URDF and parameters only: it keeps the contract, and what it measures is true."""
# SPDX-License-Identifier: Apache-2.0
import json
import pathlib
import subprocess
import sys

import pytest
from conftest import Application

from mtr_core import names
from mtr_simulation.demo import THRESHOLD_LIMITS, compare, read_rows
from mtr_simulation.stack import Stack, StackOptions

TOP = pathlib.Path(__file__).resolve().parents[2]
BASES = pathlib.Path(__file__).parent / "bases"
PARAMETERS = pathlib.Path(__file__).parent / "parameters"
WIDE = {"robot_file": str(BASES / "wide.urdf.xacro"), "base_file": str(BASES / "wide_base.yaml"),
        "node_parameters": str(BASES / "wide_nodes.yaml")}
# A wrong lever of the key, or a wrong wheel base, would be centimetres; in simulation the place is known to some mm.
LARGEST_ERROR_M = 0.05
LIMIT_S = 60.0
FORGET = "import rospy; rospy.delete_param('/jackal_velocity_controller/linear/x/max_acceleration')"


def contract(robot, path, *options):
    """Exit status and findings of base_contract on a running robot, without those of this computer's load."""
    program = TOP / "catkin_ws/src/mtr_commissioning/scripts/base_contract"
    done = subprocess.run([sys.executable, str(program), "--json", str(path), *options], text=True, check=False,
                          capture_output=True, env=robot.environment(), timeout=LIMIT_S)
    assert path.exists(), done.stdout + done.stderr
    findings = json.loads(path.read_text(encoding="utf-8"))["findings"]
    return [each for each in findings if each["bad"] and each["check"] not in ("topic.rate", "topic.gap", "topic.age")
            ], findings


def test_wide_base_keeps_the_contract_and_what_is_missing_is_named(out):
    with Stack(StackOptions(out / "live", real_time_factor=1.0, lockstep_operator=False, arguments=WIDE)) as robot:
        bad, findings = contract(robot, out / "good.json")
        assert bad == []
        assert {each["subject"] for each in findings} >= {"wheels", "key", names.WHEEL_ODOMETRY, names.WHEEL_COMMAND}
        subprocess.run([sys.executable, "-c", FORGET], env=robot.environment(), check=True)
        bad, _ = contract(robot, out / "without.json", "--seconds", "2")
    assert [each["subject"].rpartition("controller/")[2] for each in bad] == ["linear/x/max_acceleration"]


@pytest.fixture(scope="module")
def measured(out):
    """Folder of a run of Key press with the wide robot."""
    with Stack(StackOptions(out, arguments=WIDE)) as stack:
        done = Application(stack).run("key_press", PARAMETERS / "key_press.yaml", out / "key_press")
        assert done.returncode == 0, done.stderr
    return out / "key_press"


def test_distances_of_the_wide_base_are_true(measured, out):
    assert compare(out / "truth_events.csv", measured, *THRESHOLD_LIMITS) == 0
    truth = {row["line"]: float(row["true_distance_m"]) for row in read_rows(measured / "truth.csv")}
    rows = read_rows(measured / "results.csv")
    assert len(rows) == 3 and all(row["status"] == "ok" for row in rows)
    errors = [abs(float(row["distance_m"]) - truth[row["radial"]]) for row in rows]
    assert max(errors) < LARGEST_ERROR_M, errors
