/// @file
/// Distance field of the surfaces.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "map_names.hpp"

namespace mtr_localization {

/// Grids of nearness: 1 on a surface, decreasing to 0 with the distance.
///
/// Level 0 holds the nearness of each place. Level l holds the maximum over the 2^l by 2^l places towards +x and +y,
/// kStepM apart. It bounds a search that splits squares of places (Olson 2009, Hess et al. 2016).
class DistanceField {
 public:
  DistanceField() = default;
  explicit DistanceField(const std::vector<Surfel>& surfels);

  static constexpr double kCellM = 0.1;
  static constexpr double kStepM = 0.2;
  static constexpr int kLevels = 4;

  /// Returns 0 to 255; 0 outside of the map.
  std::uint8_t nearness(int level, const Eigen::Vector2d& point) const {
    const int x = static_cast<int>(std::floor((point.x() - origin_.x()) / kCellM));
    const int y = static_cast<int>(std::floor((point.y() - origin_.y()) / kCellM));
    return x >= 0 && y >= 0 && x < size_.x() && y < size_.y() ? levels_[static_cast<std::size_t>(level)][index(x, y)]
                                                              : 0;
  }

 private:
  std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(size_.x()) + static_cast<std::size_t>(x);
  }
  void mark(const Eigen::Vector2d& point);
  void widen(int level);

  Eigen::Vector2d origin_ = Eigen::Vector2d::Zero();
  Eigen::Vector2i size_ = Eigen::Vector2i::Zero();
  std::array<std::vector<std::uint8_t>, kLevels> levels_;
};

}  // namespace mtr_localization
