/// @file
/// Border of the test area, and the motion near it.
// SPDX-License-Identifier: Apache-2.0
#include "mtr_drive_control/area/area_guard.hpp"

#include "mtr_core/steady_time.hpp"
#include "problems.hpp"

namespace mtr_drive_control {
namespace {

constexpr int kHalvings = 8;
// A smaller share of the desired velocity counts as a stop.
constexpr double kLeastShare = 0.05;
// Tolerance for rounding; a larger one would let the robot creep outward tick by tick.
constexpr double kRoundingM = 1e-9;
constexpr double kRoundingMps = 1e-9;
constexpr double kSigmas = 2.0;

bool has_polygon(const std::shared_ptr<const TestArea>& area) { return area && area->polygon; }

}  // namespace

void check(const AreaParameters& parameters) {
  for (const AreaRow& row : kAreaRows) {
    mtr_core::check_range(row.name, parameters.*(row.member), row.low, row.high, row.unit);
  }
}

AreaGuard::AreaGuard(const AreaParameters& parameters, const Footprint& footprint)
    : parameters_(parameters), footprint_(footprint) {
  check(parameters);
}

void AreaGuard::take(std::int64_t tick_ns, const AreaInputs& inputs, const Velocity& wheels) {
  area_ = inputs.area;
  place_.reset();
  obstruction_ = {};
  if (!has_polygon(area_)) {
    obstruction_ = area_ && area_->required ? problems::kAreaMissing() : mtr_core::Problem{};
  } else if (inputs.pose && inputs.pose->origin_id != area_->origin_id) {
    obstruction_ = problems::kAreaOfOtherOrigin();
  } else {
    place_ = place_at(tick_ns, inputs, wheels);
    obstruction_ = place_ ? mtr_core::Problem{} : problems::kAreaPoseUnknown();
  }
}

std::optional<AreaGuard::Place> AreaGuard::place_at(std::int64_t tick_ns, const AreaInputs& inputs,
                                                    const Velocity& wheels) const {
  const std::optional<AreaPose>& pose = inputs.pose;
  if (!pose || !mtr_core::is_fresh(pose->stamp_ns, tick_ns, parameters_.area_pose_timeout_s)) {
    return std::nullopt;
  }
  const double margin_m =
      parameters_.area_gap_m + kSigmas * (pose->position_sigma_m + pose->heading_sigma_rad * footprint_.radius_m());
  const double age_s = static_cast<double>(tick_ns - pose->stamp_ns) * 1e-9;
  const Pose now = pose->map_from_base.after(wheels, age_s);
  const double clearance_m = area_->polygon->clearance_m(footprint_, now);
  // A negative or missing sigma is a fault of localization.
  const bool is_known = margin_m >= parameters_.area_gap_m && std::isfinite(margin_m) && std::isfinite(clearance_m);
  return is_known ? std::optional<Place>({now, margin_m, clearance_m}) : std::nullopt;
}

AreaAssessment AreaGuard::assess(const DesiredMotion& desired, const StopPath& stop_path) const {
  if (desired.velocity.is_zero()) {
    return {};
  }
  if (place_) {
    return assess_inside(desired.velocity, stop_path);
  }
  if (!obstruction_) {
    return {desired.velocity, Zone::kClear, {}};
  }
  if (!desired.by_hand) {
    return {{}, Zone::kBlocked, obstruction_};
  }
  // A person loads the robot before an area is set, and drives a lost one to where it localizes again.
  return has_polygon(area_)
             ? AreaAssessment{at_most(desired.velocity, parameters_.area_crawl_mps), Zone::kSlowed, obstruction_}
             : AreaAssessment{desired.velocity, Zone::kClear, {}};
}

AreaAssessment AreaGuard::assess_inside(const Velocity& desired, const StopPath& stop_path) const {
  const bool is_outside = place_->clearance_m < place_->margin_m;
  const Velocity tried = is_outside ? at_most(desired, parameters_.area_return_mps) : desired;
  if (stays_inside(stop_path(tried))) {
    return {tried, is_outside ? Zone::kSlowed : Zone::kClear, is_outside ? border_problem() : mtr_core::Problem{}};
  }
  double safe = 0.0;
  double unsafe = 1.0;
  for (int i = 0; i < kHalvings; ++i) {
    const double share = 0.5 * (safe + unsafe);
    (stays_inside(stop_path(tried.scaled(share))) ? safe : unsafe) = share;
  }
  if (safe < kLeastShare) {
    return {{}, Zone::kBlocked, border_problem()};
  }
  return {tried.scaled(safe), Zone::kSlowed, {}};
}

bool AreaGuard::permits(const DesiredMotion& desired, const StopPath& stop_path) const {
  if (desired.velocity.is_zero()) {
    return true;
  }
  if (place_) {
    return stays_inside(stop_path(desired.velocity));
  }
  if (!obstruction_ || (desired.by_hand && !has_polygon(area_))) {
    return true;
  }
  return desired.by_hand && corner_speed_mps(desired.velocity) <= parameters_.area_crawl_mps + kRoundingMps;
}

bool AreaGuard::stays_inside(const std::vector<PathPoint>& path) const {
  const Polygon& polygon = *area_->polygon;
  // A robot that is already closer to the border, or beyond it, may return but not move farther out.
  const double least_m = std::min(place_->margin_m, place_->clearance_m - kRoundingM);
  for (const PathPoint& then : path) {
    const Point at = place_->map_from_base.apply(then.pose.position());
    const Pose pose(at.x_m, at.y_m, place_->map_from_base.heading_rad() + then.pose.heading_rad());
    if (!(polygon.clearance_m(footprint_, pose) >= least_m)) {
      return false;
    }
  }
  return true;
}

double AreaGuard::corner_speed_mps(const Velocity& velocity) const {
  return std::abs(velocity.linear_mps) + std::abs(velocity.angular_radps) * footprint_.radius_m();
}

Velocity AreaGuard::at_most(const Velocity& velocity, double corner_mps) const {
  const double speed_mps = corner_speed_mps(velocity);
  return speed_mps > corner_mps ? velocity.scaled(corner_mps / speed_mps) : velocity;
}

mtr_core::Problem AreaGuard::border_problem() const {
  return place_->clearance_m < 0.0 ? problems::kOutsideArea({{"distance_m", -place_->clearance_m}})
                                   : problems::kAreaBorder({{"distance_m", place_->clearance_m}});
}

}  // namespace mtr_drive_control
