/// @file
/// Bearings of points in a sweep.
// SPDX-License-Identifier: Apache-2.0
#include "mtr_drive_control/collision/view.hpp"

#include <algorithm>
#include <cmath>

namespace mtr_drive_control {
namespace {

constexpr double kPi = 3.14159265358979323846;
// The direction depends on the beam's time, which depends on the direction: twice is exact to a hundredth of a beam.
constexpr int kRefinements = 2;

}  // namespace

View::View(const Sweep& sweep, const LidarMount& mount, const Motion& motion, std::vector<double> returned_m)
    : stamp_ns_(sweep.stamp_ns),
      angle_min_rad_(sweep.angle_min_rad),
      angle_increment_rad_(sweep.angle_increment_rad),
      time_increment_s_(sweep.time_increment_s),
      range_min_m_(sweep.range_min_m),
      range_max_m_(sweep.range_max_m),
      mount_(mount),
      motion_(motion),
      returned_m_(std::move(returned_m)) {}

double View::angle_rad(std::size_t beam) const {
  return angle_min_rad_ + angle_increment_rad_ * static_cast<double>(beam);
}

double View::angle_in_base_rad(std::size_t beam) const {
  return std::remainder(mount_.yaw_rad + angle_rad(beam), 2.0 * kPi);
}

std::optional<std::size_t> View::beam_at(double angle_rad) const {
  const double middle_rad = View::angle_rad(beams() / 2);
  const double from_middle = std::remainder(angle_rad - middle_rad, 2.0 * kPi) / angle_increment_rad_;
  const double beam = std::round(static_cast<double>(beams() / 2) + from_middle);
  return beam >= 0.0 && beam < static_cast<double>(beams()) ? std::optional<std::size_t>(static_cast<std::size_t>(beam))
                                                            : std::nullopt;
}

std::optional<Bearing> View::bearing_of(const Point& point) const {
  std::optional<Bearing> bearing;
  double beam = 0.5 * static_cast<double>(beams());
  for (int i = 0; i < kRefinements; ++i) {
    const auto beam_ns = stamp_ns_ + static_cast<std::int64_t>(1e9 * time_increment_s_ * beam);
    const Point in_base = motion_.at(beam_ns).undo(point);
    const double dx = in_base.x_m - mount_.x_m;
    const double dy = in_base.y_m - mount_.y_m;
    const std::optional<std::size_t> found = beam_at(std::atan2(dy, dx) - mount_.yaw_rad);
    if (!found) {
      return std::nullopt;
    }
    bearing = Bearing{*found, std::hypot(dx, dy)};
    beam = static_cast<double>(*found);
  }
  return bearing;
}

Evidence View::evidence_at(const Bearing& bearing, double tolerance_m, double tolerance_rad) const {
  const auto reach = std::max<std::size_t>(1, static_cast<std::size_t>(std::lround(tolerance_rad / step_rad())));
  const std::size_t first = bearing.beam - std::min(bearing.beam, reach);
  const std::size_t last = std::min(bearing.beam + reach, beams() - 1);
  double nearest_m = kInfinity;
  double farthest_m = 0.0;
  for (std::size_t beam = first; beam <= last; ++beam) {
    const double range_m = returned_m_[beam];
    if (range_m > 0.0 && range_m < kInfinity) {
      nearest_m = std::min(nearest_m, range_m);
      farthest_m = std::max(farthest_m, range_m);
    }
  }
  // On a surface that is met at a flat angle the ranges of neighbouring beams differ much.
  if (nearest_m - tolerance_m <= bearing.range_m && bearing.range_m <= farthest_m + tolerance_m) {
    return Evidence::kConfirmed;
  }
  if (is_empty(bearing.beam)) {
    return Evidence::kNothing;
  }
  return returned_m_[bearing.beam] > bearing.range_m ? Evidence::kSeenThrough : Evidence::kHidden;
}

}  // namespace mtr_drive_control
