/// @file
/// Life cycle of a node from its parameters to its exit status, common to all nodes.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <ros/ros.h>

#include <memory>
#include <string>

#include "mtr_core/names.hpp"
#include "mtr_core/parameter_reader.hpp"

namespace mtr_core {

inline constexpr int kCannotStart = 2;

/// Constructs an N from its private parameters and runs spin() until shutdown.
///
/// N has a static read(ParameterReader&) that returns the second argument of its constructor, after the node handle.
/// Returns the exit status: 0 after Ctrl-C, 2 after one sentence if the node cannot start.
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
    // Stored for the Operator, because a log may be lost with the process.
    ros::param::set(names::kStartFailures + ros::this_node::getName(), std::string(error.what()));
    return kCannotStart;
  }
  ros::param::del(names::kStartFailures + ros::this_node::getName());
  made->spin();
  return 0;
}

}  // namespace mtr_core
