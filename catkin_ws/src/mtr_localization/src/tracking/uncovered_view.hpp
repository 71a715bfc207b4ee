/// @file
/// Confirmation of a lost pose by the duration and path of agreeing views.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>

#include "map_names.hpp"
#include "tracking/matcher.hpp"

namespace mtr_localization {

/// Detects that an obstruction has gone: near the place of the last agreement, the expected view must last for a
/// second. Elsewhere it must last over a distance or a turn, because a single place may look like another. After
/// surfaces were looked through, a longer distance is required: a carried robot would have to be at a place that keeps
/// looking like the assumed one. A turn alone shows the same place again.
///
/// Views distinguish places to decimetres, and far from a single Car only to a metre. Therefore the returns
/// must also fit the surfaces as exactly as the pose is known.
class UncoveredView {
 public:
  /// Resets, for a view that is not the expected one.
  void reset() { since_.reset(); }

  /// Adds an expected view.
  /// @param agreed_odom base_link in odom at the last agreement
  /// @param odom base_link in odom now
  /// @param fit of the view at the pose with the expected view
  /// @return true if the agreement has lasted long enough
  bool add(std::int64_t stamp_ns, const PoseVector& agreed_odom, const PoseVector& odom, bool is_contradicted,
           const ScanFit& fit);

 private:
  struct Beginning {
    std::int64_t stamp_ns;
    PoseVector odom;
    /// Sum over all views since.
    ScanFit fit = {};
  };
  std::optional<Beginning> since_;
};

}  // namespace mtr_localization
