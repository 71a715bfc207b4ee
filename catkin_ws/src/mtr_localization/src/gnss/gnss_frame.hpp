/// @file
/// Transform of satellite fixes into map.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "samples.hpp"

namespace mtr_localization {

/// Position of an antenna in map, m, and its 1 sigma in either direction.
struct GnssPosition {
  Eigen::Vector2d position = Eigen::Vector2d::Zero();
  double sigma_m = 0.0;
};

/// Transforms geodetic positions into map, after enough fixes at known poses.
///
/// The frame is the least-squares rigid transform (Umeyama 1991, without scale) between map and a plane tangent to the
/// ellipsoid at the first fix. Satellite errors persist for minutes, so averaging does not remove them: frame and fix
/// each have the uncertainty of one fix.
class GnssFrame {
 public:
  /// Forgets the frame, for a new map.
  void clear();

  /// Adds a fix with the antenna position in map from another source.
  void learn(const GnssFix& fix, const Eigen::Vector2d& antenna_in_map);

  /// Returns the position of a fix in map, or nothing until the frame is known.
  std::optional<GnssPosition> in_map(const GnssFix& fix) const;

 private:
  struct Pair {
    Eigen::Vector2d level;
    Eigen::Vector2d map;
    double sigma_m;
  };

  /// Returns east and north relative to the first fix, m.
  Eigen::Vector2d level_of(const GnssFix& fix) const;
  void fit();

  std::optional<GnssFix> origin_;
  std::vector<Pair> pairs_;
  bool is_known_ = false;
  double map_from_level_rad_ = 0.0;
  Eigen::Vector2d level_centre_ = Eigen::Vector2d::Zero();
  Eigen::Vector2d map_centre_ = Eigen::Vector2d::Zero();
  double spread_m_ = 0.0;
  double sigma_m_ = 0.0;
};

}  // namespace mtr_localization
