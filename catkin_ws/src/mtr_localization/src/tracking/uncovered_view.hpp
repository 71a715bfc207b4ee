/// @file
/// While a pose is lost: for how long, and over which way, the view is the expected one again.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>

#include "map_names.hpp"
#include "tracking/matcher.hpp"

namespace mtr_localization {

/// What hid the view has gone when, near the place where it agreed last, the expected one is seen for a second.
/// Elsewhere it has to go on over some of a way, or of a turn, for one place alone may look like another. After
/// surfaces were looked through, only over a longer way: a robot that was carried would have to be at a place that
/// looks like the one to which wheels and gyro have led, and go on looking like it. A turn shows one place again.
///
/// A view tells places apart by decimetres, and far from a Car that stands alone by a metre: what it shows has to lie
/// on the surfaces, too, as exactly as the pose is known.
class UncoveredView {
 public:
  /// It is not the expected view.
  void reset() { since_.reset(); }

  /// It is the expected one. @param agreed_odom base_link in odom when the view agreed last; @param odom now
  /// @param fit of the view at the pose where it is the expected one
  /// @return whether it has been for long enough
  bool add(std::int64_t stamp_ns, const PoseVector& agreed_odom, const PoseVector& odom, bool is_contradicted,
           const ScanFit& fit);

 private:
  struct Beginning {
    std::int64_t stamp_ns;
    PoseVector odom;
    /// Of all views since.
    ScanFit fit = {};
  };
  std::optional<Beginning> since_;
};

}  // namespace mtr_localization
