/// @file
/// Compares remembered surfaces with a sweep, which confirms, disproves or does not show them.
// SPDX-License-Identifier: Apache-2.0
#include "mtr_drive_control/collision/echo_memory.hpp"

#include <algorithm>
#include <cmath>

#include "mtr_drive_control/arithmetic.hpp"

namespace mtr_drive_control {
namespace {

constexpr double kPi = 3.14159265358979323846;
// Noise of a range, and of the odometry between two sweeps; the share is a beam's width on a slanted surface.
constexpr double kToleranceM = 0.1;
constexpr double kTolerancePerRange = 0.03;
constexpr double kToleranceRad = 0.008;
// Swing of a foot within two sweeps of a slow LiDAR; the share is the wheels' error in a turn of that time.
constexpr double kStepM = 0.3;
constexpr double kStepPerRange = 0.04;
// Near the robot a step leaves the view even from far inside of it.
constexpr double kMaxEdgeRad = 0.8;
// Time within which a surface that has moved shows its new place.
constexpr std::int64_t kMovedWithinNs = 200'000'000;
// After this time a hidden surface, or one out of view, may have gone, and the wheel odometry has drifted.
constexpr std::int64_t kUnseenNs = 1'000'000'000;
// Minimum visibility of a surface: while the robot pitches, its LiDARs meet the ground some metres ahead.
constexpr std::int64_t kProvenNs = 500'000'000;
// Rest after which a vanished surface is discarded: by then the Operator has read the LiDAR and direction concerned.
constexpr std::int64_t kGivenUpNs = 20'000'000'000;
// Possible persons are tracked up to here; farther away only objects wider than a person's two legs.
constexpr double kThingReachM = 4.0;
// Within this share of its range a working LiDAR sees a known surface again.
constexpr double kReachShare = 0.8;
// Echoes of the other LiDAR count up to here: farther away the smallest tilt gives them different views.
constexpr double kOtherReachM = 4.0;

/// Number of beams covered by one step across them.
std::size_t beams_of_step(const View& view, const Bearing& bearing) {
  const double step_rad = std::asin(std::min(1.0, kStepM / std::max(bearing.range_m, kStepM)));
  return static_cast<std::size_t>(std::ceil(std::min(step_rad, kMaxEdgeRad) / view.step_rad()));
}

/// Returns true for a place from which one step leaves the view.
bool is_at_edge(const View& view, const Bearing& bearing) {
  const std::size_t beams = std::min(bearing.beam, view.beams() - 1 - bearing.beam);
  // No arc sine is above 1.6 times its argument: most places are farther from the edge than that.
  const double at_most_rad = std::min(1.6 * kStepM / std::max(bearing.range_m, kStepM), kMaxEdgeRad);
  return static_cast<double>(beams) * view.step_rad() < at_most_rad + 2.0 * view.step_rad() &&
         beams < beams_of_step(view, bearing);
}

/// Returns true for a place from which one step leads behind a nearer object, as one leg goes behind the other.
bool is_beside_shadow(const View& view, const Bearing& bearing) {
  const std::size_t step = beams_of_step(view, bearing);
  const std::size_t last = std::min(bearing.beam + step, view.beams() - 1);
  for (std::size_t beam = bearing.beam - std::min(bearing.beam, step); beam <= last; ++beam) {
    if (view.evidence_at({beam, bearing.range_m}, kToleranceM, 0.0) == Evidence::kHidden) {
      return true;
    }
  }
  return false;
}

}  // namespace

EmptyBeams EchoMemory::observe(const View& view, const Witness& lidar, const std::vector<Echo>& echoes) {
  empty_ = EmptyBeams();
  since_ns_.assign(view.beams(), std::nullopt);
  for (const Echo& echo : echoes) {
    since_ns_[echo.beam] = echo.stamp_ns;
  }
  const auto gone = std::remove_if(remembered_.begin(), remembered_.end(),
                                   [&](Remembered& remembered) { return !survives(remembered, view, lidar, echoes); });
  remembered_.erase(gone, remembered_.end());
  for (const Echo& echo : echoes) {
    if (echo.range_m <= kThingReachM || (echo.is_wide && echo.span_rad > kLegRad)) {
      remembered_.push_back({echo, lidar.index, *since_ns_[echo.beam], rest_ns_, std::nullopt});
    }
  }
  return empty_;
}

bool EchoMemory::survives(Remembered& remembered, const View& view, const Witness& lidar,
                          const std::vector<Echo>& echoes) {
  const bool is_recent = view.stamp_ns() - remembered.echo.stamp_ns <= kUnseenNs;
  const bool is_given_up = rest_ns_ - remembered.rest_ns > kGivenUpNs;
  const std::optional<Bearing> bearing = view.bearing_of(remembered.echo.point);
  if (!bearing || is_at_edge(view, *bearing)) {
    return (is_recent || remembered.missing_ns) && !is_given_up;
  }
  const double range_m = bearing->range_m;
  switch (view.evidence_at(*bearing, kToleranceM + kTolerancePerRange * range_m, kToleranceRad)) {
    case Evidence::kConfirmed:
      if (remembered.lidar != lidar.index) {
        // Its own LiDAR must still show it.
        return is_recent || remembered.missing_ns;
      }
      remembered.echo.stamp_ns = view.stamp_ns();
      remembered.rest_ns = rest_ns_;
      remembered.missing_ns.reset();
      // Its echo replaces it, unless the echo is too weak to count.
      return !hands_on(remembered, bearing->beam);
    case Evidence::kSeenThrough:
      return false;
    case Evidence::kHidden:
      // A raindrop in front does not show that the beam works, but a passing object does; a person has walked on
      // meanwhile.
      return counts(bearing->beam) ? remembered.echo.is_wide && is_recent : is_recent || remembered.missing_ns;
    default:
      break;
  }
  if (remembered.echo.stamp_ns - remembered.since_ns < kProvenNs) {
    return view.stamp_ns() - remembered.echo.stamp_ns <= kMovedWithinNs;
  }
  remembered.missing_ns = remembered.missing_ns.value_or(view.stamp_ns());
  const bool may_have_moved = view.stamp_ns() - *remembered.missing_ns <= kMovedWithinNs;
  const bool is_behind = !remembered.echo.is_wide && is_beside_shadow(view, *bearing);
  if (is_given_up || (may_have_moved && (is_behind || is_explained(remembered, range_m, echoes)))) {
    return false;
  }
  const bool is_own = std::abs(std::remainder(view.angle_rad(bearing->beam), 2.0 * kPi)) <= lidar.own_view_rad;
  const double reach_m = remembered.lidar == lidar.index ? kReachShare * view.range_max_m() : kOtherReachM;
  if (is_own && range_m >= view.range_min_m() && range_m <= reach_m) {
    empty_.add(*bearing);
  }
  return true;
}

bool EchoMemory::counts(std::size_t beam) const {
  const std::size_t last = std::min(beam + 1, since_ns_.size() - 1);
  return std::any_of(since_ns_.begin() + static_cast<std::ptrdiff_t>(beam - std::min<std::size_t>(beam, 1)),
                     since_ns_.begin() + static_cast<std::ptrdiff_t>(last + 1),
                     [](const std::optional<std::int64_t>& since_ns) { return since_ns.has_value(); });
}

bool EchoMemory::hands_on(const Remembered& remembered, std::size_t beam) {
  const std::size_t last = std::min(beam + 1, since_ns_.size() - 1);
  for (std::size_t each = beam - std::min<std::size_t>(beam, 1); each <= last; ++each) {
    if (since_ns_[each]) {
      since_ns_[each] = std::min(*since_ns_[each], remembered.since_ns);
    }
  }
  return counts(beam);
}

bool EchoMemory::is_explained(const Remembered& remembered, double range_m, const std::vector<Echo>& echoes) const {
  const double step_m = std::max(kStepM, kStepPerRange * range_m);
  return std::any_of(echoes.begin(), echoes.end(), [&](const Echo& echo) {
    // A wall next to a thing does not replace the thing.
    return (remembered.echo.is_wide || !echo.is_wide) && is_within(echo.point, remembered.echo.point, step_m);
  });
}

std::vector<MissingEcho> EchoMemory::missing() const {
  std::vector<MissingEcho> missing;
  for (const Remembered& remembered : remembered_) {
    if (remembered.missing_ns) {
      missing.push_back({remembered.echo.point, remembered.echo.stamp_ns, remembered.echo.is_wide});
    }
  }
  return missing;
}

void EchoMemory::move(const Pose& before, const Pose& now) {
  for (Remembered& remembered : remembered_) {
    remembered.echo.point = now.apply(before.undo(remembered.echo.point));
  }
}

}  // namespace mtr_drive_control
