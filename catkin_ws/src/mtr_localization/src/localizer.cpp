/// @file
/// The filter's steps, with an answer to every fault of the sensors' data.
// SPDX-License-Identifier: Apache-2.0
#include "mtr_localization/localizer.hpp"

#include <cmath>
#include <utility>

#include "mtr_localization/interruption.hpp"
#include "mtr_localization/map_names.hpp"

namespace mtr_localization {
namespace {

// Wheel motion over an interruption up to which the robot is taken not to have moved.
constexpr double kUnmovedM = 0.01;
constexpr double kUnmovedRad = 0.02;
// Gyro rate at rest up to which it can be a bias, rad/s: 4 sigma of the bias at switch-on.
constexpr double kLargestBiasRadps = 0.2;

// Between two tilts of different places or headings.
constexpr double kLevelEveryM = 0.3;
constexpr double kLevelEveryRad = 0.3;

double seconds(std::int64_t duration_ns) { return static_cast<double>(duration_ns) * 1e-9; }

}  // namespace

Localizer::Localizer(const LocalizerParameters& parameters)
    : parameters_(parameters),
      history_(PoseFilter(parameters.motion), 0),
      keeper_(parameters),
      standstill_(parameters.motion) {
  check(parameters.motion);
  check(parameters.tracking);
  check(parameters.adjustment);
  message_ = "Stand still: measuring the gyro's bias.";
}

std::vector<Estimate> Localizer::add_imu(const ImuSample& sample) {
  if (!gyro_.add(sample)) {
    restart_ = "The time of the IMU went backwards.";
  }
  return process_pending();
}

std::vector<Estimate> Localizer::add_wheels(const WheelSample& sample) {
  if (newest_wheels_ns_ == sample.stamp_ns) {
    return {};
  }
  if (newest_wheels_ns_ && sample.stamp_ns < *newest_wheels_ns_) {
    pending_.clear();
    emitted_ns_.reset();
    restart_ = "The time of the wheel odometry went backwards.";
  }
  newest_wheels_ns_ = sample.stamp_ns;
  pending_.push_back(sample);
  return process_pending();
}

std::vector<Estimate> Localizer::check_silence(std::int64_t now_ns) {
  if (!newest_wheels_ns_) {
    return not_older_than_emitted({refused(now_ns, "Waiting for wheel odometry.")});
  }
  if (now_ns - *newest_wheels_ns_ > gap_limit_ns()) {
    return not_older_than_emitted({refused(now_ns, "Wheel odometry is silent, or its stamps are old.")});
  }
  return {};
}

std::vector<Estimate> Localizer::process_pending() {
  std::vector<Estimate> estimates;
  while (!pending_.empty()) {
    const WheelSample& wheels = pending_.front();
    if (gyro_.newest_heard_ns().value_or(0) >= wheels.stamp_ns) {
      estimates.push_back(process(wheels));
    } else if (*newest_wheels_ns_ - wheels.stamp_ns > gap_limit_ns()) {
      estimates.push_back(refused(wheels.stamp_ns, "The IMU is silent."));
    } else {
      break;
    }
    pending_.pop_front();
  }
  return not_older_than_emitted(std::move(estimates));
}

Estimate Localizer::process(const WheelSample& wheels) {
  if (!wheels.is_finite()) {
    return refused(wheels.stamp_ns, "Wheel odometry is not a finite number.");
  }
  if (!gyro_.covers(wheels.stamp_ns)) {
    return refused(wheels.stamp_ns,
                   gyro_.newest_is_good() ? "Waiting for the IMU." : "The IMU's rate is not a number.");
  }
  std::string interruption = std::exchange(restart_, "");
  if (last_ && interruption.empty()) {
    interruption = interruption_between(*last_, wheels, gyro_, gap_limit_ns());
  }
  if (last_ && interruption.empty()) {
    history_.advance(wheels.stamp_ns, input_since_last(wheels));
  } else {
    if (last_) {
      interrupt(interruption, wheels);
    }
    history_.restart(filter(), wheels.stamp_ns, history_.newest().odom);
  }
  last_ = wheels;
  gyro_.forget_before(wheels.stamp_ns);
  if (keeper_.advance(history_, standstill_.standing())) {
    navsat_.clear();
    if (state_ == MotionState::kLost) {
      state_ = MotionState::kTracking;
      message_.clear();
    }
  }
  const std::string contradiction = navsat_.use_due(keeper_.tracker(), history_);
  if (!contradiction.empty()) {
    keeper_.lose(contradiction);
  }
  return estimate_at(wheels.stamp_ns);
}

FilterInput Localizer::input_since_last(const WheelSample& wheels) {
  FilterInput input;
  input.motion.duration_s = seconds(wheels.stamp_ns - last_->stamp_ns);
  const double gyro_rate = gyro_.rate_at(wheels.stamp_ns);
  standstill_.update(wheels, rate_for_standstill(gyro_rate));
  input.slope = slope_at(wheels, input.motion.duration_s);
  if (state_ == MotionState::kInterrupted && !standstill_.resting()) {
    lose(message_);
  }
  if (state_ == MotionState::kLost) {
    return input;
  }
  if (standstill_.standing()) {
    input.kind = FilterInput::Kind::kStand;
    input.motion.gyro_angle_rad = gyro_rate * input.motion.duration_s;
  } else if (state_ == MotionState::kTracking) {
    input.kind = FilterInput::Kind::kMove;
    input.motion.distance_m = wheels.distance_since(*last_);
    input.motion.gyro_angle_rad = gyro_.integral(last_->stamp_ns, wheels.stamp_ns);
  }
  if (standstill_.standing_s() >= parameters_.motion.bias_time_s) {
    state_ = MotionState::kTracking;
    message_.clear();
  }
  return input;
}

Eigen::Vector2d Localizer::slope_at(const WheelSample& wheels, double duration_s) {
  tilt_.advance(duration_s, gyro_.sample_at(wheels.stamp_ns), wheels.linear_mps, standstill_.standing());
  const PoseVector& odom = history_.newest().odom;
  const PoseVector moved = relative(leveled_odom_, odom);
  if (moved.head<2>().norm() > kLevelEveryM || std::abs(moved.z()) > kLevelEveryRad) {
    level_.add(odom.z(), tilt_.slope());
    leveled_odom_ = odom;
  }
  return level_.relative(odom.z(), tilt_.slope());
}

double Localizer::rate_for_standstill(double gyro_rate_radps) const {
  // As long as the bias is unknown, only a rate beyond any bias betrays a turn.
  const bool bias_unknown = state_ == MotionState::kStarting && std::abs(gyro_rate_radps) <= kLargestBiasRadps;
  return bias_unknown ? 0.0 : filter().corrected_rate(gyro_rate_radps);
}

void Localizer::interrupt(const std::string& reason, const WheelSample& wheels) {
  const double moved_m = std::hypot(wheels.x_m - last_->x_m, wheels.y_m - last_->y_m);
  const double turned_rad = std::remainder(wheels.heading_rad - last_->heading_rad, 2.0 * M_PI);
  const bool unmoved = moved_m <= kUnmovedM && std::abs(turned_rad) <= kUnmovedRad;
  if (state_ == MotionState::kTracking && standstill_.standing() && unmoved) {
    state_ = MotionState::kInterrupted;
    message_ = reason;
  } else if (state_ == MotionState::kTracking || (state_ == MotionState::kInterrupted && !unmoved)) {
    lose(reason);
  }
  standstill_.reset();
}

void Localizer::lose(const std::string& reason) {
  if (keeper_.tracker().state() == ScanTracker::State::kNoMap) {
    state_ = MotionState::kLost;
    message_ = "Position lost: " + reason + " Map the Car again.";
  } else {
    state_ = MotionState::kTracking;
    message_.clear();
    const bool is_mapping = keeper_.tracker().state() == ScanTracker::State::kMapping;
    keeper_.lose("Position lost: " + reason +
                 (is_mapping ? " Map the Car again." : " Searching near the last position."));
  }
}

bool Localizer::use_scans() {
  return !parameters_.lockstep && last_ && keeper_.use_sweeps(history_, standstill_.standing());
}

void Localizer::set_external(std::int64_t stamp_ns, const PoseVector& map_from_odom) {
  external_ns_ = stamp_ns;
  external_ = map_from_odom;
  keeper_.set_external(map_from_odom);
}

PoseVector Localizer::map_from_odom() const {
  if (parameters_.external) {
    return external_;
  }
  return compose(filter().pose(), relative(history_.newest().odom, PoseVector::Zero()));
}

std::string Localizer::why_not_valid(std::int64_t stamp_ns) const {
  if (state_ != MotionState::kTracking) {
    return message_;
  }
  if (parameters_.external) {
    const bool is_fresh = external_ns_ && seconds(stamp_ns - *external_ns_) <= parameters_.tracking.external_timeout_s;
    return is_fresh ? "" : "Waiting for map to odom from the other localization.";
  }
  return keeper_.tracker().lost_reason();
}

PoseMode Localizer::mode() const {
  if (state_ == MotionState::kLost || keeper_.tracker().lost()) {
    return PoseMode::kLost;
  }
  switch (keeper_.tracker().state()) {
    case ScanTracker::State::kMapping:
      return PoseMode::kMapping;
    case ScanTracker::State::kLocalized:
      return PoseMode::kLocalized;
    default:
      return parameters_.external && external_ns_ ? PoseMode::kLocalized : PoseMode::kDeadReckoning;
  }
}

Estimate Localizer::estimate_at(std::int64_t stamp_ns) const {
  Estimate estimate = refused(stamp_ns, why_not_valid(stamp_ns));
  estimate.valid = estimate.message.empty();
  estimate.degenerate = keeper_.degenerate(stamp_ns);
  estimate.speed_mps = filter().corrected_speed(last_->linear_mps);
  estimate.yaw_rate_radps = filter().corrected_rate(gyro_.rate_at(stamp_ns));
  return estimate;
}

Estimate Localizer::refused(std::int64_t stamp_ns, const std::string& message) const {
  Estimate estimate;
  estimate.stamp_ns = stamp_ns;
  estimate.mode = mode();
  estimate.map_revision = keeper_.revision();
  PoseVector pose = filter().pose();
  Eigen::Matrix3d covariance = filter().pose_covariance() + keeper_.map_covariance();
  if (parameters_.external) {
    pose = compose(external_, history_.newest().odom);
    const double position = parameters_.tracking.external_position_sigma_m;
    const double heading = parameters_.tracking.external_heading_sigma_rad;
    covariance = Eigen::Vector3d(position * position, position * position, heading * heading).asDiagonal();
  }
  estimate.x_m = pose.x();
  estimate.y_m = pose.y();
  estimate.heading_rad = pose.z();
  Eigen::Map<Eigen::Matrix3d>(estimate.covariance.data()) = covariance;
  Eigen::Map<Eigen::Vector3d>(estimate.odom.data()) = history_.newest().odom;
  if (last_) {
    estimate.wheel_odom = {last_->x_m, last_->y_m, last_->heading_rad};
  }
  estimate.message = message;
  return estimate;
}

std::vector<Estimate> Localizer::not_older_than_emitted(std::vector<Estimate> estimates) {
  // Late data after a spell of silence: it counts for the pose, but consumers have already heard of later times.
  std::vector<Estimate> newer;
  for (Estimate& estimate : estimates) {
    if (!emitted_ns_ || estimate.stamp_ns > *emitted_ns_) {
      emitted_ns_ = estimate.stamp_ns;
      newer.push_back(std::move(estimate));
    }
  }
  return newer;
}

std::int64_t Localizer::gap_limit_ns() const { return std::llround(parameters_.motion.gap_limit_s * 1e9); }

}  // namespace mtr_localization
