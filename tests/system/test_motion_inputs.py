"""Nothing but its own nodes moves the robot: neither a recording that is played on it nor a second publisher."""
# SPDX-License-Identifier: Apache-2.0
import contextlib
import json
import math
import pathlib
import signal
import subprocess
import sys
import time

import pytest
import rosbag

from mtr_benchmarks.harness.operator_link import OperatorLink
from mtr_core import names
from mtr_recording.profiles import ORDERS, RECORDED
from mtr_simulation.stack import Stack, StackOptions

HERE = pathlib.Path(__file__).resolve().parent
RECORD = HERE.parents[1] / "catkin_ws/src/mtr_recording/scripts/record"
LIMIT_S = 60.0
DRIVES_S, PLAYS_S = 4.0, 5.0
# Truth is exact; a base that is told nothing does not move, and the lift holds within a step of its motor.
STILL_M, LIFT_STILL_M, MOVED_M, LIFTED_M = 0.002, 0.002, 0.2, 0.1
# A node that publishes on a topic with its type, or only says that it will: NAME TOPIC TYPE STAMPED
INTRUDER = """
import sys, rospy, roslib.message
name, topic, kind, stamped, speaks = sys.argv[1:]
rospy.init_node(name)
kind = roslib.message.get_message_class(kind)
publisher = rospy.Publisher(topic, kind, queue_size=10)
message = kind()
if speaks == "speaks":
    message.axes, message.buttons = [0.5, 1.0, 0, 0, 0, 0, 0, 1.0], [0, 0, 0, 0, 0, 1] + [0] * 6
print("ready", flush=True)
while not rospy.is_shutdown():
    if speaks == "speaks":
        message.axes[0] = 0.51 if message.axes[0] == 0.5 else 0.5
        message.header.stamp = rospy.Time.now() if stamped == "stamped" else rospy.Time()
        publisher.publish(message)
    rospy.rostime.wallsleep(0.02)
"""


class Probe:
    """The hand and the witness of motion_probe.py."""

    def __init__(self, process):
        self._process = process
        self.seen = {}

    def say(self, word):
        """Have the hand do this from now on."""
        self._process.stdin.write(f"{word}\n")
        self._process.stdin.flush()

    def read(self):
        """The next report."""
        self.seen = json.loads(self._process.stdout.readline())
        return self.seen

    def until(self, condition, what):
        """Read until a report fulfils it."""
        end_s = time.monotonic() + LIMIT_S
        while not condition(self.read()):
            assert time.monotonic() < end_s, f"no {what} within {LIMIT_S:.0f} s: {self.seen}"

    def ways(self, duration_s):
        """How far base and lift moved at most within this time, m."""
        begun, end_s, base_m, lift_m = self.read(), time.monotonic() + duration_s, 0.0, 0.0
        while time.monotonic() < end_s:
            seen = self.read()
            base_m = max(base_m, math.hypot(seen["x"] - begun["x"], seen["y"] - begun["y"]))
            lift_m = max(lift_m, abs(seen["lift"] - begun["lift"]))
        return base_m, lift_m

    def release(self):
        """Release the emergency stop, and wait until nothing locks the robot."""
        self.say("release")
        self.until(lambda seen: seen["joys"] and seen["locks"] == [], "free robot")
        self.say("rest")
        self.ways(1.0)


@pytest.fixture(scope="module")
def robot(out):
    """The simulated robot on the machine's clock, as a robot is, with a manual controller and an Operator."""
    with Stack(StackOptions(out, real_time_factor=1.0, lockstep_operator=False,
                            arguments={"machine_clock": "true", "controller": "true"})) as running:
        operator = OperatorLink(running.status_port, running.command_port)
        try:
            operator.order(max_speed_mps=0.5)
            yield running
        finally:
            operator.close()


@pytest.fixture(scope="module")
def probe(robot):
    """Its emergency stop is released."""
    with subprocess.Popen([sys.executable, str(HERE / "motion_probe.py")], env=robot.environment(), text=True,
                          stdin=subprocess.PIPE, stdout=subprocess.PIPE) as process:
        try:
            found = Probe(process)
            found.release()
            yield found
        finally:
            process.kill()


