/// @file
/// Starts the localization node.
// SPDX-License-Identifier: Apache-2.0
#include <ros/ros.h>

#include "mtr_localization/node.hpp"

int main(int argc, char** argv) {
  ros::init(argc, argv, "localization");
  ros::NodeHandle node;
  try {
    mtr_localization::Node localization(node, mtr_localization::read_node_parameters(ros::NodeHandle("~")));
    ros::spin();
  } catch (const mtr_lockstep::ConfigurationError& error) {
    ROS_FATAL("%s", error.what());
    return 1;
  }
  return 0;
}
