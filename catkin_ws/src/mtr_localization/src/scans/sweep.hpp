/// @file
/// One turn of a LiDAR as it comes from the sensor.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "map_names.hpp"

namespace mtr_localization {

/// Numbered as in ScanPoint.
enum class Lidar { kFront = 0, kRear = 1 };

/// Ranges of one turn; what is no finite number within the limits is no return.
struct Sweep {
  Lidar lidar = Lidar::kFront;
  /// Time of the first beam.
  std::int64_t stamp_ns = 0;
  /// Pose of the LiDAR in base_link.
  PoseVector mount = PoseVector::Zero();
  /// Height of the LiDAR above base_link.
  double mount_height_m = 0.0;
  double angle_min_rad = 0.0;
  double angle_max_rad = 0.0;
  double angle_increment_rad = 0.0;
  double time_increment_s = 0.0;
  /// Time from this sweep's start to the next one's.
  double scan_time_s = 0.0;
  double range_min_m = 0.0;
  double range_max_m = 0.0;
  std::vector<float> ranges_m;

  /// From beam to beam, where the scan does not say it.
  void time_beams(double increment_s) { time_increment_s = time_increment_s == 0.0 ? increment_s : time_increment_s; }

  std::int64_t beam_ns(std::size_t beam) const;
  std::int64_t last_beam_ns() const { return ranges_m.empty() ? stamp_ns : beam_ns(ranges_m.size() - 1); }
  /// Time at which a LiDAR that turns without a break has sent it.
  std::int64_t end_ns() const;

  /// False when no beam has measured a range: the LiDAR is covered, dazzled or broken, or nothing is in its reach.
  bool says_anything() const;

  /// One sentence on what is wrong with its header; empty when it can be used.
  std::string problem() const;
};

/// Sweeps of the front and the rear LiDAR that hold at one step of the filter.
struct ScanSet {
  std::vector<Sweep> sweeps;
  /// Index of the step in the filter's history.
  std::size_t step = 0;
};

}  // namespace mtr_localization