@pytest.fixture(scope="module")
def bag(robot, probe, out):
    """A recording of a robot that a hand drives in a circle while it lifts the key."""
    program = [sys.executable, str(RECORD), "--profile", "full", "--out", str(out), "--limit", "800"]
    with subprocess.Popen(program, env=robot.environment(), text=True, stdout=subprocess.PIPE) as recording:
        try:
            assert recording.stdout.readline().startswith("Recording")
            probe.say("drive")
            base_m, lift_m = probe.ways(DRIVES_S)
            probe.say("rest")
            probe.ways(1.5)
        finally:
            recording.send_signal(signal.SIGINT)
            recording.communicate(timeout=LIMIT_S)
    # What is played below would move the robot.
    assert base_m > MOVED_M and lift_m > LIFTED_M, (base_m, lift_m, probe.seen)
    return next(out.glob("full_*.bag"))


def test_orders_are_recorded_under_names_on_which_no_node_listens(bag):
    with rosbag.Bag(str(bag)) as opened:
        recorded = set(opened.get_type_and_topic_info().topics)
    moving = {names.JOY, names.WHEEL_COMMAND, names.MANUAL_VELOCITY, names.PLANNER_VELOCITY, names.MANUAL_LIFT,
              names.FIRMWARE_COMMAND, names.MOTION_LOCK}
    assert {f"{RECORDED}{topic}" for topic in moving} <= recorded and not set(ORDERS) & recorded


@contextlib.contextmanager
def played(robot, bag, remaps):
    """The bag, played again and again."""
    with subprocess.Popen(["rosrun", "rosbag", "play", "--loop", str(bag), *remaps], env=robot.environment(),
                          stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, start_new_session=True) as player:
        try:
            yield
        finally:
            player.send_signal(signal.SIGINT)
            player.wait(LIMIT_S)


# The base itself acts on a velocity at once, whoever sends it: therefore no bag has its topic.
REMAPS = [f"{RECORDED}{topic}:={topic}" for topic in ORDERS if topic != names.WHEEL_COMMAND]


@pytest.mark.parametrize("remaps", [[], REMAPS], ids=["as_recorded", "orders_under_their_own_names"])
def test_recording_that_is_played_on_the_robot_moves_nothing(robot, probe, bag, remaps):
    with played(robot, bag, remaps):
        base_m, lift_m = probe.ways(PLAYS_S)
        assert base_m < STILL_M and lift_m < LIFT_STILL_M
        probe.until(lambda seen: "state_machine" in seen["locks"], "lock for the second publisher")
    probe.release()


@contextlib.contextmanager
def intruder(robot, topic, kind, *how):
    """A node called intruder on the topic."""
    with subprocess.Popen([sys.executable, "-c", INTRUDER, "intruder", topic, kind, *how], env=robot.environment(),
                          text=True, stdout=subprocess.PIPE) as process:
        try:
            assert process.stdout.readline() == "ready\n"
            yield
        finally:
            process.send_signal(signal.SIGINT)
            process.wait(LIMIT_S)


@pytest.mark.parametrize("stamps", ["stamped", "unstamped"])
def test_second_driver_of_the_controller_moves_nothing_and_locks(robot, probe, stamps):
    with intruder(robot, names.JOY, "sensor_msgs/Joy", stamps, "speaks"):
        base_m, lift_m = probe.ways(3.0)
        assert base_m < STILL_M and lift_m < LIFT_STILL_M
        probe.until(lambda seen: {"controller_input", "state_machine"} <= set(seen["locks"]), "lock")
        assert "/intruder" in probe.seen["message"] and names.JOY in probe.seen["message"]
    probe.release()


# Only a person's calibrate_lift publishes there: the first publisher is no second one.
WATCHED = sorted({*names.MOTION_INPUTS, *names.MOTION_STATES} - {names.FIRMWARE_CALIBRATE})


@pytest.mark.parametrize("topic", WATCHED)
def test_second_publisher_on_any_topic_that_moves_the_robot_locks_it(robot, probe, topic):
    with intruder(robot, topic, "std_msgs/Header", "unstamped", "silent"):
        probe.until(lambda seen: seen["locks"], "lock")
    probe.release()
