/// @file
/// Order, gaps and jumps of samples.
// SPDX-License-Identifier: Apache-2.0
#include "motion/input_gate.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "mtr_core/plausible.hpp"
#include "one_instant.hpp"
#include "problems.hpp"

namespace mtr_localization {
namespace {

using mtr_core::kMaxWheelsMps;

// Noise of the odometry, independent of the interval.
constexpr double kJitterM = 0.01;
// A driver on a busy machine may stamp late, so that the motion of 40 ms appears to happen in 1 ms.
constexpr double kStampedLateS = 0.05;

// This number of identical consecutive readings means a frozen sensor if the wheels move: real readings have noise.
constexpr int kFrozenSamples = 3;
constexpr double kMovesMps = 0.02;
constexpr double kTurnsRadps = 0.05;

bool is_moving(const WheelSample& wheels) {
  return std::abs(wheels.linear_mps) > kMovesMps || std::abs(wheels.angular_radps) > kTurnsRadps;
}

double seconds(std::int64_t duration_ns) { return static_cast<double>(duration_ns) * 1e-9; }

}  // namespace

InputGate::InputGate(double gap_limit_s) : gap_limit_ns_(std::llround(gap_limit_s * 1e9)) {}

void InputGate::add_imu(const ImuSample& sample) {
  if (is_frozen(sample)) {
    // A frozen sensor counts as silent.
    return;
  }
  if (!gyro_.add(sample)) {
    restart_ = problems::kImuWentBack();
  }
}

bool InputGate::is_frozen(const ImuSample& sample) {
  const bool repeats = newest_imu_ && sample.force_mps2 == newest_imu_->force_mps2 &&
                       sample.tilt_rate_radps == newest_imu_->tilt_rate_radps &&
                       sample.yaw_rate_radps == newest_imu_->yaw_rate_radps;
  imu_repeats_ = repeats ? imu_repeats_ + 1 : 0;
  newest_imu_ = sample;
  // Sensors without an accelerometer report no force; they cannot be checked.
  return imu_repeats_ >= kFrozenSamples && !sample.force_mps2.isZero(0.0) && last_used_ && is_moving(*last_used_);
}

void InputGate::add_wheels(const WheelSample& sample) {
  if (newest_wheels_ns_ && std::abs(sample.stamp_ns - *newest_wheels_ns_) <= kOneInstantNs) {
    // Duplicate message: a second step at the same time would have no duration, or only the slew of the clock.
    return;
  }
  if (newest_wheels_ns_ && sample.stamp_ns < *newest_wheels_ns_) {
    pending_.clear();
    emitted_ns_.reset();
    restart_ = problems::kWheelsWentBack();
  }
  if (is_frozen(sample)) {
    // Frozen wheels count as silent. Otherwise, scans would move the pose, and the wheels would repeat the motion
    // later.
    return;
  }
  newest_wheels_ns_ = sample.stamp_ns;
  pending_.push_back(sample);
}

bool InputGate::is_frozen(const WheelSample& sample) {
  const bool repeats = newest_wheels_ && sample.x_m == newest_wheels_->x_m && sample.y_m == newest_wheels_->y_m &&
                       sample.heading_rad == newest_wheels_->heading_rad &&
                       sample.linear_mps == newest_wheels_->linear_mps &&
                       sample.angular_radps == newest_wheels_->angular_radps;
  wheel_repeats_ = repeats ? wheel_repeats_ + 1 : 0;
  fresh_wheels_ns_ = repeats ? fresh_wheels_ns_ : sample.stamp_ns;
  newest_wheels_ = sample;
  wheels_are_frozen_ = wheel_repeats_ >= kFrozenSamples && is_moving(sample);
  return wheels_are_frozen_;
}

std::optional<GatedSample> InputGate::next() {
  if (pending_.empty()) {
    return std::nullopt;
  }
  WheelSample wheels = pending_.front();
  const std::int64_t imu_ns = gyro_.newest_received_ns().value_or(0);
  if (imu_ns < wheels.stamp_ns && wheels.stamp_ns - imu_ns <= kOneInstantNs) {
    // Without this, the sample would wait a whole period for the next IMU sample.
    wheels.stamp_ns = imu_ns;
  }
  const bool has_imu = imu_ns >= wheels.stamp_ns;
  if (!has_imu && *newest_wheels_ns_ - wheels.stamp_ns <= gap_limit_ns_) {
    return std::nullopt;
  }
  pending_.pop_front();
  GatedSample sample{wheels, has_imu ? problem_with(wheels) : problems::kImuSilent(), {}};
  if (!sample.problem) {
    const bool is_restart = static_cast<bool>(restart_);
    sample.interruption = interruption_before(wheels);
    if (sample.interruption && !is_restart) {
      sample.turn_meanwhile = turn_before(wheels);
    }
    last_used_ = wheels;
  }
  return sample;
}

std::optional<GyroTurn> InputGate::turn_before(const WheelSample& wheels) const {
  const std::int64_t from_ns = last_used_->stamp_ns;
  if (from_ns >= wheels.stamp_ns || !gyro_.covers(from_ns) ||
      gyro_.max_gap_ns(from_ns, wheels.stamp_ns) > gap_limit_ns_) {
    return std::nullopt;
  }
  return GyroTurn{seconds(wheels.stamp_ns - from_ns), gyro_.integral(from_ns, wheels.stamp_ns)};
}

mtr_core::Problem InputGate::problem_with(const WheelSample& wheels) const {
  if (!wheels.is_plausible()) {
    return problems::kWheelsNotFinite();
  }
  if (!gyro_.covers(wheels.stamp_ns)) {
    return gyro_.newest_is_good() ? problems::kWaitingForImu() : problems::kImuNotANumber();
  }
  return {};
}

mtr_core::Problem InputGate::interruption_before(const WheelSample& wheels) {
  mtr_core::Problem restart = std::exchange(restart_, {});
  if (restart || !last_used_) {
    return restart;
  }
  const std::int64_t wheel_gap_ns = wheels.stamp_ns - last_used_->stamp_ns;
  if (wheel_gap_ns > gap_limit_ns_) {
    return problems::kWheelsWereSilent({{"gap_s", seconds(wheel_gap_ns)}});
  }
  const std::int64_t imu_gap_ns = gyro_.max_gap_ns(last_used_->stamp_ns, wheels.stamp_ns);
  if (imu_gap_ns > gap_limit_ns_) {
    return problems::kImuWasSilent({{"gap_s", seconds(imu_gap_ns)}});
  }
  const double distance_m = std::hypot(wheels.x_m - last_used_->x_m, wheels.y_m - last_used_->y_m);
  const double speed_mps = std::max(std::abs(last_used_->linear_mps), std::abs(wheels.linear_mps));
  // A larger distance means that the odometry was reset.
  if (distance_m >
      kMaxWheelsMps * seconds(wheel_gap_ns) + std::min(speed_mps, kMaxWheelsMps) * kStampedLateS + kJitterM) {
    return problems::kWheelsJumped({{"distance_m", distance_m}});
  }
  return {};
}

mtr_core::Problem InputGate::silence(std::int64_t now_ns) const {
  if (!newest_wheels_ns_) {
    return problems::kWaitingForWheels();
  }
  // For frozen wheels, the silence includes the repetitions before they were detected.
  const std::int64_t since_ns = wheels_are_frozen_ ? fresh_wheels_ns_ : *newest_wheels_ns_;
  return now_ns - since_ns > gap_limit_ns_ ? problems::kWheelsSilent() : mtr_core::Problem{};
}

std::vector<Estimate> InputGate::in_order(std::vector<Estimate> estimates) {
  std::vector<Estimate> newer;
  for (Estimate& estimate : estimates) {
    if (!emitted_ns_ || estimate.stamp_ns > *emitted_ns_) {
      emitted_ns_ = estimate.stamp_ns;
      newer.push_back(std::move(estimate));
    }
  }
  return newer;
}

}  // namespace mtr_localization
