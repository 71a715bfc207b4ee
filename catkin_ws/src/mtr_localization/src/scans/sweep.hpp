/// @file
/// One turn of a LiDAR as received from the sensor.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "map_names.hpp"

namespace mtr_localization {

/// Index as in ScanPoint.
enum class Lidar { kFront = 0, kRear = 1 };

/// Ranges of one turn; a value that is not finite or not within the limits is not a return.
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
  /// Time from the start of this sweep to the start of the next one.
  double scan_time_s = 0.0;
  double range_min_m = 0.0;
  double range_max_m = 0.0;
  std::vector<float> ranges_m;

  /// Sets the time between beams if the scan does not state it.
  void time_beams(double increment_s) { time_increment_s = time_increment_s == 0.0 ? increment_s : time_increment_s; }

  std::int64_t beam_ns(std::size_t beam) const;
  std::int64_t last_beam_ns() const { return ranges_m.empty() ? stamp_ns : beam_ns(ranges_m.size() - 1); }
  /// Time at which a continuously rotating LiDAR has sent the sweep.
  std::int64_t end_ns() const;

  /// False if no beam has a range: the LiDAR is covered, dazzled or broken, or nothing is within its range.
  bool says_anything() const;

  /// Returns one sentence about an error in the header; empty if the sweep is usable.
  std::string problem() const;
};

/// Sweeps of front and rear LiDAR that belong to one step of the filter.
struct ScanSet {
  std::vector<Sweep> sweeps;
  /// Index of the step in the filter's history.
  std::size_t step = 0;
};

}  // namespace mtr_localization
