/// @file
/// Reads the numeric parameters of a node from the parameter server, checks them and prints the effective values.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <ros/ros.h>

#include <string>

#include "mtr_lockstep/parameter.hpp"

namespace mtr_lockstep {

/// Overwrites the defaults in parameters by the node's private ones; throws ConfigurationError.
template <typename P, typename Rows>
void read_parameters(const ros::NodeHandle& private_node, const Rows& rows, P& parameters) {
  for (const ParameterRow<P>& row : rows) {
    double& value = parameters.*(row.member);
    if (private_node.hasParam(row.name) && !private_node.getParam(row.name, value)) {
      throw ConfigurationError("Parameter " + std::string(row.name) + " is not a number.");
    }
    check_range(row.name, value, row.low, row.high, row.unit);
    ROS_INFO("%s: %g %s", row.name, value, row.unit);
  }
}

}  // namespace mtr_lockstep
