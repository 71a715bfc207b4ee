/// @file
/// Life of a node from its parameters to its exit status, the same for all.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <ros/ros.h>

#include <memory>
#include <string>

#include "mtr_core/names.hpp"
#include "mtr_core/parameter_reader.hpp"

namespace mtr_core {

inline constexpr int kCannotStart = 2;

/// Makes an N from its private parameters and lets it spin() until shutdown.
///
/// N has a static read(ParameterReader&) that returns what its constructor takes besides the node handle.
/// Returns the exit status: 0 after Ctrl-C, 2 after one sentence when the node cannot start.
template <typename N>
int run_node(int argc, char** argv, const std::string& name) {
  ros::init(argc, argv, name);
  ros::NodeHandle node;
  std::unique_ptr<N> made;
  try {
    XmlRpc::XmlRpcValue values;
    ros::param::get(ros::this_node::getName(), values);
    ParameterReader reader(values);
    const auto parameters = N::read(reader);
    ROS_INFO("Parameters: %s", reader.finish().c_str());
    made = std::make_unique<N>(node, parameters);
  } catch (const ConfigurationError& error) {
    ROS_FATAL("The node %s cannot start. %s", name.c_str(), error.what());
    // For the Operator: a log may be lost with the process.
    ros::param::set(names::kStartFailures + ros::this_node::getName(), std::string(error.what()));
    return kCannotStart;
  }
  ros::param::del(names::kStartFailures + ros::this_node::getName());
  made->spin();
  return 0;
}

}  // namespace mtr_core
