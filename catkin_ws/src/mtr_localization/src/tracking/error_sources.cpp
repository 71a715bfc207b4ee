/// @file
/// Groups surfels by place and direction.
// SPDX-License-Identifier: Apache-2.0
#include "tracking/error_sources.hpp"

#include <array>
#include <cmath>
#include <map>

#include "motion/pose_filter.hpp"

namespace mtr_localization {
namespace {

// About the length of one side of a car.
constexpr double kFirstCellM = 2.0;
constexpr int kDirections = 8;

using Key = std::array<int, 3>;

Key key_of(const Surfel& surfel, double cell_m) {
  const double turn = std::atan2(surfel.normal.y(), surfel.normal.x()) / (2.0 * M_PI) * kDirections;
  return {static_cast<int>(std::floor(surfel.position.x() / cell_m)),
          static_cast<int>(std::floor(surfel.position.y() / cell_m)),
          (static_cast<int>(std::lround(turn)) + kDirections) % kDirections};
}

ErrorSources grouped(const std::vector<Surfel>& surfels, double cell_m) {
  std::map<Key, int> numbers;
  ErrorSources sources;
  for (const Surfel& surfel : surfels) {
    const auto entry = numbers.emplace(key_of(surfel, cell_m), static_cast<int>(numbers.size())).first;
    sources.of_surfel.push_back(entry->second);
  }
  sources.count = static_cast<int>(numbers.size());
  return sources;
}

}  // namespace

ErrorSources error_sources_of(const std::vector<Surfel>& surfels) {
  double cell_m = kFirstCellM;
  ErrorSources sources = grouped(surfels, cell_m);
  // Some sources are reserved for the constant range errors of the LiDARs. Growing cells eventually contain everything,
  // so the loop ends.
  while (sources.count > kMaxErrorSources - kLidars) {
    cell_m *= 1.5;
    sources = grouped(surfels, cell_m);
  }
  return sources;
}

}  // namespace mtr_localization
