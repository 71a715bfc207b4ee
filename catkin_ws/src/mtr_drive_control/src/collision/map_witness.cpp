/// @file
/// Occupied places of the map that a sweep does not show.
// SPDX-License-Identifier: Apache-2.0
#include "mtr_drive_control/collision/map_witness.hpp"

#include <algorithm>
#include <cmath>

#include "mtr_drive_control/arithmetic.hpp"

namespace mtr_drive_control {
namespace {

// Farther away the tilt of the robot may hide mapped surfaces; a stop needs less than 1 m.
constexpr double kReachM = 8.0;
// Maximum error of a valid position, and of the heading.
constexpr double kToleranceM = 0.4;
constexpr double kToleranceRad = 0.035;
// A passing object in front of an empty place for this time shows that the beam works.
constexpr std::int64_t kWorksNs = 1'000'000'000;

}  // namespace

bool SiteMap::is_free_around(const Point& place, double distance_m) const {
  if (free.width == 0 || !(free.cell_m > 0.0)) {
    return false;
  }
  const Point in_grid = free.map_from_grid.undo(place);
  const std::size_t rows = free.cells.size() / free.width;
  const double low_x = std::floor((in_grid.x_m - distance_m) / free.cell_m);
  const double low_y = std::floor((in_grid.y_m - distance_m) / free.cell_m);
  const double high_x = std::floor((in_grid.x_m + distance_m) / free.cell_m);
  const double high_y = std::floor((in_grid.y_m + distance_m) / free.cell_m);
  if (!(low_x >= 0.0 && low_y >= 0.0 && high_x < static_cast<double>(free.width) &&
        high_y < static_cast<double>(rows))) {
    return false;
  }
  for (auto row = static_cast<std::size_t>(low_y); row <= static_cast<std::size_t>(high_y); ++row) {
    for (auto column = static_cast<std::size_t>(low_x); column <= static_cast<std::size_t>(high_x); ++column) {
      if (!free.cells[row * free.width + column]) {
        return false;
      }
    }
  }
  return true;
}

void MapWitness::observe(const View& view, const Witness& lidar, const std::vector<Echo>& echoes,
                         const LocalizedMap& here, EmptyBeams& empty) {
  take(here.map);
  const Point robot = here.map_from_odom.apply(view.position());
  for (std::size_t i = 0; i < places_.size(); ++i) {
    const Point& occupied = map_->occupied[i];
    if (places_[i].is_gone || !is_within(occupied, robot, kReachM)) {
      continue;
    }
    const Point in_odom = here.map_from_odom.undo(occupied);
    const std::optional<Bearing> bearing = view.bearing_of(in_odom);
    const bool is_own = bearing && bearing->range_m >= view.range_min_m() &&
                        std::abs(wrapped_rad(view.angle_rad(bearing->beam))) <= lidar.own_view_rad;
    if (is_own && is_contradicted(places_[i], view, *bearing) &&
        std::none_of(echoes.begin(), echoes.end(),
                     [&](const Echo& echo) { return is_within(echo.point, in_odom, kToleranceM); })) {
      empty.add(*bearing);
    }
  }
}

void MapWitness::take(const std::shared_ptr<const SiteMap>& map) {
  if (map != map_) {
    map_ = map;
    places_.assign(map ? map->occupied.size() : 0, Place{});
  }
}

bool MapWitness::is_contradicted(Place& place, const View& view, const Bearing& bearing) const {
  const Evidence evidence = view.evidence_at(bearing, kToleranceM, kToleranceRad);
  if (evidence == Evidence::kNothing) {
    place.missing_ns = place.missing_ns.value_or(view.stamp_ns());
    return true;
  }
  const bool was_empty_long = place.missing_ns && view.stamp_ns() - *place.missing_ns > kWorksNs;
  place.is_gone = evidence == Evidence::kSeenThrough || (evidence == Evidence::kHidden && was_empty_long);
  place.missing_ns.reset();
  return false;
}

}  // namespace mtr_drive_control
