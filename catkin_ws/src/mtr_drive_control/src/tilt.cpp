/// @file
/// Estimate of the tilt and its limits.
// SPDX-License-Identifier: Apache-2.0
#include "mtr_drive_control/tilt.hpp"

#include <algorithm>
#include <cmath>

#include "mtr_core/steady_time.hpp"
#include "problems.hpp"

namespace mtr_drive_control {
namespace {

constexpr double kGravityMps2 = 9.81;
constexpr double kPi = 3.14159265358979323846;
// Averaging time of the accelerometer, in s. A change of speed by 1 m/s that the wheels do not show tilts the estimate
// by 1 / (9.81 * 3), which is 1.9 deg; a gyro whose bias has changed by 0.2 deg/s tilts it by 0.6 deg.
constexpr double kPullS = 3.0;
// Weight of the first reading in this mean, in s, so that a start of the wheels right after it does not count as a
// tilt.
constexpr double kFirstS = 0.2;
// A wheel on a cable or joint tilts the robot for less than this, in s.
constexpr double kJoltS = 0.25;
// Tolerance of gravity's magnitude, in m/s2: braking at 2.5 m/s2 changes it by 0.3, and a unit of g instead of m/s2 is
// far outside.
constexpr double kGravityToleranceMps2 = 2.0;
// Without such a reading for this time, in s, the tilt is unknown; jolts of rough ground are shorter.
constexpr double kUnseenS = 0.5;
// After a longer pause, in s, the gyro has missed rotation.
constexpr double kPauseS = 0.3;
// A base of this class accelerates by less; more is a jump of the odometry.
constexpr double kMostWheelsMps2 = 4.0;
// Limits of stopped wheels, as in motion_watch.cpp.
constexpr double kStandsMps = 0.0125;
constexpr double kStandsRadps = 0.0375;
// Averaging time of the gyro's bias while the wheels are stopped, in s; an uncalibrated MEMS gyro has less than 3
// deg/s.
constexpr double kBiasS = 2.0;
constexpr double kMostBiasRadps = 0.052;
// Hysteresis of the release: 1 deg, more than the robot pitches in braking.
constexpr double kHysteresisRad = 0.01745;

Vector3 unit(const Vector3& vector) {
  const double size = std::sqrt(vector.x * vector.x + vector.y * vector.y + vector.z * vector.z);
  return {vector.x / size, vector.y / size, vector.z / size};
}

Vector3 between(const Vector3& from, const Vector3& to, double share) {
  return {from.x + share * (to.x - from.x), from.y + share * (to.y - from.y), from.z + share * (to.z - from.z)};
}

/// Weight of a new reading in a mean over filter_s, of which used_s have been filled.
double share_of(double step_s, double used_s, double filter_s) {
  return std::min(1.0, step_s / std::min(filter_s, used_s + step_s));
}

/// Direction of gravity in a reading; empty if the reading does not show it.
std::optional<Vector3> gravity_in(const ImuReading& imu, const Vector3& acceleration) {
  const Vector3 force{imu.forces_mps2[0] - acceleration.x, imu.forces_mps2[1] - acceleration.y, imu.forces_mps2[2]};
  const double size = std::sqrt(force.x * force.x + force.y * force.y + force.z * force.z);
  const bool is_gravity = std::abs(size - kGravityMps2) <= kGravityToleranceMps2;
  return is_gravity ? std::optional<Vector3>(unit(force)) : std::nullopt;
}

bool stand(const Velocity& wheels) {
  return std::abs(wheels.linear_mps) <= kStandsMps && std::abs(wheels.angular_radps) <= kStandsRadps;
}

}  // namespace

void GravityEstimate::take(const ImuReading& imu, const std::optional<Velocity>& wheels) {
  if (!imu.is_plausible() || (stamp_ns_ && imu.stamp_ns == *stamp_ns_)) {
    return;
  }
  const double step_s = stamp_ns_ ? static_cast<double>(imu.stamp_ns - *stamp_ns_) * 1e-9 : -1.0;
  if (!seen_ns_ || step_s < 0.0 || step_s > kPauseS) {
    restart(imu, wheels);
    return;
  }
  const Vector3 acceleration = acceleration_of(imu, wheels, step_s);
  learn_bias(imu, wheels, step_s);
  turn(imu, step_s);
  pull(imu, acceleration, step_s);
  smooth_up_ = unit(between(smooth_up_, up_, share_of(step_s, pulled_s_, kJoltS)));
  stamp_ns_ = imu.stamp_ns;
  wheels_ = wheels;
}

void GravityEstimate::restart(const ImuReading& imu, const std::optional<Velocity>& wheels) {
  stamp_ns_ = imu.stamp_ns;
  wheels_ = wheels;
  pulled_s_ = kFirstS;
  seen_ns_ = std::nullopt;
  if (const std::optional<Vector3> up = gravity_in(imu, {})) {
    seen_ns_ = imu.stamp_ns;
    up_ = smooth_up_ = *up;
  }
}

Vector3 GravityEstimate::acceleration_of(const ImuReading& imu, const std::optional<Velocity>& wheels,
                                         double step_s) const {
  if (!wheels || !wheels_) {
    return {};
  }
  const double along = (wheels->linear_mps - wheels_->linear_mps) / step_s;
  const double across = wheels->linear_mps * imu.yaw_rate_radps();
  return {std::clamp(along, -kMostWheelsMps2, kMostWheelsMps2), std::clamp(across, -kMostWheelsMps2, kMostWheelsMps2),
          0.0};
}

void GravityEstimate::learn_bias(const ImuReading& imu, const std::optional<Velocity>& wheels, double step_s) {
  const bool is_quiet =
      std::abs(imu.rates_radps[0]) <= kMostBiasRadps && std::abs(imu.rates_radps[1]) <= kMostBiasRadps;
  if (!wheels || !stand(*wheels) || !is_quiet) {
    return;
  }
  const Vector3 rate{imu.rates_radps[0], imu.rates_radps[1], 0.0};
  bias_radps_ = between(bias_radps_, rate, share_of(step_s, rested_s_, kBiasS));
  rested_s_ = std::min(kBiasS, rested_s_ + step_s);
}

void GravityEstimate::turn(const ImuReading& imu, double step_s) {
  // The world's vertical turns against the body: the rate of up is up x rate.
  const double x = (imu.rates_radps[0] - bias_radps_.x) * step_s;
  const double y = (imu.rates_radps[1] - bias_radps_.y) * step_s;
  const double z = imu.rates_radps[2] * step_s;
  up_ = unit({up_.x + up_.y * z - up_.z * y, up_.y + up_.z * x - up_.x * z, up_.z + up_.x * y - up_.y * x});
}

void GravityEstimate::pull(const ImuReading& imu, const Vector3& acceleration, double step_s) {
  if (const std::optional<Vector3> up = gravity_in(imu, acceleration)) {
    seen_ns_ = imu.stamp_ns;
    up_ = unit(between(up_, *up, share_of(step_s, pulled_s_, kPullS)));
    pulled_s_ = std::min(kPullS, pulled_s_ + step_s);
  }
}

std::optional<double> GravityEstimate::tilt_at(std::int64_t tick_ns) const {
  if (!seen_ns_ || !mtr_core::is_fresh(*seen_ns_, tick_ns, kUnseenS)) {
    return std::nullopt;
  }
  return std::atan2(std::hypot(smooth_up_.x, smooth_up_.y), smooth_up_.z);
}

void TiltWatch::take(std::int64_t tick_ns, const std::optional<ImuReading>& imu,
                     const std::optional<Velocity>& wheels) {
  if (imu) {
    gravity_.take(*imu, wheels);
  }
  const std::optional<double> tilt_rad = gravity_.tilt_at(tick_ns);
  is_known_ = tilt_rad.has_value();
  tilt_rad_ = tilt_rad.value_or(tilt_rad_);
  is_tilted_ = tilt_rad_ >= parameters_.tilt_stop_rad - (is_tilted_ ? kHysteresisRad : 0.0);
}

Limits TiltWatch::limits_at(double key_height_m) const {
  const double held_rad = is_tilted_ ? std::max(tilt_rad_, parameters_.tilt_stop_rad) : tilt_rad_;
  return mtr_drive_control::limits_at(parameters_, key_height_m, held_rad);
}

mtr_core::Problem TiltWatch::problem(const Limits& limits, bool by_hand) const {
  if (!is_known_) {
    return problems::kTiltUnknown();
  }
  if (!is_tilted_) {
    return {};
  }
  const bool has_reserve = limits.max_linear_mps >= parameters_.tilt_creep_mps;
  if (!has_reserve) {
    return problems::kTiltedTooFar({{"tilt_deg", tilt_rad_ * 180.0 / kPi}});
  }
  return by_hand ? mtr_core::Problem{} : warning();
}

mtr_core::Problem TiltWatch::warning() const {
  if (!is_tilted_) {
    return {};
  }
  return problems::kTilted(
      {{"tilt_deg", tilt_rad_ * 180.0 / kPi}, {"most_deg", parameters_.tilt_stop_rad * 180.0 / kPi}});
}

}  // namespace mtr_drive_control
