/// @file
/// Sectors of a view without echoes.
// SPDX-License-Identifier: Apache-2.0
#include "mtr_drive_control/collision/empty_beams.hpp"

#include <algorithm>
#include <limits>

namespace mtr_drive_control {
namespace {

// Empty beams belong to one sector if their surfaces are this close to each other, by angle or by distance.
constexpr double kBridgeRad = 0.053;
constexpr double kBridgeM = 0.3;
// Closer than this an empty sector counts at once, except for a flicker; farther ones must outlast a pitch of the
// robot.
constexpr double kNearM = 4.0;
constexpr std::int64_t kNearConfirmedNs = 60'000'000;
constexpr std::int64_t kFarConfirmedNs = 500'000'000;

bool are_joined(const View& view, const Bearing& before, const Bearing& after) {
  for (std::size_t beam = before.beam; beam < after.beam; ++beam) {
    if (!view.is_empty(beam)) {
      return false;
    }
  }
  const double apart_rad = static_cast<double>(after.beam - before.beam) * view.step_rad();
  return apart_rad <= kBridgeRad || apart_rad * std::min(before.range_m, after.range_m) <= kBridgeM;
}

}  // namespace

double EmptyBeams::nearest_m() const {
  const auto nearest = std::min_element(bearings_.begin(), bearings_.end(),
                                        [](const Bearing& a, const Bearing& b) { return a.range_m < b.range_m; });
  return nearest == bearings_.end() ? std::numeric_limits<double>::infinity() : nearest->range_m;
}

std::optional<Sector> EmptyBeams::widest(const View& view) const {
  std::vector<Bearing> sorted = bearings_;
  std::sort(sorted.begin(), sorted.end(), [](const Bearing& a, const Bearing& b) { return a.beam < b.beam; });
  std::size_t begun = 0;
  std::size_t first = 0;
  std::size_t last = 0;
  for (std::size_t i = 0; i < sorted.size(); ++i) {
    begun = i > 0 && are_joined(view, sorted[i - 1], sorted[i]) ? begun : i;
    if (sorted[i].beam - sorted[begun].beam > last - first) {
      first = sorted[begun].beam;
      last = sorted[i].beam;
    }
  }
  if (static_cast<double>(last - first) * view.step_rad() <= kLegRad) {
    return std::nullopt;
  }
  // The neighbouring beams returned no echo either.
  while (first > 0 && view.is_empty(first - 1)) {
    --first;
  }
  while (last + 1 < view.beams() && view.is_empty(last + 1)) {
    ++last;
  }
  const double a_rad = view.angle_in_base_rad(first);
  const double b_rad = view.angle_in_base_rad(last);
  return view.angle_rad(last) > view.angle_rad(first) ? Sector{a_rad, b_rad} : Sector{b_rad, a_rad};
}

void EmptySector::update(const EmptyBeams& empty, const View& view) {
  const std::optional<Sector> sector = empty.widest(view);
  if (!sector) {
    *this = EmptySector();
    return;
  }
  since_ns_ = since_ns_.value_or(view.stamp_ns());
  const std::int64_t needed_ns = empty.nearest_m() <= kNearM ? kNearConfirmedNs : kFarConfirmedNs;
  if (confirmed_ || view.stamp_ns() - *since_ns_ >= needed_ns) {
    confirmed_ = sector;
  }
}

}  // namespace mtr_drive_control
