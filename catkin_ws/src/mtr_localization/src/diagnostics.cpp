/// @file
/// State of localization for /diagnostics.
// SPDX-License-Identifier: Apache-2.0
#include "mtr_localization/diagnostics.hpp"

#include <ros/this_node.h>

#include <cmath>
#include <string>

#include "mtr_lockstep/clock.hpp"

namespace mtr_localization {
namespace {

using diagnostic_msgs::DiagnosticStatus;

diagnostic_msgs::KeyValue key_value(const std::string& key, double value) {
  diagnostic_msgs::KeyValue pair;
  pair.key = key;
  pair.value = std::to_string(value);
  return pair;
}

}  // namespace

diagnostic_msgs::DiagnosticArray diagnostics_of(const Localizer& localizer, const Estimate& estimate) {
  DiagnosticStatus status;
  status.name = ros::this_node::getName() + ": pose";
  status.hardware_id = "imu and wheels";
  const bool lost = localizer.mode() == Mode::kLost;
  status.level = estimate.valid ? DiagnosticStatus::OK : (lost ? DiagnosticStatus::ERROR : DiagnosticStatus::WARN);
  status.message = estimate.valid ? "tracking" : estimate.message;
  const auto& covariance = estimate.covariance;
  status.values = {key_value("position_sigma_m", std::sqrt(covariance[0] + covariance[4])),
                   key_value("heading_sigma_rad", std::sqrt(covariance[8])),
                   key_value("gyro_bias_radps", localizer.reckoning().gyro_bias_radps()),
                   key_value("gyro_bias_sigma_radps", localizer.reckoning().gyro_bias_sigma_radps())};
  diagnostic_msgs::DiagnosticArray array;
  array.header.stamp = mtr_lockstep::stamp_of(estimate.stamp_ns);
  array.status = {status};
  return array;
}

}  // namespace mtr_localization
