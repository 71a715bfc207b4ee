/// @file
/// Dead reckoning with an answer to every fault of the sensors' data.
// SPDX-License-Identifier: Apache-2.0
#include "mtr_localization/localizer.hpp"

#include <cmath>
#include <cstdio>
#include <utility>

namespace mtr_localization {
namespace {

// Faster than any base of this class: such an odometry was reset, not driven.
constexpr double kFastestWheelsMps = 3.0;
// Wheel motion over an interruption up to which the robot is taken not to have moved.
constexpr double kUnmovedM = 0.01;
constexpr double kUnmovedRad = 0.02;
// Gyro rate at rest up to which it can be a bias, rad/s: 4 sigma of the bias at switch-on.
constexpr double kLargestBiasRadps = 0.2;

double seconds(std::int64_t duration_ns) { return static_cast<double>(duration_ns) * 1e-9; }

std::string with_number(const char* format, double number) {
  char text[120];
  std::snprintf(text, sizeof(text), format, number);
  return text;
}

}  // namespace

Localizer::Localizer(const Parameters& parameters)
    : parameters_(parameters), reckoning_(parameters), standstill_(parameters) {
  check(parameters);
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
    interruption = interruption_between(*last_, wheels);
  }
  if (last_ && !interruption.empty()) {
    interrupt(interruption, wheels);
  } else if (last_) {
    advance(wheels);
  }
  last_ = wheels;
  gyro_.forget_before(wheels.stamp_ns);
  return estimate_at(wheels.stamp_ns);
}

void Localizer::advance(const WheelSample& wheels) {
  const double duration_s = seconds(wheels.stamp_ns - last_->stamp_ns);
  const double gyro_rate = gyro_.rate_at(wheels.stamp_ns);
  standstill_.update(wheels, rate_for_standstill(gyro_rate));
  if (mode_ == Mode::kLost) {
    return;
  }
  if (mode_ == Mode::kInterrupted && !standstill_.resting()) {
    lose(message_);
  } else if (standstill_.standing()) {
    reckoning_.stand(duration_s, gyro_rate);
  } else if (mode_ == Mode::kTracking) {
    reckoning_.move({duration_s, wheels.distance_since(*last_), gyro_.integral(last_->stamp_ns, wheels.stamp_ns)});
  }
  if (mode_ != Mode::kLost && standstill_.standing_s() >= parameters_.bias_time_s) {
    mode_ = Mode::kTracking;
    message_.clear();
  }
}

double Localizer::rate_for_standstill(double gyro_rate_radps) const {
  // As long as the bias is unknown, only a rate beyond any bias betrays a turn.
  const bool bias_unknown = mode_ == Mode::kStarting && std::abs(gyro_rate_radps) <= kLargestBiasRadps;
  return bias_unknown ? 0.0 : reckoning_.corrected_rate(gyro_rate_radps);
}

std::string Localizer::interruption_between(const WheelSample& last, const WheelSample& wheels) const {
  const std::int64_t wheel_gap_ns = wheels.stamp_ns - last.stamp_ns;
  if (wheel_gap_ns > gap_limit_ns()) {
    return with_number("Wheel odometry was silent for %.2f s.", seconds(wheel_gap_ns));
  }
  const std::int64_t imu_gap_ns = gyro_.longest_gap_ns(last.stamp_ns, wheels.stamp_ns);
  if (imu_gap_ns > gap_limit_ns()) {
    return with_number("The IMU was silent for %.2f s.", seconds(imu_gap_ns));
  }
  const double distance_m = std::hypot(wheels.x_m - last.x_m, wheels.y_m - last.y_m);
  if (distance_m > kFastestWheelsMps * seconds(wheel_gap_ns) + kUnmovedM) {
    return with_number("Wheel odometry jumped by %.2f m.", distance_m);
  }
  return "";
}

void Localizer::interrupt(const std::string& reason, const WheelSample& wheels) {
  const double moved_m = std::hypot(wheels.x_m - last_->x_m, wheels.y_m - last_->y_m);
  const double turned_rad = std::remainder(wheels.heading_rad - last_->heading_rad, 2.0 * M_PI);
  const bool unmoved = moved_m <= kUnmovedM && std::abs(turned_rad) <= kUnmovedRad;
  if (mode_ == Mode::kTracking && standstill_.standing() && unmoved) {
    mode_ = Mode::kInterrupted;
    message_ = reason;
  } else if (mode_ == Mode::kTracking || (mode_ == Mode::kInterrupted && !unmoved)) {
    lose(reason);
  }
  standstill_.reset();
}

void Localizer::lose(const std::string& reason) {
  mode_ = Mode::kLost;
  message_ = "Position lost: " + reason + " Restart the robot's software and map the Car again.";
}

Estimate Localizer::estimate_at(std::int64_t stamp_ns) const {
  Estimate estimate = refused(stamp_ns, message_);
  estimate.valid = mode_ == Mode::kTracking;
  estimate.speed_mps = reckoning_.corrected_speed(last_->linear_mps);
  estimate.yaw_rate_radps = reckoning_.corrected_rate(gyro_.rate_at(stamp_ns));
  return estimate;
}

Estimate Localizer::refused(std::int64_t stamp_ns, const std::string& message) const {
  Estimate estimate;
  estimate.stamp_ns = stamp_ns;
  estimate.x_m = reckoning_.x_m();
  estimate.y_m = reckoning_.y_m();
  estimate.heading_rad = reckoning_.heading_rad();
  estimate.covariance = reckoning_.pose_covariance();
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

std::int64_t Localizer::gap_limit_ns() const { return std::llround(parameters_.gap_limit_s * 1e9); }

}  // namespace mtr_localization
