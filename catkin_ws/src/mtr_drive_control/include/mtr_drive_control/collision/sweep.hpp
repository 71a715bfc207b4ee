/// @file
/// One turn of a LiDAR, and the faults that it shows by itself.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "mtr_core/problem.hpp"
#include "mtr_drive_control/geometry.hpp"

namespace mtr_drive_control {

/// Ranges in m by angle in the LiDAR's frame; REP-117: +inf nothing in range, -inf too near, NaN no measurement.
struct Sweep {
  /// Time of the first beam.
  std::int64_t stamp_ns;
  double angle_min_rad;
  double angle_increment_rad;
  double time_increment_s;
  double range_min_m;
  double range_max_m;
  std::vector<float> ranges_m;
  /// Frame that the LiDAR reports, and the expected one.
  std::string frame_id;
  std::string expected_frame_id;
  /// Duration of one turn; 0 if the driver does not state it.
  double scan_time_s = 0.0;

  /// Time of a beam, or of an instant between two of them.
  std::int64_t time_ns(double beam) const {
    return stamp_ns + static_cast<std::int64_t>(1e9 * time_increment_s * beam);
  }
  double angle_of(std::size_t beam) const { return angle_min_rad + angle_increment_rad * static_cast<double>(beam); }
  bool is_echo(std::size_t beam) const { return ranges_m[beam] >= range_min_m && ranges_m[beam] <= range_max_m; }
  /// Nothing in range: the path of the beam is free.
  bool is_far(std::size_t beam) const { return ranges_m[beam] > range_max_m; }
  /// Object nearer than the measuring range. Drivers without REP-117 report zero for no measurement.
  bool is_near(std::size_t beam) const { return ranges_m[beam] < range_min_m && ranges_m[beam] != 0.0F; }
};

/// Reason why the sweep cannot be used, as the end of a sentence about the LiDAR; empty if it can.
mtr_core::Problem defect_of(const Sweep& sweep, const std::string& lidar);

/// Detects a LiDAR that is silent, frozen or covered.
class LidarWatch {
 public:
  LidarWatch(std::string name, double timeout_s) : name_(std::move(name)), timeout_s_(timeout_s) {}

  /// Accepts the newest sweep at a tick, null before the first; returns true if it is new and valid.
  bool take(const std::shared_ptr<const Sweep>& sweep);

  /// One sentence if it is blind now, else empty.
  mtr_core::Problem problem_at(std::int64_t tick_ns) const;

  const std::string& name() const { return name_; }

 private:
  bool repeats(const Sweep& sweep) const;

  std::string name_;
  double timeout_s_;
  std::shared_ptr<const Sweep> newest_;
  mtr_core::Problem defect_;
  bool has_wrong_times_ = false;
  int repetitions_ = 0;
};

}  // namespace mtr_drive_control
