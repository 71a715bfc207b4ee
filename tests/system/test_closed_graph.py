"""A port scan of the running robot: nothing of it listens outside loopback, and what opens its graph stops it."""
# SPDX-License-Identifier: Apache-2.0
import pathlib
import signal
import socket
import subprocess
import sys
import time

import pytest

from mtr_core import names
from mtr_core.lockstep.start import CANNOT_START
from mtr_graph_watch.environment import closed_environment
from mtr_graph_watch.listening_sockets import is_loopback
from mtr_graph_watch.look import listening, owners_of
from mtr_simulation.stack import Stack, StackOptions

PROC = pathlib.Path("/proc")
PROGRAM = pathlib.Path(__file__).resolve().parents[2] / "catkin_ws/src/mtr_graph_watch/scripts/graph_watch"
VARIABLES = {name: value for name, value in closed_environment({}).items() if name != "ROS_MASTER_URI"}
# A look takes place every 3 s; the rest is a machine with much else to do.
LIMIT_S = 60.0
# As a laptop that joined the graph: a node that listens on every address.
OPEN_NODE = {"ROS_IP": "0.0.0.0", "LD_PRELOAD": ""}
NODE = """
import sys, rospy
from geometry_msgs.msg import Twist
rospy.init_node(sys.argv[1])
rospy.Publisher(sys.argv[2], Twist, queue_size=1)
print("ready", flush=True)
rospy.spin()
"""
# Owners of locks that are engaged, as drive control says them.
LOCKS = """
import rospy
from mtr_msgs.msg import DriveStatus
rospy.init_node("looker", anonymous=True)
while True:
    print(",".join(rospy.wait_for_message("/drive/status", DriveStatus).engaged_locks), flush=True)
"""


@pytest.fixture(scope="module")
def robot(out):
    """The simulated robot, watched, started as setup/robot/start does it."""
    with Stack(StackOptions(out, real_time_factor=1.0, lockstep_operator=False, arguments={"graph_watch": "true"},
                            variables=VARIABLES)) as running:
        yield running


@pytest.fixture
def said(robot):
    """Lines of LOCKS."""
    with subprocess.Popen([sys.executable, "-c", LOCKS], env=robot.environment(), text=True,
                          stdout=subprocess.PIPE) as looker:
        yield looker.stdout
        looker.kill()


def wait_for(lines, condition):
    """Until the owners of engaged locks fulfil it."""
    deadline, line = time.monotonic() + LIMIT_S, ""
    while time.monotonic() < deadline:
        line = lines.readline()
        if condition(line.strip().split(",")):
            return
    pytest.fail(f"Drive control did not say so within {LIMIT_S:.0f} s; the last owners were: {line}")


def processes_below(parent):
    """The process and all that it started, by their parents."""
    children = {}
    for stat in PROC.glob("[0-9]*/stat"):
        try:
            after_name = stat.read_text(encoding="ascii", errors="replace").rpartition(")")[2].split()
        except OSError:
            continue
        children.setdefault(int(after_name[1]), []).append(int(stat.parent.name))
    found = [parent]
    for process in found:
        found.extend(children.get(process, ()))
    return set(found)


def sockets_of(robot):
    """That listen and belong to the robot's processes."""
    sockets, own = listening(PROC), processes_below(robot.pid)
    owners = owners_of({each.inode for each in sockets}, PROC)
    return [each for each in sockets if own & owners.get(each.inode, frozenset())]


def outer_addresses():
    """This machine's addresses that others can reach; none where it has no network."""
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as probe:
        # No packet is sent; an address of documentation, so that the way out is chosen.
        if probe.connect_ex(("192.0.2.1", 9)):
            return []
        return [address for address in [probe.getsockname()[0]] if not is_loopback(address)]


def test_nothing_of_the_robot_listens_outside_loopback(robot, said):
    # Drive control is free when the watch has looked at all nodes.
    wait_for(said, lambda locks: "graph_watch" not in locks)
    found = sockets_of(robot)
    assert {robot.status_port, robot.command_port} <= {each.port for each in found} and len(found) > 20
    assert [each.place for each in found if not is_loopback(each.address)] == []
    for address in outer_addresses():
        reached = []
        for each in found:
            with socket.socket() as probe:
                if probe.connect_ex((address, each.port)) == 0:
                    reached.append(each.place)
        assert reached == []


def wait_until_logged(robot, words):
    """What a node says stands in the log a moment after its message is out."""
    end_s = time.monotonic() + LIMIT_S
    while words not in robot.log.read_text(encoding="utf-8", errors="replace"):
        assert time.monotonic() < end_s, f"{words!r} is not in {robot.log}"


@pytest.mark.parametrize("topic, variables, owner", [
    ("/chatter", OPEN_NODE, "graph_watch"), (names.WHEEL_COMMAND, {}, "drive_control")], ids=["graph", "wheels"])
def test_wheels_are_locked_while_somebody_opens_the_graph_or_commands_them(robot, said, topic, variables, owner):
    with subprocess.Popen([sys.executable, "-c", NODE, "laptop", topic], env={**robot.environment(), **variables},
                          text=True, stdout=subprocess.PIPE) as intruder:
        assert intruder.stdout.readline() == "ready\n"
        wait_for(said, lambda locks: owner in locks)
        if owner == "graph_watch":
            late = subprocess.run([sys.executable, str(PROGRAM), "__name:=late_watch"], env=robot.environment(),
                                  text=True, capture_output=True, timeout=LIMIT_S, check=False)
            assert late.returncode == CANNOT_START and "cannot start. The ROS graph is open: /laptop" in late.stderr
        intruder.send_signal(signal.SIGINT)
        intruder.wait(LIMIT_S)
    wait_for(said, lambda locks: owner not in locks)
    if owner == "graph_watch":
        wait_until_logged(robot, "The ROS graph is open: /laptop is reachable at")
        wait_until_logged(robot, "The ROS graph is closed again.")
