"""A second robot.launch on the same ROS master leaves the running robot alone, and says why it waits."""
# SPDX-License-Identifier: Apache-2.0
import signal
import subprocess
import time

import pytest

from mtr_benchmarks.harness.operator_link import OperatorLink
from mtr_simulation.stack import Stack, StackOptions, free_port

LIMIT_S = 60.0
NODES = ("drive_control", "localization", "motion_planner", "car_locator", "state_machine", "peripherals", "dispatcher",
         "robot_state_publisher")
# Longer than roslaunch waits before it starts a node again.
STAYS_S = 6.0


@pytest.fixture(scope="module")
def robot(out):
    """The simulated robot on the machine's clock, whose nodes are started again when they end."""
    with Stack(StackOptions(out, real_time_factor=1.0, lockstep_operator=False,
                            arguments={"machine_clock": "true", "respawn": "true"})) as running:
        yield running


def wait_until(condition, what):
    """Until it holds."""
    end_s = time.monotonic() + LIMIT_S
    while not condition():
        assert time.monotonic() < end_s, f"no {what} within {LIMIT_S:.0f} s"
        time.sleep(0.1)


def test_second_start_waits_with_a_sentence_for_terminal_and_operator_and_nothing_is_replaced(robot, out):
    log = out / "second.log"
    operator = OperatorLink(robot.status_port, robot.command_port)
    command = ["roslaunch", "mtr_bringup", "robot.launch", "serial_node:=none", "controller:=false",
               "graph_watch:=false", f"status_port:={free_port()}", f"command_port:={free_port()}"]
    try:
        with log.open("wb") as file, subprocess.Popen(command, env=robot.environment(), stdout=file,
                                                      stderr=subprocess.STDOUT, start_new_session=True) as second:
            try:
                for node in NODES:
                    wait_until(lambda node=node: f"The node /{node} already runs" in log.read_text(errors="replace"),
                               f"sentence about {node}")
                wait_until(lambda: any(each.code == "node_cannot_start" and "started twice" in each.text
                                       for each in operator.status.notifications), "notice for the Operator")
                time.sleep(STAYS_S)
            finally:
                second.send_signal(signal.SIGINT)
                second.wait(LIMIT_S)
        wait_until(lambda: all(each.code != "node_cannot_start" for each in operator.status.notifications),
                   "end of the notice")
    finally:
        operator.close()
    said = robot.log.read_text(encoding="utf-8", errors="replace")
    # None of the running nodes was replaced or started again.
    assert "restarting process" not in said and "new node registered with same name" not in said
