/// @file
/// While a pose is lost: for how long, and over which way, the view is the expected one again.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>

#include "map_names.hpp"

namespace mtr_localization {

/// What hid the view has gone when, near the place where it agreed last, the expected one is seen for a second.
/// Elsewhere it has to go on over some of a way, or of a turn, for one place alone may look like another. After
/// surfaces were looked through, only over a longer way: a robot that was carried would have to be at a place that
/// looks like the one to which wheels and gyro have led, and go on looking like it. A turn shows one place again.
class UncoveredView {
 public:
  /// It is not the expected view.
  void reset() { since_.reset(); }

  /// It is the expected one. @param agreed_odom base_link in odom when the view agreed last; @param odom now
  /// @return whether it has been for long enough
  bool add(std::int64_t stamp_ns, const PoseVector& agreed_odom, const PoseVector& odom, bool is_contradicted);

 private:
  struct Beginning {
    std::int64_t stamp_ns;
    PoseVector odom;
  };
  std::optional<Beginning> since_;
};

}  // namespace mtr_localization
