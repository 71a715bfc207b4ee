/// @file
/// What fixes of a satellite receiver do to the pose.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <deque>

#include "figures.hpp"
#include "gnss/gnss_frame.hpp"
#include "motion/filter_history.hpp"
#include "tracking/tracker.hpp"

namespace mtr_localization {

/// A receiver is a sensor that errs by centimetres to metres for minutes: LiDARs that hold the pose are better. So a
/// fix corrects only a pose that is twice as uncertain as itself, which a row of fixes with one error cannot make too
/// sure, and several fixes far from the pose mean that it is lost.
class GnssMonitor {
 public:
  /// False: refused, because it is not a position, says not how uncertain it is, or is too uncertain.
  bool add(const GnssFix& fix);

  /// Another map begins.
  void clear();

  /// Uses the fixes that are due at the history's newest step; one sentence when they say that the pose is wrong.
  mtr_core::Problem use_due(const ScanTracker& tracker, FilterHistory& history);

  /// Time of the newest precise fix that was where the pose is; 0: none was on this map.
  std::int64_t agreed_ns() const { return agreed_ns_; }

  const GnssFigures& figures() const { return figures_; }

 private:
  mtr_core::Problem use(const GnssFix& fix, const ScanTracker& tracker, FilterHistory& history);
  mtr_core::Problem compare(const GnssFix& fix, const GnssPosition& seen, FilterHistory& history);

  std::deque<GnssFix> waiting_;
  GnssFrame frame_;
  GnssFigures figures_;
  int contradictions_ = 0;
  std::int64_t agreed_ns_ = 0;
};

}  // namespace mtr_localization
