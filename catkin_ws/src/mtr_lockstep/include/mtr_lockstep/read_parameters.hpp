/// @file
/// Reads the numeric parameters of a node from the parameter server, checks them and prints the effective values.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <ros/ros.h>

#include <string>

#include "mtr_lockstep/parameter.hpp"

namespace mtr_lockstep {

/// Overwrites the default in value by the node's private parameter; throws ConfigurationError naming what it must be.
template <typename T>
void read_parameter(const ros::NodeHandle& private_node, const std::string& name, const std::string& what, T& value) {
  if (private_node.hasParam(name) && !private_node.getParam(name, value)) {
    throw ConfigurationError("Parameter " + name + " is not " + what + ".");
  }
}

/// Overwrites the defaults in parameters by the node's private ones; throws ConfigurationError.
template <typename P, typename Rows>
void read_parameters(const ros::NodeHandle& private_node, const Rows& rows, P& parameters) {
  for (const ParameterRow<P>& row : rows) {
    double& value = parameters.*(row.member);
    read_parameter(private_node, row.name, "a number", value);
    check_range(row.name, value, row.low, row.high, row.unit);
    ROS_INFO("%s: %g %s", row.name, value, row.unit);
  }
}

}  // namespace mtr_lockstep
