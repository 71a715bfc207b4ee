/// @file
/// Detection of surfaces that are looked through for longer than at a correct pose.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "tracking/agreement.hpp"

namespace mtr_localization {

/// Accumulates the excess share of expected beams without a return, or with one behind the surface, in views that are
/// not the expected ones. A person hides surfaces, but cannot make them transparent, and a view that agrees by chance
/// keeps passing through surfaces. Views on uneven ground are not counted, because a LiDAR looks over and under
/// surfaces there.
class ContradictionWatch {
 public:
  void reset();
  /// Adds a view, in the order of the stamps.
  /// @param slope rise of the robot's axes per metre
  /// @return true if surfaces have been looked through for too long
  bool add(std::int64_t stamp_ns, const Agreement& view, const Eigen::Vector2d& slope);

 private:
  std::int64_t stamp_ns_ = 0;
  /// Mean square of recent slopes.
  double slope_square_ = 0.0;
  /// Integral of the share above the usual one.
  double excess_s_ = 0.0;
};

}  // namespace mtr_localization
