"""The robot in one process: its parameters are those of sim.launch, and it does without ROS what lock-step asks for."""
# SPDX-License-Identifier: Apache-2.0
import dataclasses
import math
import pathlib
import subprocess
import sys

import pytest
import roslaunch

from mtr_core.conversions import stamp_of
from mtr_core.parameters import parameters_from
from mtr_core.schedule import MILLISECOND_NS, SIMULATION_START_NS
from mtr_dispatcher.parameters import Parameters as DispatcherParameters
from mtr_msgs.msg import RobotMode
from mtr_proto import robot_link_pb2 as link
from mtr_simulation.car.can_port import MemoryCanPort
from mtr_simulation.cores import wire
from mtr_simulation.cores.parameters import simulated_robot
from mtr_simulation.cores.robot import CoresOptions, CoresRobot
from mtr_simulation.cores.topics import Topic
from mtr_simulation.sensors.readings import WheelOdometry

LAUNCH = pathlib.Path(__file__).resolve().parents[5] / "launch" / "launch" / "sim.launch"
# What a process alone has: the link's ports, and files for a node that is started anew.
OF_NODES = ("status_port", "command_port", "memory_folder")
HERE_NS = 5_000 * MILLISECOND_NS


@pytest.fixture(scope="module")
def launched():
    """Parameters of the nodes of sim.launch by their full names, as the demo starts them."""
    arguments = ["car_port_link:=/nowhere", "lockstep_operator:=true"]
    config = roslaunch.config.load_config_default([(str(LAUNCH), arguments)], None, verbose=False)
    return {name: parameter.value for name, parameter in config.params.items()}


@pytest.mark.parametrize("node", [field.name for field in dataclasses.fields(simulated_robot())])
def test_parameters_are_those_of_the_launch_file(launched, node):
    ours = getattr(simulated_robot(), node)
    given = under(launched, f"/{node}/")
    theirs = parameters_from({name: value for name, value in given.items() if name not in OF_NODES}, type(ours))
    assert theirs == ours


@pytest.mark.parametrize("node, known", [
    ("drive_control", {"rear_lidar": True, "contact_skirt": False, "base_controller": "/jackal_velocity_controller",
                       "base_guard": False}),
    ("localization", {"pose_source": "own", "publish_odom_tf": True, "rear_lidar": True})])
def test_cores_in_cpp_run_on_their_defaults_in_the_launch_file_too(launched, node, known):
    given = {name: value for name, value in under(launched, f"/{node}/").items() if name not in OF_NODES}
    assert given == known


def under(values, prefix):
    """Parameters under a name."""
    return {name[len(prefix):]: value for name, value in values.items() if name.startswith(prefix)}


def message(time_ns):
    made = RobotMode()
    made.header.stamp = stamp_of(time_ns)
    return made


def test_input_gives_what_is_due_and_not_what_is_newer():
    topic = Topic()
    reader = topic.input()
    assert reader.at(HERE_NS) is None and reader.age_s(HERE_NS) == math.inf
    for later_ms in (-100, -20, 0):
        topic.publish(message(HERE_NS + later_ms * MILLISECOND_NS))
    assert reader.at(HERE_NS).header.stamp.to_nsec() == HERE_NS - 20 * MILLISECOND_NS
    assert reader.age_s(HERE_NS) == pytest.approx(0.02)
    assert topic.input(lag_ns=0).at(HERE_NS).header.stamp.to_nsec() == HERE_NS


def test_input_does_not_give_a_message_that_is_too_old_for_the_present():
    topic = Topic()
    reader = topic.input()
    topic.publish(message(HERE_NS))
    later_ns = HERE_NS + 600 * MILLISECOND_NS
    assert reader.fresh_at(later_ns, 0.7) is not None and reader.fresh_at(later_ns, 0.5) is None


def test_topic_keeps_what_may_still_be_read():
    topic = Topic()
    reader = topic.input()
    for number in range(1000):
        topic.publish(message(HERE_NS + number * 20 * MILLISECOND_NS))
    newest_ns = HERE_NS + 999 * 20 * MILLISECOND_NS
    assert reader.at(newest_ns - 500 * MILLISECOND_NS).header.stamp.to_nsec() == newest_ns - 520 * MILLISECOND_NS


def test_numbers_are_rounded_as_messages_round_them():
    assert wire.single(0.3) == pytest.approx(0.3, abs=1e-7) and wire.single(0.3) != 0.3
    turned = wire.odometry(WheelOdometry(1.0, 2.0, 3.0 * math.pi, 0.4, 0.1))
    assert turned.heading_rad == pytest.approx(math.pi) and turned[:2] == (1.0, 2.0)


def statuses(robot, count):
    """The next Statuses, none of them answered."""
    found = []
    for _ in range(count):
        status = link.Status()
        status.ParseFromString(robot.next_status())
        found.append(status)
    return found


def test_robot_stands_and_says_a_status_each_tenth_of_a_second_while_nobody_answers():
    port = MemoryCanPort()
    robot = CoresRobot(CoresOptions(seed=2, car="honest"), port)
    found = statuses(robot, 40)
    assert [status.id for status in found] == list(range(1, 41))
    assert found[-1].sent_time_s == pytest.approx(SIMULATION_START_NS * 1e-9 + 4.0)
    assert found[-1].state.stamp_s == pytest.approx(found[-1].sent_time_s)
    assert abs(found[-1].state.speed) < 0.01 and not found[-1].state.pose_valid
    assert found[-1].mode == RobotMode.READY_TO_MAP_CAR
    assert port.frames, "the Car's bus is silent"
    robot.close()


def test_same_seed_gives_the_same_to_the_last_bit_and_another_one_something_else():
    def poses(seed):
        robot = CoresRobot(CoresOptions(seed=seed), MemoryCanPort())
        return [status.state.SerializeToString() for status in statuses(robot, 20)]

    assert poses(1) == poses(1) != poses(2)


def test_no_part_of_it_needs_ros():
    code = ("import sys, mtr_simulation.cores.robot\n"
            "print(sorted({'rospy', 'roslib', 'tf2_ros', 'rosgraph'} & set(sys.modules)))")
    done = subprocess.run([sys.executable, "-c", code], stdout=subprocess.PIPE, check=True)
    assert done.stdout.decode().strip() == "[]"


def test_dispatcher_of_the_cores_waits_for_the_application():
    assert simulated_robot().dispatcher == dataclasses.replace(DispatcherParameters(), lockstep_operator=True,
                                                               warn_without_emergency_stop=False, simulated=True)
