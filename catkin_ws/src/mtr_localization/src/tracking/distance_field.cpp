/// @file
/// Rendering of each surfel and its surroundings into the grid.
// SPDX-License-Identifier: Apache-2.0
#include "tracking/distance_field.hpp"

#include <algorithm>
#include <cmath>

namespace mtr_localization {
namespace {

// With a coarse search step of 0.2 m and 3 degrees, points of the correct pose are up to this far from their surfaces.
constexpr double kInfluenceM = 0.4;
// Size limit, because a stray surfel far away must not exhaust the memory; such LiDARs have a range of 30 m.
constexpr double kMaxMapM = 120.0;
// Cells between neighbouring places of the search, and look-ahead distance of the highest level.
constexpr int kCellsPerStep = static_cast<int>(DistanceField::kStepM / DistanceField::kCellM + 0.5);
constexpr double kAheadM = ((1 << (DistanceField::kLevels - 1)) - 1) * DistanceField::kStepM;

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
  // Places before the low edges of the map look ahead into it.
  origin_ = middle - half.matrix() - Eigen::Vector2d::Constant(kAheadM);
  size_ = ((2.0 * half + kAheadM) / kCellM).ceil().cast<int>();
  levels_[0].assign(static_cast<std::size_t>(size_.x()) * static_cast<std::size_t>(size_.y()), 0);
  for (const Surfel& surfel : surfels) {
    const Eigen::Vector2d along(-surfel.normal.y(), surfel.normal.x());
    const int steps = static_cast<int>(std::ceil(surfel.length_m / kCellM));
    for (int step = 0; step <= steps; ++step) {
      mark(surfel.position + along * surfel.length_m * (static_cast<double>(step) / steps - 0.5));
    }
  }
  for (int level = 1; level < kLevels; ++level) {
    widen(level);
  }
}

void DistanceField::widen(int level) {
  const std::vector<std::uint8_t>& fine = levels_[static_cast<std::size_t>(level - 1)];
  std::vector<std::uint8_t>& wide = levels_[static_cast<std::size_t>(level)];
  wide = fine;
  const int ahead = kCellsPerStep << (level - 1);
  for (int y = 0; y < size_.y(); ++y) {
    for (int x = 0; x < size_.x(); ++x) {
      const bool has_x = x + ahead < size_.x();
      const bool has_y = y + ahead < size_.y();
      std::uint8_t largest = fine[index(x, y)];
      largest = has_x ? std::max(largest, fine[index(x + ahead, y)]) : largest;
      largest = has_y ? std::max(largest, fine[index(x, y + ahead)]) : largest;
      largest = has_x && has_y ? std::max(largest, fine[index(x + ahead, y + ahead)]) : largest;
      wide[index(x, y)] = largest;
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
      std::uint8_t& cell = levels_[0][index(x, y)];
      cell = std::max(cell, nearness);
    }
  }
}

}  // namespace mtr_localization
