/// @file
/// Effect of satellite fixes on the pose.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <deque>

#include "figures.hpp"
#include "gnss/gnss_frame.hpp"
#include "motion/filter_history.hpp"
#include "tracking/tracker.hpp"

namespace mtr_localization {

/// Combines a satellite receiver with the pose. Its error of centimetres to metres persists for minutes, so the LiDARs
/// take precedence. A fix corrects only a pose that is at least twice as uncertain, so that repeated fixes with one
/// common error cannot make it overconfident. Several fixes far from the pose mean that the pose is lost.
class GnssMonitor {
 public:
  /// Returns false for a rejected fix: not a position, without uncertainty, or too uncertain.
  bool add(const GnssFix& fix);

  /// Starts again, for a new map.
  void clear();

  /// Applies the fixes that are due at the newest step; returns a problem if they contradict the pose.
  mtr_core::Problem use_due(const ScanTracker& tracker, FilterHistory& history);

  /// Time of the newest accurate fix that confirmed the pose on this map; 0 if there is none.
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
