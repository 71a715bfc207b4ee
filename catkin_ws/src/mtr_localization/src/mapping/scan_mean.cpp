/// @file
/// Mean of each beam, without scans in which an object passed.
// SPDX-License-Identifier: Apache-2.0
#include "mapping/scan_mean.hpp"

#include <algorithm>
#include <cmath>

#include "mtr_core/sensor_figures.hpp"

namespace mtr_localization {
namespace {

// Half the angle between beams of such a LiDAR, 0.25 to 0.5 degrees; a stationary robot turns less.
constexpr double kBeamRad = 0.003;
// Half the distance between the two LiDARs of a robot.
constexpr double kLidarM = 0.1;
// Ranges of one surface are within this of their median: 5 sigma of a LiDAR with 20 mm noise.
constexpr double kSameSurfaceM = 5.0 * mtr_core::sensor_figures::kWorstRangeNoiseM.value;

}  // namespace

void ScanMean::clear() {
  scans_ = 0;
  beams_.clear();
}

void ScanMean::add(const ScanPoints& scan) {
  ++scans_;
  stamp_ns_ = scan.stamp_ns;
  for (const ScanPoint& point : scan.points) {
    beams_[beam_of(point)].push_back(point);
  }
}

ScanMean::Beam ScanMean::beam_of(const ScanPoint& point) {
  const double start_m = (point.position - point.range_m * point.direction).x();
  const double angle_rad = std::atan2(point.direction.y(), point.direction.x());
  return {std::llround(start_m / kLidarM), std::llround(angle_rad / kBeamRad)};
}

ScanPoints ScanMean::mean() const {
  ScanPoints scan;
  scan.stamp_ns = stamp_ns_;
  for (const auto& [beam, points] : beams_) {
    std::vector<double> ranges;
    for (const ScanPoint& point : points) {
      ranges.push_back(point.range_m);
    }
    const auto middle = ranges.begin() + static_cast<std::ptrdiff_t>(ranges.size() / 2);
    std::nth_element(ranges.begin(), middle, ranges.end());
    ScanPoint sum{Eigen::Vector2d::Zero(), Eigen::Vector2d::Zero(), 0.0};
    double count = 0.0;
    for (const ScanPoint& point : points) {
      if (std::abs(point.range_m - *middle) < kSameSurfaceM) {
        sum.position += point.position;
        sum.direction += point.direction;
        sum.range_m += point.range_m;
        sum.rise_m += point.rise_m;
        ++count;
      }
    }
    if (2.0 * count >= scans_) {
      scan.points.push_back({sum.position / count, sum.direction.normalized(), sum.range_m / count, sum.rise_m / count,
                             points.front().lidar});
    }
  }
  return scan;
}

}  // namespace mtr_localization
