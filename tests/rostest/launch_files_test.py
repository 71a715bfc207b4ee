#!/usr/bin/env python3
"""The shipped launch files need no argument that is not documented as needed, and every node that they name exists."""
# SPDX-License-Identifier: Apache-2.0
import os
import pathlib
import shlex
import sys
import unittest
from types import SimpleNamespace

import roslaunch
import rospkg
import rostest
import sensor_msgs.msg
from case import case
from roslaunch.node_args import create_local_process_args, get_node_list
from std_msgs.msg import Header

from mtr_core import names, sensor_figures

NEEDED = {"robot.launch": [], "sim.launch": ["car_port_link:=/tmp/can"], "replay.launch": ["bag:=/tmp/a.bag"],
          "view.launch": [], "description.launch": [], "jackal.launch": []}
ROBOT = {"/robot_state_publisher", "/drive_control", "/localization", "/motion_planner", "/car_locator",
         "/state_machine", "/peripherals", "/dispatcher"}
NODES = {"robot.launch": ROBOT | {"/controller_input", "/graph_watch", "/joy", "/serial_bridge"},
         "sim.launch": ROBOT | {"/simulator"},
         "replay.launch": {"/robot_state_publisher", "/localization", "/car_locator", "/state_machine", "/play"},
         "view.launch": {"/rviz"},
         "description.launch": {"/rviz", "/robot_state_publisher", "/joint_state_publisher"},
         "jackal.launch": ROBOT | {"/controller_input", "/graph_watch", "/joy", "/serial_bridge",
                                   "/battery_of_voltage", "/base_stop"}}


def load(name, arguments):
    """A shipped launch file as roslaunch reads it."""
    path = os.path.join(rospkg.RosPack().get_path("mtr_bringup"), "launch", name)
    return roslaunch.config.load_config_default([(path, arguments)], None)


def frames_of(config):
    """Frames of front LiDAR, rear LiDAR and IMU."""
    return [config.params[f"/robot_frames/{link}"].value for link in ("front_lidar", "rear_lidar", "imu")]


