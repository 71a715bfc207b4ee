/// @file
/// How near each place is to a surface.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "map_names.hpp"

namespace mtr_localization {

/// Grid of nearness: 1 on a surface, falling to 0 with the distance.
class DistanceField {
 public:
  DistanceField() = default;
  explicit DistanceField(const std::vector<Surfel>& surfels);

  static constexpr double kCellM = 0.1;

  /// 0 to 255; 0 outside of the map.
  std::uint8_t nearness(const Eigen::Vector2d& point) const {
    const int x = static_cast<int>((point.x() - origin_.x()) / kCellM);
    const int y = static_cast<int>((point.y() - origin_.y()) / kCellM);
    return x >= 0 && y >= 0 && x < size_.x() && y < size_.y() ? cells_[static_cast<std::size_t>(y * size_.x() + x)] : 0;
  }

 private:
  void mark(const Eigen::Vector2d& point);

  Eigen::Vector2d origin_ = Eigen::Vector2d::Zero();
  Eigen::Vector2i size_ = Eigen::Vector2i::Zero();
  std::vector<std::uint8_t> cells_;
};

}  // namespace mtr_localization
