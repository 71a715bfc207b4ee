/// @file
/// The way that the wheels went while nobody listened.
// SPDX-License-Identifier: Apache-2.0
#include "memory.hpp"

#include <cmath>

namespace mtr_localization {
namespace {

// A robot whose localization ends brakes within 0.5 m, and at most half a second passes since the pose was kept.
constexpr double kMaxLedM = 1.0;
constexpr double kMaxLedRad = 0.5;
// Wheels tell a way to some percent, but a turn on four wheels that slip sideways only to a half of it.
constexpr double kPositionSigmaM = 0.02;
constexpr double kPositionSigmaPerM = 0.1;
constexpr double kHeadingSigmaRad = 0.01;
constexpr double kHeadingSigmaPerRad = 0.5;

double square(double value) { return value * value; }

}  // namespace

std::optional<RememberedPose> led_by_wheels(const RememberedPose& from, const std::array<double, 3>& wheel_odom) {
  const Eigen::Map<const PoseVector> before(from.wheel_odom.data());
  const Eigen::Map<const PoseVector> now(wheel_odom.data());
  const PoseVector way = relative(before, now);
  const double distance_m = way.head<2>().norm();
  const double turn_rad = std::abs(wrapped(way.z()));
  // Written so that what is no number is no way either.
  if (!(distance_m <= kMaxLedM && turn_rad <= kMaxLedRad)) {
    return std::nullopt;
  }
  RememberedPose led{compose(from.pose, way), from.covariance, wheel_odom};
  const double position = square(kPositionSigmaM + kPositionSigmaPerM * distance_m);
  const double heading = square(kHeadingSigmaRad + kHeadingSigmaPerRad * turn_rad);
  led.covariance.diagonal() += Eigen::Vector3d(position, position, heading);
  return led;
}

}  // namespace mtr_localization
