/// @file
/// Draws each surfel with its surroundings into the grid.
// SPDX-License-Identifier: Apache-2.0
#include "tracking/distance_field.hpp"

#include <algorithm>
#include <cmath>

namespace mtr_localization {
namespace {

// A coarse search step of 0.2 m and 3 degrees puts points of the right pose up to this far from their surfaces.
constexpr double kInfluenceM = 0.4;
// A stray surfel far away must not exhaust the memory; LiDARs of this class see 30 m.
constexpr double kMaxMapM = 120.0;

}  // namespace

DistanceField::DistanceField(const std::vector<Surfel>& surfels) {
  if (surfels.empty()) {
    return;
  }
  Eigen::Vector2d low = surfels.front().position;
  Eigen::Vector2d high = low;
  for (const Surfel& surfel : surfels) {
    low = low.cwiseMin(surfel.position);
    high = high.cwiseMax(surfel.position);
  }
  const Eigen::Vector2d middle = 0.5 * (low + high);
  const Eigen::Array2d half = (0.5 * (high - low).array() + 2.0 * kInfluenceM).min(0.5 * kMaxMapM);
  origin_ = middle - half.matrix();
  size_ = (2.0 * half / kCellM).ceil().cast<int>();
  cells_.assign(static_cast<std::size_t>(size_.x()) * static_cast<std::size_t>(size_.y()), 0);
  for (const Surfel& surfel : surfels) {
    const Eigen::Vector2d along(-surfel.normal.y(), surfel.normal.x());
    const int steps = static_cast<int>(std::ceil(surfel.length_m / kCellM));
    for (int step = 0; step <= steps; ++step) {
      mark(surfel.position + along * surfel.length_m * (static_cast<double>(step) / steps - 0.5));
    }
  }
}

void DistanceField::mark(const Eigen::Vector2d& point) {
  const Eigen::Vector2d place = (point - origin_) / kCellM;
  const int cells = static_cast<int>(std::ceil(kInfluenceM / kCellM));
  const int middle_x = static_cast<int>(place.x());
  const int middle_y = static_cast<int>(place.y());
  for (int y = std::max(0, middle_y - cells); y <= std::min(size_.y() - 1, middle_y + cells); ++y) {
    for (int x = std::max(0, middle_x - cells); x <= std::min(size_.x() - 1, middle_x + cells); ++x) {
      const double distance = kCellM * std::hypot(x + 0.5 - place.x(), y + 0.5 - place.y());
      const auto nearness = static_cast<std::uint8_t>(std::lround(255.0 * std::max(0.0, 1.0 - distance / kInfluenceM)));
      std::uint8_t& cell = cells_[static_cast<std::size_t>(y * size_.x() + x)];
      cell = std::max(cell, nearness);
    }
  }
}

}  // namespace mtr_localization
