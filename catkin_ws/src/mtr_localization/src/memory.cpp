/// @file
/// Motion by wheel odometry during a restart of localization.
// SPDX-License-Identifier: Apache-2.0
#include "memory.hpp"

#include <Eigen/Geometry>
#include <cmath>
#include <cstdlib>

namespace mtr_localization {
namespace {

constexpr std::int64_t kKeepEveryNs = 500'000'000;
// When localization ends, the robot brakes within 0.5 m, and the stored pose is at most 0.5 s old. At 1.5 rad/s it
// turns by up to 0.9 rad: 0.3 s until the silence is detected, 0.1 s until it brakes.
constexpr double kMaxLedM = 1.0;
constexpr double kMaxLedRad = 1.0;
// A larger difference between the turns of wheels and gyro means slip.
constexpr double kMaxSlippedRad = 0.5;
// Wheels measure a distance to a few percent, but on four skidding wheels a turn only to about half of it.
constexpr double kPositionSigmaM = 0.02;
constexpr double kPositionSigmaPerM = 0.1;
constexpr double kHeadingSigmaRad = 0.01;
constexpr double kHeadingSigmaPerRad = 0.5;

double square(double value) { return value * value; }

}  // namespace

bool is_due(std::int64_t stamp_ns, std::int64_t kept_ns) { return std::abs(stamp_ns - kept_ns) >= kKeepEveryNs; }

std::optional<RememberedPose> led_by_wheels(const RememberedPose& from, const std::array<double, 3>& wheel_odom,
                                            std::optional<double> seen_turn_rad) {
  const Eigen::Map<const PoseVector> before(from.wheel_odom.data());
  const Eigen::Map<const PoseVector> now(wheel_odom.data());
  PoseVector way = relative(before, now);
  const double distance_m = way.head<2>().norm();
  // Part of the turn that only the wheels report: the whole turn, or the excess over the gyro.
  const double slipped_rad = wrapped(way.z() - seen_turn_rad.value_or(0.0));
  const double most_rad = seen_turn_rad ? kMaxSlippedRad : kMaxLedRad;
  // The negated form also rejects NaN.
  if (!(distance_m <= kMaxLedM && std::abs(slipped_rad) <= most_rad)) {
    return std::nullopt;
  }
  double aside_m = 0.0;
  double heading_sigma_rad = kHeadingSigmaRad + kHeadingSigmaPerRad * std::abs(slipped_rad);
  if (seen_turn_rad) {
    // The chord of an arc points half of its turn sideways, so the wheel slip rotates it by half; the sigma is as
    // large.
    way.head<2>() = Eigen::Rotation2Dd(-0.5 * slipped_rad) * way.head<2>().eval();
    way.z() = wrapped(*seen_turn_rad);
    aside_m = 0.5 * std::abs(slipped_rad) * distance_m;
    heading_sigma_rad = kHeadingSigmaRad;
  }
  RememberedPose led{compose(from.pose, way), from.covariance, wheel_odom};
  const double position = square(kPositionSigmaM + kPositionSigmaPerM * distance_m) + square(aside_m);
  led.covariance.diagonal() += Eigen::Vector3d(position, position, square(heading_sigma_rad));
  return led;
}

}  // namespace mtr_localization
