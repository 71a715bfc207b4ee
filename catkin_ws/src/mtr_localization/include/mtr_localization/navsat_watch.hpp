/// @file
/// What fixes of a satellite receiver do to the pose.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <deque>
#include <string>

#include "mtr_localization/filter_history.hpp"
#include "mtr_localization/navsat_frame.hpp"
#include "mtr_localization/scan_tracker.hpp"

namespace mtr_localization {

/// Figures for a person.
struct NavsatFigures {
  int refused = 0;
  /// Fixes that corrected the pose.
  int used = 0;
  /// Distance of the newest fix from the pose, m; 0 as long as the frame is not known.
  double residual_m = 0.0;
};

/// A receiver is a witness that errs by centimetres to metres for minutes: LiDARs that hold the pose are better. So a
/// fix corrects only a pose that is twice as uncertain as itself, which a row of fixes with one error cannot make too
/// sure, and several fixes far from the pose mean that it is lost.
class NavsatWatch {
 public:
  /// False: refused, because it is not a position, says not how uncertain it is, or is too uncertain.
  bool add(const NavsatSample& fix);

  /// Another map begins.
  void clear();

  /// Uses the fixes that are due at the history's newest step; one sentence when they say that the pose is wrong.
  std::string use_due(const ScanTracker& tracker, FilterHistory& history);

  const NavsatFigures& figures() const { return figures_; }

 private:
  std::string use(const NavsatSample& fix, const ScanTracker& tracker, FilterHistory& history);
  std::string compare(const NavsatSample& fix, const NavsatPosition& seen, FilterHistory& history);

  std::deque<NavsatSample> waiting_;
  NavsatFrame frame_;
  NavsatFigures figures_;
  int contradictions_ = 0;
};

}  // namespace mtr_localization
