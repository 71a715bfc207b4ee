/// @file
/// Conversion of a scan set and its motion to a view.
// SPDX-License-Identifier: Apache-2.0
#include "tracking/view.hpp"

#include <utility>

namespace mtr_localization {

View view_of(const ScanSet& set, ScanPoints scan, const FilterHistory& history) {
  const FilterStep& step = history.at(set.step);
  View view{set.sweeps, {}, std::move(scan), step.stamp_ns, step.odom, step.input.slope, step.input.slope_sigma};
  for (const Sweep& sweep : set.sweeps) {
    view.turns.push_back({wrapped(history.odom_at(sweep.stamp_ns).z() - step.odom.z()),
                          wrapped(history.odom_at(sweep.last_beam_ns()).z() - step.odom.z())});
  }
  return view;
}

Agreement agreement_of(const View& view, const PoseVector& pose, const SurfelMap& map, double tolerance_m) {
  Agreement all;
  for (std::size_t i = 0; i < view.sweeps.size(); ++i) {
    all += agreement_of(view.sweeps[i], {pose, view.turns[i], view.slope, view.slope_sigma}, map, tolerance_m);
  }
  return all;
}

}  // namespace mtr_localization
