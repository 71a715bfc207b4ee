#!/usr/bin/env python3
"""A node that cannot serve the robot that is described ends with status 2 and one sentence."""
# SPDX-License-Identifier: Apache-2.0
import subprocess
import sys
import unittest

import roslib.packages
import rospy
import rostest
from case import case

from mtr_core import names
from mtr_core.lockstep.start import CANNOT_START
from mtr_description.shipped import shipped_urdf

NODES = {"car_locator": "mtr_car_locator", "dispatcher": "mtr_dispatcher", "drive_control": "mtr_drive_control",
         "localization": "mtr_localization", "motion_planner": "mtr_motion_planner", "peripherals": "mtr_peripherals"}
READS_LIDARS = {"car_locator", "drive_control", "localization"}
READS_KEY = {"dispatcher", "drive_control", "motion_planner", "peripherals"}


START_LIMIT_S = 20.0


def run(node, *arguments):
    """Start a node that ends by itself."""
    path = roslib.packages.find_node(NODES[node], f"{node}_node")[0]
    return subprocess.run([path, f"__name:={node}", *arguments], stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                          text=True, timeout=START_LIMIT_S, check=False)


class RobotDescription(unittest.TestCase):
    """The nodes are started one after the other; none of them gets as far as its topics."""

    def check(self, nodes, sentence):
        """Each of the nodes refuses to start with that sentence."""
        for node in sorted(nodes):
            with case(node):
                done = run(node)
                self.assertEqual(done.returncode, CANNOT_START, done.stdout)
                self.assertIn(sentence, done.stdout)

    def test_no_robot_is_described(self):
        if rospy.has_param(names.ROBOT_DESCRIPTION):
            rospy.delete_param(names.ROBOT_DESCRIPTION)
        self.check(NODES, "Parameter robot_description is not set; allowed is the robot's URDF")

    def test_lidar_is_missing(self):
        rospy.set_param(names.ROBOT_DESCRIPTION, shipped_urdf().replace('"front_lidar"', '"lidar"'))
        self.check(READS_LIDARS, "The robot_description has no link front_lidar; allowed are descriptions in which it "
                                 "hangs on base_link.")

    def test_lidar_is_upside_down(self):
        rospy.set_param(names.ROBOT_DESCRIPTION,
                        shipped_urdf().replace('"0 0 3.141592653589793"', '"3.141592653589793 0 3.141592653589793"'))
        self.check(READS_LIDARS, "The roll of rear_lidar in robot_description is 3.14159 rad; allowed is -0.0349066 to "
                                 "0.0349066 rad.")

    def test_two_lidars_are_said_to_speak_in_one_frame(self):
        rospy.set_param(names.ROBOT_DESCRIPTION, shipped_urdf())
        rospy.set_param(names.ROBOT_FRAMES, {names.FRONT_LIDAR: "laser", names.REAR_LIDAR: "laser"})
        self.addCleanup(rospy.delete_param, names.ROBOT_FRAMES)
        self.check({"localization"}, "Both LiDARs are said to speak in the frame laser; give each its own")

    def test_key_is_missing(self):
        rospy.set_param(names.ROBOT_DESCRIPTION, shipped_urdf().replace('"key"', '"remote"'))
        self.check(READS_KEY, "The robot_description has no link key; allowed are descriptions in which it hangs on "
                              "base_link.")

    def test_parameter_that_the_urdf_has_instead_is_refused(self):
        rospy.set_param(names.ROBOT_DESCRIPTION, shipped_urdf())
        done = run("dispatcher", "_key_x_m:=0.3")
        self.assertIn("Parameter key_x_m is unknown; allowed are", done.stdout)
        self.assertEqual(done.returncode, CANNOT_START)


if __name__ == "__main__":
    rostest.rosrun("mtr_tests", "robot_description_test", RobotDescription, sys.argv)
