/// @file
/// Orders, choice of key-frames, and the adjustment's thread.
// SPDX-License-Identifier: Apache-2.0
#include "mtr_localization/map_builder.hpp"

#include <chrono>
#include <cmath>
#include <utility>

#include "mtr_localization/se2.hpp"

namespace mtr_localization {
namespace {

// Facts of the prototype: denser key-frames change nothing, sparser ones lose corners.
constexpr double kEveryM = 0.4;
constexpr double kEveryRad = 0.35;

double square(double value) { return value * value; }

}  // namespace

MapBuilder::MapBuilder(const Parameters& parameters, Adjust adjust)
    : parameters_(parameters), adjust_(std::move(adjust)) {}

bool MapBuilder::order(const MapOrder& order, std::int64_t effect_delay_ns) {
  const bool is_known = state_ != State::kNone && order.map_car_id == map_car_id_;
  if (order.phase == MapOrder::Phase::kCollect && !is_known && state_ != State::kAdjusting) {
    map_car_id_ = order.map_car_id;
    key_frames_.clear();
    state_ = State::kCollecting;
    return true;
  }
  const bool is_open = is_known && (state_ == State::kCollecting || state_ == State::kPaused);
  if (is_open && order.phase == MapOrder::Phase::kFreeze) {
    effect_ns_ = order.stamp_ns + effect_delay_ns;
    adjusting_ = std::async(std::launch::async, adjust_, key_frames_);
    state_ = State::kAdjusting;
  } else if (is_open) {
    state_ = order.phase == MapOrder::Phase::kCollect ? State::kCollecting : State::kPaused;
  }
  return false;
}

void MapBuilder::travel(double distance_m, double angle_rad) {
  distance_m_ += std::abs(distance_m);
  turned_rad_ += std::abs(angle_rad);
}

bool MapBuilder::add(const View& view) {
  if (state_ != State::kCollecting || !is_due(view)) {
    return false;
  }
  KeyFrame frame;
  frame.stamp_ns = view.scan.stamp_ns;
  frame.pose = view.pose;
  frame.scan = view.scan;
  frame.standing = view.standing;
  if (!key_frames_.empty()) {
    const double duration_s = static_cast<double>(frame.stamp_ns - key_frames_.back().stamp_ns) * 1e-9;
    frame.motion = relative(last_odom_, view.odom);
    frame.motion_covariance = motion_covariance(duration_s, view.gyro_bias_sigma_radps);
  }
  key_frames_.push_back(std::move(frame));
  last_odom_ = view.odom;
  distance_m_ = turned_rad_ = 0.0;
  return true;
}

bool MapBuilder::is_due(const View& view) const {
  if (key_frames_.empty()) {
    return true;
  }
  const PoseVector moved = relative(last_odom_, view.odom);
  return moved.head<2>().norm() > kEveryM || std::abs(moved.z()) > kEveryRad;
}

Eigen::Matrix3d MapBuilder::motion_covariance(double duration_s, double gyro_bias_sigma_radps) const {
  const double heading = square(parameters_.gyro_noise_radps_per_sqrt_hz) * duration_s +
                         square(gyro_bias_sigma_radps * duration_s) + square(parameters_.gyro_scale_sigma * turned_rad_);
  const double turning = square(parameters_.turn_slip_m_per_sqrt_rad) * turned_rad_;
  // Without the wheels' scale: it is common to all motions and a parameter of the adjustment.
  const double along = square(parameters_.slip_m_per_sqrt_m) * distance_m_;
  // Across: slip of the tyres, and the mean heading on the way.
  const double across = square(parameters_.slip_m_per_sqrt_m) * distance_m_ + heading * square(0.5 * distance_m_);
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  covariance.diagonal() << along + turning, across + turning, heading;
  // Two looks from the same place still differ by the tyres' sway.
  covariance.diagonal() += Eigen::Vector3d(1e-6, 1e-6, 1e-8);
  return covariance;
}

std::optional<AdjustedMap> MapBuilder::result(std::int64_t now_ns, bool waits) {
  if (state_ != State::kAdjusting || now_ns < effect_ns_) {
    return std::nullopt;
  }
  if (!waits && adjusting_.wait_for(std::chrono::seconds(0)) != std::future_status::ready) {
    return std::nullopt;
  }
  state_ = State::kDone;
  return adjusting_.get();
}

}  // namespace mtr_localization