class LaunchFiles(unittest.TestCase):
    """Nothing is started."""

    def test_each_launch_file_starts_its_nodes_with_no_more_than_the_needed_arguments(self):
        for name, arguments in NEEDED.items():
            with case(name):
                self.assertEqual(set(get_node_list(load(name, arguments))), NODES[name])

    def test_manual_controller_that_is_started_is_a_required_owner_of_the_motion_lock(self):  # A4
        owners = "/drive_control/lock_owners"
        self.assertIn("controller_input", load("robot.launch", []).params[owners].value)
        self.assertNotIn("controller_input", load("robot.launch", ["controller:=false"]).params[owners].value)
        self.assertNotIn(owners, load("robot.launch", ["controller:=false", "graph_watch:=false"]).params)
        self.assertNotIn(owners, load("sim.launch", NEEDED["sim.launch"]).params)

    def test_robot_stands_without_the_word_of_the_watch_of_its_graph(self):
        owners = "/drive_control/lock_owners"
        self.assertIn("graph_watch", load("robot.launch", ["controller:=false"]).params[owners].value)
        unwatched = load("robot.launch", ["graph_watch:=false"])
        self.assertNotIn("graph_watch", unwatched.params[owners].value)
        self.assertNotIn("/graph_watch", get_node_list(unwatched))

    def test_nodes_are_on_loopback_unless_a_person_chose_otherwise(self):
        robot = load("robot.launch", [])
        self.assertIn("graph_watch", robot.params["/drive_control/lock_owners"].value)
        for node in robot.nodes:
            self.assertIn(("ROS_IP", "127.0.0.1"), list(map(tuple, node.env_args)), node.name)
        chosen = load("robot.launch", ["open_graph:=true"])
        self.assertFalse([node.name for node in chosen.nodes if "ROS_IP" in dict(node.env_args)])
        self.assertIs(chosen.params["/graph_watch/open_graph"].value, True)

    def test_every_node_of_a_robot_waits_for_its_name(self):
        for arguments in ([], ["joy:=evdev", "base_guard:=true", "fault_injection:=true"]):
            for node in load("robot.launch", arguments).nodes:
                self.assertEqual(node.launch_prefix, "python3 -m mtr_graph_watch.name_guard", node.name)

    def test_base_guard_has_the_limits_of_the_shipped_base(self):  # A2
        guarded = load("robot.launch", ["base_guard:=true"])
        self.assertEqual(set(get_node_list(guarded)), NODES["robot.launch"] | {"/base_guard"})
        shipped = load("sim.launch", NEEDED["sim.launch"]).params
        controller = "/jackal_velocity_controller/"
        limits = [name for name in shipped if name.startswith(controller)]
        self.assertGreater(len(limits), 3)
        for name in limits:
            self.assertEqual(guarded.params["/base_guard" + name].value, shipped[name].value)

    def test_topics_have_the_names_that_a_robot_gives_them(self):
        robot = load("robot.launch", ["front_scan:=/scan", "wheel_command:=/base/cmd_vel", "publish_odom_tf:=false"])
        for name in ("drive_control", "localization", "car_locator", "dispatcher"):
            node = next(node for node in robot.nodes if node.name == name)
            with case(name):
                self.assertIn(["/front/scan", "/scan"], node.remap_args)
                self.assertIn(["/jackal_velocity_controller/cmd_vel", "/base/cmd_vel"], node.remap_args)
        self.assertIs(robot.params["/localization/publish_odom_tf"].value, False)

    def test_frames_have_the_names_that_a_robot_gives_them(self):
        self.assertEqual(frames_of(load("robot.launch", [])), ["front_lidar", "rear_lidar", "imu"])
        self.assertEqual(frames_of(load("robot.launch", ["front_frame:=front_laser", "imu_frame:=imu_link"])),
                         ["front_laser", "rear_lidar", "imu_link"])

    def test_jackal_is_started_as_its_own_service_leaves_it(self):
        jackal = load("jackal.launch", [])
        self.assertIs(jackal.params["/localization/publish_odom_tf"].value, False)
        self.assertEqual(frames_of(jackal), ["front_laser", "rear_laser", "imu_link"])
        given = load("jackal.launch", ["bind_address:=10.42.0.1", "rear_lidar:=false", "base_guard:=true"])
        self.assertEqual(given.params["/dispatcher/bind_address"].value, "10.42.0.1")
        self.assertIs(given.params["/drive_control/rear_lidar"].value, False)
        self.assertIn("/base_guard", get_node_list(given))

    def test_drivers_of_a_jackals_lidars_speak_where_the_nodes_listen(self):
        for kind, package, word in (("sick_lms111", "lms1xx", "host"), ("hokuyo_ust10lx", "urg_node", "ip_address"),
                                    ("sick_tim5xx", "sick_tim", "hostname")):
            with case(kind):
                jackal = load("jackal.launch", [f"lidar:={kind}", "rear_host:=10.0.0.2"])
                drivers = {node.name: node for node in jackal.nodes if node.name.endswith("_lidar_driver")}
                self.assertEqual({node.package for node in drivers.values()}, {package})
                self.assertEqual(drivers["front_lidar_driver"].remap_args[-1], ["scan", "/front/scan"])
                self.assertEqual(drivers["rear_lidar_driver"].remap_args[-1], ["scan", "/rear/scan"])
                self.assertEqual(jackal.params[f"/rear_lidar_driver/{word}"].value, "10.0.0.2")
                self.assertEqual(jackal.params["/rear_lidar_driver/frame_id"].value, "rear_lidar")
                # Zero is no measurement: what is dazzled, dark or too near is not free space.
                stated = jackal.params.get("/rear_lidar_driver/publish_min_range_as_inf")
                self.assertIs(stated.value if stated else None, False if package == "lms1xx" else None)
                self.assertEqual(frames_of(jackal), ["front_lidar", "rear_lidar", "imu_link"])
        with self.assertRaises(roslaunch.RLException):
            load("jackal.launch", ["front_driver:=no_such_driver"])
        one = load("jackal.launch", ["lidar:=sick_lms111", "rear_lidar:=false"])
        self.assertNotIn("/rear_lidar_driver", get_node_list(one))

    def test_jackals_voltage_is_a_charge(self):
        node = next(node for node in load("jackal.launch", []).nodes if node.name == "battery_of_voltage")
        _, topic, kind, expression = shlex.split(node.args)[:4]
        self.assertEqual((topic, kind), ("/battery", "sensor_msgs/BatteryState"))
        for voltage, charge in ((30.0, 1.0), (29.4, 1.0), (24.0, 0.143), (20.0, 0.0)):
            told = SimpleNamespace(header=Header(seq=7), measured_battery=voltage)
            state = eval(expression, {"sensor_msgs": sensor_msgs, "m": told})  # As topic_tools does it.
            self.assertAlmostEqual(state.percentage, charge, places=3)
            self.assertEqual((state.header.seq, state.voltage), (7, voltage))

    def test_named_lidar_is_what_its_data_sheet_says(self):
        package = pathlib.Path(rospkg.RosPack().get_path("mtr_description"))
        kinds = sorted(path.stem for path in (package / "config" / "lidars").glob("*.yaml"))
        self.assertIn("sick_tim5xx", kinds)
        allowed = {"range_noise_m": sensor_figures.ASSUMED_RANGE_NOISE_M,
                   "range_sigma_m": sensor_figures.ASSUMED_POINT_M,
                   "range_bias_sigma_m": sensor_figures.ASSUMED_RANGE_BIAS_M,
                   "time_increment_s": sensor_figures.SensorFigure(0.0, 1e-6, 0.001, "s")}
        for kind in kinds:
            with case(kind):
                params = load("robot.launch", [f"lidar:={kind}"]).params
                for name, figure in allowed.items():
                    self.assertTrue(figure.low <= params[f"/localization/{name}"].value <= figure.high, name)
                self.assertEqual(params["/car_locator/time_increment_s"].value,
                                 params["/localization/time_increment_s"].value)
                self.assertNotIn("/car_locator/range_noise_m", params)
                self.assertTrue(10.0 <= params[names.LIDAR_TURN_RATE].value <= 100.0)
        unnamed = load("robot.launch", []).params
        self.assertNotIn("/localization/range_noise_m", unnamed)
        self.assertNotIn(names.LIDAR_TURN_RATE, unnamed)
        with self.assertRaises(roslaunch.RLException):
            load("robot.launch", ["lidar:=no_such_lidar"])

    def test_faults_can_be_injected_only_where_it_was_asked_for_and_then_stand_between_drivers_and_nodes(self):
        self.assertNotIn("/fault_injection", str([node.remap_args for node in load("robot.launch", []).nodes]))
        robot = load("robot.launch", ["fault_injection:=true", "front_scan:=/scan"])
        self.assertEqual(set(get_node_list(robot)), NODES["robot.launch"] | {"/fault_injection"})
        remaps = {node.name: node.remap_args for node in robot.nodes}
        self.assertEqual(robot.params["/fault_injection/front_scan"].value, "/scan")
        self.assertFalse([new for _, new in remaps["fault_injection"] if new.startswith("/fault_injection")])
        for name in ("drive_control", "localization", "car_locator", "dispatcher"):
            self.assertIn(["/front/scan", "/fault_injection/front/scan"], remaps[name])
        self.assertIn(["/firmware/state", "/fault_injection/firmware/state"], remaps["peripherals"])
        self.assertNotIn(["/firmware/state", "/fault_injection/firmware/state"], remaps["serial_bridge"])
        self.assertIs(robot.params["/fault_injection/simulated"].value, False)

    def test_each_node_of_robot_and_simulation_has_an_executable(self):
        for node in load("sim.launch", NEEDED["sim.launch"]).nodes:
            with case(node.name):
                command = create_local_process_args(node, None)
                # The guard of a node's name starts the node's program.
                program = command[3] if command[1:3] == ["-m", "mtr_graph_watch.name_guard"] else command[0]
                self.assertTrue(os.access(program, os.X_OK), command)

    def test_nodes_of_the_robot_are_started_again_and_none_ends_the_others(self):  # A11
        robot = load("robot.launch", [])
        self.assertEqual({node.name for node in robot.nodes if node.required or not node.respawn}, set())
        simulated = load("sim.launch", NEEDED["sim.launch"])
        self.assertEqual({node.name for node in simulated.nodes if node.required}, {"simulator", "dispatcher"})

    def test_missing_argument_is_named(self):
        with self.assertRaisesRegex(Exception, "car_port_link"):
            load("sim.launch", [])


if __name__ == "__main__":
    rostest.rosrun("mtr_tests", "launch_files_test", LaunchFiles, sys.argv)
