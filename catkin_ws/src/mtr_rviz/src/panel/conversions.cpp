/// @file
/// Conversions of ROS messages and parameters to core types.
// SPDX-License-Identifier: Apache-2.0
#include "panel/conversions.hpp"

#include <xmlrpcpp/XmlRpcException.h>

#include <algorithm>
#include <cmath>

namespace mtr_rviz {
namespace {

using XmlRpc::XmlRpcValue;

/// Returns the larger half axis of the position covariance (x, y of a row-major 3x3).
double worst_sigma_m(const boost::array<double, 9>& covariance) {
  const double mean = 0.5 * (covariance[0] + covariance[4]);
  const double half = 0.5 * (covariance[0] - covariance[4]);
  return std::sqrt(std::max(mean + std::hypot(half, covariance[1]), 0.0));
}

}  // namespace

ModeSaid from_message(const mtr_msgs::RobotMode& message) {
  ModeSaid said;
  said.is_held = message.hold_id != 0;
  said.message = message.message;
  using Message = mtr_msgs::RobotMode;
  switch (message.mode) {
    case Message::STARTING:
      said.mode = Mode::kStarting;
      break;
    case Message::READY_TO_MAP_CAR:
      said.mode = Mode::kReadyToMapCar;
      break;
    case Message::MAPPING_CAR:
      said.mode = Mode::kMappingCar;
      break;
    case Message::FOLLOWING_WAYPOINT:
      said.mode = Mode::kFollowingWaypoint;
      break;
    case Message::FAULT:
      said.mode = Mode::kFault;
      break;
    case Message::CHECKING_CAR:
      said.mode = Mode::kCheckingCar;
      break;
    default:
      break;
  }
  return said;
}

PoseSaid from_message(const mtr_msgs::LocalizedPose& message) {
  return {message.valid != 0, worst_sigma_m(message.covariance), message.message};
}

CarSaid from_message(const mtr_msgs::CarEstimate& message) {
  using Message = mtr_msgs::CarEstimate;
  const CarSaid::State state = message.state == Message::LOCATED      ? CarSaid::State::kLocated
                               : message.state == Message::COLLECTING ? CarSaid::State::kCollecting
                               : message.state == Message::FAILED     ? CarSaid::State::kFailed
                                                                      : CarSaid::State::kUnknown;
  return {state, message.length, message.width, message.message};
}

SelfCheckSaid from_message(const mtr_msgs::CarCheck& message) {
  using Message = mtr_msgs::CarCheck;
  const SelfCheckSaid::State state = message.state == Message::RUNNING  ? SelfCheckSaid::State::kRunning
                                     : message.state == Message::PASSED ? SelfCheckSaid::State::kPassed
                                     : message.state == Message::FAILED ? SelfCheckSaid::State::kFailed
                                                                        : SelfCheckSaid::State::kNone;
  return {state, message.difference_m, message.limit_m, message.message};
}

MotionSaid from_message(const mtr_msgs::MotionStatus& message) {
  using Message = mtr_msgs::MotionStatus;
  const MotionSaid::Result result = message.result == Message::PENDING   ? MotionSaid::Result::kPending
                                    : message.result == Message::REACHED ? MotionSaid::Result::kReached
                                    : message.result == Message::REFUSED ? MotionSaid::Result::kRefused
                                    : message.result == Message::BLOCKED ? MotionSaid::Result::kBlocked
                                                                         : MotionSaid::Result::kIdle;
  return {result, message.remaining_m, message.message};
}

DriveSaid from_message(const mtr_msgs::DriveStatus& message) {
  using Message = mtr_msgs::DriveStatus;
  // An unknown zone of a newer drive control must not count as clear.
  const DriveSaid::Zone zone = message.zone == Message::CLEAR     ? DriveSaid::Zone::kClear
                               : message.zone == Message::SLOWED  ? DriveSaid::Zone::kSlowed
                               : message.zone == Message::BLOCKED ? DriveSaid::Zone::kBlocked
                                                                  : DriveSaid::Zone::kBlind;
  return {message.source, message.linear_mps, zone, message.obstacle_m, message.message};
}

PartsSaid from_message(const mtr_msgs::PeripheralsState& message) {
  return {message.alive != 0, message.key_height_m, message.battery, message.message};
}

std::optional<Preflight> preflight_in(XmlRpcValue& parameter, double steady_s) {
  try {
    Preflight found;
    found.checks = static_cast<int>(parameter["checks"]);
    found.bad = static_cast<int>(parameter["bad"]);
    found.age_s = std::max(steady_s - static_cast<double>(parameter["made_s"]), 0.0);
    // Failed checks are listed first.
    if (found.bad > 0 && parameter["items"].size() > 0) {
      XmlRpcValue& item = parameter["items"][0];
      found.first_bad = static_cast<std::string&>(item[0]) + ": " + static_cast<std::string&>(item[2]);
    }
    return found;
  } catch (const XmlRpc::XmlRpcException&) {
    return std::nullopt;
  }
}

FaultCatalogue catalogue_in(XmlRpcValue& parameter) {
  FaultCatalogue catalogue;
  try {
    for (auto& [part, kinds] : parameter) {
      for (int i = 0; i < kinds.size(); ++i) {
        catalogue[part].push_back(static_cast<std::string&>(kinds[i]));
      }
    }
  } catch (const XmlRpc::XmlRpcException&) {
    return {};
  }
  return catalogue;
}

}  // namespace mtr_rviz
