"""Start of the robot on a ROS master that survived the previous start (MTR_MASTER=wait): old parameters have no
effect."""
# SPDX-License-Identifier: Apache-2.0
import pathlib
from xml.etree import ElementTree

import pytest
import roslaunch

from mtr_car_locator import node

LAUNCH = pathlib.Path(__file__).resolve().parents[2] / "launch"
WITH_ITS_NODES = ("jackal", "lidar_driver", "sim", "replay", "robot/nodes", "robot/motion", "robot/car",
                  "robot/peripherals", "robot/operator")
ONE_LIDAR = ["lidar:=hokuyo_utm30lx", "rear_lidar:=false"]
FOUND_OUT = {"/preflight_report/bad": 0, "/preflight_motion/bad": 0, "/start_failures/localization": "Because."}


class Master:
    """Parameters of a ROS master, onto which robot.launch is loaded as by roslaunch."""

    def __init__(self):
        self.parameters = {}

    def start(self, *arguments):
        config = roslaunch.config.load_config_default([(str(LAUNCH / "robot.launch"), list(arguments))], None)
        cleared = tuple(config.clear_params)
        self.parameters = {name: value for name, value in self.parameters.items() if not name.startswith(cleared)}
        self.parameters.update({name: parameter.value for name, parameter in config.params.items()})


@pytest.fixture
def master():
    return Master()


def test_start_has_the_parameters_of_its_own_arguments_only(master, tmp_path):
    own = tmp_path / "nodes.yaml"
    own.write_text("drive_control: {e_stop_topics: [/e_stop]}\n", encoding="utf-8")
    master.start(*ONE_LIDAR, f"node_parameters:={own}")
    assert master.parameters["/drive_control/e_stop_topics"] == ["/e_stop"]
    master.start()
    anew = Master()
    anew.start()
    assert set(master.parameters) == set(anew.parameters)
    # Lift and servos would wait forever for the emergency stop's message.
    assert master.parameters["/peripherals/emergency_owners"] == ["controller_input", "service_mode"]
    master.start("controller:=false")
    assert master.parameters["/peripherals/emergency_owners"] == ["service_mode"]
    master.start("controller:=false", "simulated:=true")
    assert "/peripherals/emergency_owners" not in master.parameters


def test_preflight_is_told_what_node_parameters_says(master, tmp_path):
    own = tmp_path / "nodes.yaml"
    own.write_text("drive_contrl: {e_stop_topics: [/e_stop]}\n", encoding="utf-8")
    master.start(f"node_parameters:={own}")
    assert master.parameters["/robot_node_parameters/drive_contrl/e_stop_topics"] == ["/e_stop"]
    master.start()
    assert not [name for name in master.parameters if name.startswith("/robot_node_parameters")]


def test_what_was_found_out_of_the_robot_ends_with_its_start(master):
    master.start()
    master.parameters.update(FOUND_OUT)
    master.start()
    assert not set(FOUND_OUT) & set(master.parameters)


def test_each_start_is_another_run_for_what_its_nodes_remember(master):
    master.start()
    first = master.parameters["/robot_run"]
    master.start()
    assert first and master.parameters["/robot_run"] != first


@pytest.mark.parametrize("second, is_remembered", [({"/robot_run": "run_1"}, True), ({"/robot_run": "run_2"}, False)])
def test_car_locator_remembers_within_one_start_of_the_robot(monkeypatch, tmp_path, second, is_remembered):
    def memory(parameters):
        known = {"/run_id": "of the master", **parameters}
        monkeypatch.setattr(node.rospy, "get_param", lambda name, default=None: known.get(name, default))
        return node._memory_file(str(tmp_path))

    memory({"/robot_run": "run_1"}).write({"car": 7})
    assert (memory(second).read() is not None) is is_remembered


@pytest.mark.parametrize("name", WITH_ITS_NODES)
def test_each_node_of_the_robot_begins_without_the_parameters_of_before(name):
    tags = list(ElementTree.parse(LAUNCH / f"{name}.launch").getroot().iter("node"))
    assert tags and all(tag.get("clear_params") == "true" for tag in tags)
