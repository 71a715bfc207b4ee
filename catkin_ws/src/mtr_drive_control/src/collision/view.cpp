/// @file
/// Bearings of points in a sweep.
// SPDX-License-Identifier: Apache-2.0
#include "mtr_drive_control/collision/view.hpp"

#include <algorithm>
#include <cmath>

#include "mtr_drive_control/arithmetic.hpp"

namespace mtr_drive_control {
namespace {

constexpr double kPi = 3.14159265358979323846;
// The direction depends on the beam's time, which depends on the direction: two iterations are exact to a hundredth of
// a beam.
constexpr int kRefinements = 2;

}  // namespace

View::View(const Sweep& sweep, const LidarMount& mount, const Motion& motion, std::vector<double> returned_m)
    : stamp_ns_(sweep.stamp_ns),
      angle_min_rad_(sweep.angle_min_rad),
      angle_increment_rad_(sweep.angle_increment_rad),
      range_min_m_(sweep.range_min_m),
      range_max_m_(sweep.range_max_m),
      mount_(mount),
      position_(motion.odom_from_base.position()),
      poses_(sweep, motion),
      returned_m_(std::move(returned_m)) {}

double View::angle_rad(std::size_t beam) const {
  return angle_min_rad_ + angle_increment_rad_ * static_cast<double>(beam);
}

double View::angle_in_base_rad(std::size_t beam) const {
  return std::remainder(mount_.yaw_rad + angle_rad(beam), 2.0 * kPi);
}

std::optional<std::size_t> View::beam_at(double angle_rad) const {
  const std::size_t middle = beams() / 2;
  const double from_middle = wrapped_rad(angle_rad - View::angle_rad(middle)) / angle_increment_rad_;
  return rounded_index(static_cast<double>(middle) + from_middle, beams());
}

std::optional<Bearing> View::bearing_of(const Point& point) const {
  const Pose* pose = &poses_.middle();
  for (int refinements = 1;; ++refinements) {
    const Point in_base = pose->undo(point);
    const double dx = in_base.x_m - mount_.x_m;
    const double dy = in_base.y_m - mount_.y_m;
    const std::optional<std::size_t> found = beam_at(std::atan2(dy, dx) - mount_.yaw_rad);
    if (!found) {
      return std::nullopt;
    }
    const Pose* const then = &poses_.at(*found);
    if (then == pose || refinements == kRefinements) {
      return Bearing{*found, std::hypot(dx, dy)};
    }
    pose = then;
  }
}

Evidence View::evidence_at(const Bearing& bearing, double tolerance_m, double tolerance_rad) const {
  const std::size_t reach =
      std::max<std::size_t>(1, rounded_index(tolerance_rad / step_rad(), beams()).value_or(beams()));
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
  // On a surface at a flat angle the ranges of neighbouring beams differ widely.
  if (nearest_m - tolerance_m <= bearing.range_m && bearing.range_m <= farthest_m + tolerance_m) {
    return Evidence::kConfirmed;
  }
  if (is_empty(bearing.beam)) {
    return Evidence::kNothing;
  }
  return returned_m_[bearing.beam] > bearing.range_m ? Evidence::kSeenThrough : Evidence::kHidden;
}

}  // namespace mtr_drive_control
