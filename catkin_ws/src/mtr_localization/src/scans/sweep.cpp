/// @file
/// Times of the beams of a sweep, and consistency of its header.
// SPDX-License-Identifier: Apache-2.0
#include "scans/sweep.hpp"

#include <algorithm>
#include <cmath>

namespace mtr_localization {
namespace {

// A turn of the slowest supported LiDAR lasts 0.2 s.
constexpr double kMaxSweepS = 0.25;

bool all_finite(const Sweep& sweep) {
  for (const double value : {sweep.angle_min_rad, sweep.angle_max_rad, sweep.angle_increment_rad,
                             sweep.time_increment_s, sweep.scan_time_s, sweep.range_min_m, sweep.range_max_m}) {
    if (!std::isfinite(value)) {
      return false;
    }
  }
  return sweep.mount.allFinite() && std::isfinite(sweep.mount_height_m);
}

std::int64_t nanoseconds(double duration_s) { return std::llround(duration_s * 1e9); }

}  // namespace

std::int64_t Sweep::beam_ns(std::size_t beam) const {
  return stamp_ns + nanoseconds(static_cast<double>(beam) * time_increment_s);
}

std::int64_t Sweep::end_ns() const { return std::max(stamp_ns + nanoseconds(scan_time_s), last_beam_ns()); }

bool Sweep::says_anything() const {
  return std::any_of(ranges_m.begin(), ranges_m.end(), [this](float range_m) {
    return range_m > 0.0F && range_m >= range_min_m && range_m <= range_max_m;
  });
}

std::string Sweep::problem() const {
  if (!all_finite(*this)) {
    return "A scan's angles, times or range limits are not finite; correct the settings of its driver.";
  }
  if (ranges_m.size() < 2) {
    return "A scan has fewer than two beams; look for the fault in the LiDAR or its driver.";
  }
  if (std::abs(angle_increment_rad) < 1e-6 || range_max_m <= range_min_m) {
    return "A scan's angle_increment is zero, or its range_max is not above range_min; correct the settings of its "
           "driver.";
  }
  const double span = static_cast<double>(ranges_m.size() - 1) * angle_increment_rad;
  // Some drivers compute angle_max in single precision, or one increment too far.
  if (std::abs(angle_min_rad + span - angle_max_rad) > 1.5 * std::abs(angle_increment_rad)) {
    return "A scan's number of beams contradicts its angles; correct angle_min, angle_max or angle_increment in its "
           "driver.";
  }
  if (time_increment_s < 0.0 || scan_time_s < 0.0 || static_cast<double>(end_ns() - stamp_ns) * 1e-9 > kMaxSweepS) {
    return "A scan lasts less than 0 s or more than 0.25 s; its scan_time and time_increment must be in seconds.";
  }
  return "";
}

}  // namespace mtr_localization
