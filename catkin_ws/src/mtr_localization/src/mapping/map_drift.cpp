/// @file
/// Propagation of the drift of the growing map.
// SPDX-License-Identifier: Apache-2.0
#include "mapping/map_drift.hpp"

#include <cmath>

namespace mtr_localization {
namespace {

double square(double value) { return value * value; }

}  // namespace

MapDrift::MapDrift(const Parameters& parameters)
    : per_metre_(square(parameters.mapping.mapping_drift_m_per_sqrt_m),
                 square(parameters.mapping.mapping_drift_m_per_sqrt_m),
                 square(parameters.mapping.mapping_drift_rad_per_sqrt_m)),
      // The gyro places new surfaces first, so their matches keep its error.
      heading_per_second_(square(parameters.sensors.gyro_noise_radps_per_sqrt_hz)) {}

void MapDrift::travel(const Motion& motion, double heading_rad) {
  Eigen::Matrix3d from_before = Eigen::Matrix3d::Identity();
  from_before(0, 2) = -std::sin(heading_rad) * motion.distance_m;
  from_before(1, 2) = std::cos(heading_rad) * motion.distance_m;
  covariance_ = from_before * covariance_ * from_before.transpose();
  covariance_.diagonal() += std::abs(motion.distance_m) * per_metre_;
  covariance_(2, 2) += motion.duration_s * heading_per_second_;
}

}  // namespace mtr_localization
