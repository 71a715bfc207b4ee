/// @file
/// Where fixes of a satellite receiver are in map.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "samples.hpp"

namespace mtr_localization {

/// An antenna's position in map, m, and its 1 sigma in either direction.
struct GnssPosition {
  Eigen::Vector2d position = Eigen::Vector2d::Zero();
  double sigma_m = 0.0;
};

/// Turns geodetic positions into map, once enough fixes have been seen at known poses.
///
/// The frame is found by the rigid motion of least squares (Umeyama 1991, without scale) between a plane that touches
/// the ellipsoid at the first fix and map. Errors of satellites last for minutes, so no number of fixes averages them
/// out: frame and fix are each as uncertain as one fix.
class GnssFrame {
 public:
  /// Map is another one from now on.
  void clear();

  /// The antenna's position in map at a fix, known otherwise.
  void learn(const GnssFix& fix, const Eigen::Vector2d& antenna_in_map);

  /// Nothing as long as the frame is not known.
  std::optional<GnssPosition> in_map(const GnssFix& fix) const;

 private:
  struct Pair {
    Eigen::Vector2d level;
    Eigen::Vector2d map;
    double sigma_m;
  };

  /// East and north of the first fix, m.
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
