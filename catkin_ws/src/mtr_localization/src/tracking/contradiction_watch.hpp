/// @file
/// Surfaces that are looked through for longer than a right pose shows.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "tracking/agreement.hpp"

namespace mtr_localization {

/// Sums up the share of the expected beams that meet nothing, or something behind the surface, beyond what is usual, in
/// views that are not the expected ones anyway. A person hides surfaces, but nobody looks through them: a view that
/// half agrees by chance goes on doing it. On ground that is not level a LiDAR looks over and under surfaces; there
/// nothing is counted.
class ContradictionWatch {
 public:
  void reset();
  /// A view, in the order of the stamps. @param slope rise of the robot's axes per metre
  /// @return whether surfaces have been looked through for too long
  bool add(std::int64_t stamp_ns, const Agreement& view, const Eigen::Vector2d& slope);

 private:
  std::int64_t stamp_ns_ = 0;
  /// Mean square of the slopes of the last while.
  double slope_square_ = 0.0;
  /// Share above the usual one, over time.
  double excess_s_ = 0.0;
};

}  // namespace mtr_localization
