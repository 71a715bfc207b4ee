/// @file
/// Starts the drive control node.
// SPDX-License-Identifier: Apache-2.0
#include <ros/ros.h>

#include "mtr_drive_control/node.hpp"

int main(int argc, char** argv) {
  ros::init(argc, argv, "drive_control");
  ros::NodeHandle node;
  try {
    mtr_drive_control::Node(node, mtr_drive_control::read_node_parameters(ros::NodeHandle("~"))).run();
  } catch (const mtr_lockstep::ConfigurationError& error) {
    ROS_FATAL("%s", error.what());
    return 1;
  }
  return 0;
}
