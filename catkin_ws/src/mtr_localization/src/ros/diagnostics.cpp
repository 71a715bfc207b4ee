/// @file
/// Diagnostic status of localization for /diagnostics.
// SPDX-License-Identifier: Apache-2.0
#include "ros/diagnostics.hpp"

#include <ros/this_node.h>

#include <cmath>
#include <string>

#include "mtr_core/clock.hpp"

namespace mtr_localization {
namespace {

using diagnostic_msgs::DiagnosticStatus;

diagnostic_msgs::KeyValue key_value(const std::string& key, double value) {
  diagnostic_msgs::KeyValue pair;
  pair.key = key;
  pair.value = std::to_string(value);
  return pair;
}

const char* text_of(PoseMode mode) {
  switch (mode) {
    case PoseMode::kMapping:
      return "mapping";
    case PoseMode::kLocalized:
      return "localized in the frozen map";
    case PoseMode::kLost:
      return "lost";
    default:
      return "dead reckoning";
  }
}

}  // namespace

diagnostic_msgs::DiagnosticArray diagnostics_of(const PoseFigures& figures, const Estimate& estimate,
                                                const WorkLoad& load) {
  DiagnosticStatus status;
  status.name = ros::this_node::getName() + ": pose";
  status.hardware_id = "imu, wheels and LiDARs";
  const bool lost = estimate.mode == PoseMode::kLost;
  const bool warns = !estimate.valid || estimate.degenerate;
  status.level = lost ? DiagnosticStatus::ERROR : warns ? DiagnosticStatus::WARN : DiagnosticStatus::OK;
  status.message = estimate.valid ? text_of(estimate.mode) : estimate.message.text;
  const auto& covariance = estimate.covariance;
  status.values = {key_value("position_sigma_m", std::sqrt(covariance[0] + covariance[4])),
                   key_value("heading_sigma_rad", std::sqrt(covariance[8])),
                   key_value("gyro_bias_radps", figures.gyro_bias_radps),
                   key_value("gyro_bias_sigma_radps", figures.gyro_bias_sigma_radps),
                   key_value("wheel_scale", figures.wheel_scale),
                   key_value("beams_compared", figures.tracking.points),
                   key_value("beams_matched", figures.tracking.matched),
                   key_value("share_of_expected_view_seen", figures.tracking.agreement),
                   key_value("weakest_direction_sigma_m", figures.tracking.weakest_sigma_m),
                   key_value("scans_used", figures.scans_used),
                   key_value("scans_refused", figures.scans_refused),
                   key_value("ms_per_scan", load.mean_ms_per_scan()),
                   key_value("longest_answer_ms", load.max_ms()),
                   key_value("navsat_fixes_used", figures.gnss.used),
                   key_value("navsat_fixes_refused", figures.gnss.refused),
                   key_value("navsat_residual_m", figures.gnss.residual_m),
                   key_value("map_revision", estimate.map_revision)};
  diagnostic_msgs::DiagnosticArray array;
  array.header.stamp = mtr_core::stamp_of(estimate.stamp_ns);
  array.status = {status};
  return array;
}

}  // namespace mtr_localization
