/// @file
/// Recent history of the filter, so that a scan can correct the state at its own time.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <optional>

#include "map_names.hpp"
#include "motion/pose_filter.hpp"

namespace mtr_localization {

/// Input of the filter over one interval: moving, stationary, or unknown.
struct FilterInput {
  enum class Kind { kNothing, kMove, kStand };
  Kind kind = Kind::kNothing;
  /// While stationary, only the duration and the gyro angle are used.
  Motion motion{0.0, 0.0, 0.0};
  /// Rise of base_link's x and y axes per metre, at the end of the interval.
  Eigen::Vector2d slope = Eigen::Vector2d::Zero();
  /// 1 sigma of the slope along each axis.
  double slope_sigma = 0.0;
};

/// Filter state at one wheel sample.
struct FilterStep {
  std::int64_t stamp_ns;
  /// Input since the previous step.
  FilterInput input;
  PoseFilter filter;
  /// Pose of base_link in odom from wheels and gyro only; it never jumps.
  PoseVector odom;
};

/// Steps of the last 0.6 s, oldest first; never empty.
class FilterHistory {
 public:
  FilterHistory(const PoseFilter& filter, std::int64_t stamp_ns) { restart(filter, stamp_ns, PoseVector::Zero()); }

  /// Clears the history. Arguments are copied because they may alias its elements.
  void restart(PoseFilter filter, std::int64_t stamp_ns, PoseVector odom);
  /// Keeps the newest step only.
  void forget_past() { restart(newest().filter, newest().stamp_ns, newest().odom); }
  void advance(std::int64_t stamp_ns, const FilterInput& input);

  const FilterStep& newest() const { return steps_.back(); }
  const FilterStep& oldest() const { return steps_.front(); }
  std::size_t size() const { return steps_.size(); }
  const FilterStep& at(std::size_t index) const { return steps_[index]; }

  /// Returns the index of the step nearest to a time.
  std::size_t nearest(std::int64_t time_ns) const;
  /// Returns the pose of base_link in odom at a time; after the newest step, extrapolated with its velocity.
  PoseVector odom_at(std::int64_t time_ns) const;

  /// Changes the filter at a step and replays the later steps.
  void change(std::size_t index, const std::function<void(PoseFilter&)>& change);
  void change_newest(const std::function<void(PoseFilter&)>& change) { change(steps_.back().filter); }

 private:
  std::deque<FilterStep> steps_;
};

}  // namespace mtr_localization
