/// @file
/// Conversion of fixes from the topic to core samples.
// SPDX-License-Identifier: Apache-2.0
#include "ros/gnss_input.hpp"

#include <utility>

#include "mtr_core/names.hpp"
#include "mtr_core/parameter.hpp"
#include "ros/conversions.hpp"

namespace mtr_localization {

namespace names = mtr_core::names;

GnssInput::GnssInput(ros::NodeHandle& node, const RobotFrames& frames, std::function<bool(const GnssFix&)> take)
    : frames_(frames),
      take_(std::move(take)),
      subscriber_(node.subscribe<sensor_msgs::NavSatFix>(
          names::kNavsatFix, 10, [this](const sensor_msgs::NavSatFix::ConstPtr& message) { receive(*message); },
          ros::VoidConstPtr(), ros::TransportHints().tcpNoDelay())) {}

void GnssInput::receive(const sensor_msgs::NavSatFix& message) {
  const std::string problem = problem_of(message);
  if (!problem.empty() && problem != problem_) {
    ROS_WARN("%s The satellite receiver is not used.", problem.c_str());
  }
  problem_ = problem;
}

std::string GnssInput::problem_of(const sensor_msgs::NavSatFix& message) const {
  try {
    const GnssFix fix = gnss_fix_of(message, frames_.antenna(message.header.frame_id).head<2>());
    return take_(fix) ? "" : "Its fixes are none, or they do not say that they are within 5 m (1 sigma).";
  } catch (const mtr_core::ConfigurationError& error) {
    return error.what();
  }
}

}  // namespace mtr_localization
