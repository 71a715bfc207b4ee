/// @file
/// The filter's recent past, so that a scan can correct the time at which it was taken.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <optional>

#include "map_names.hpp"
#include "motion/pose_filter.hpp"

namespace mtr_localization {

/// Input of the filter over one interval: that the robot moved, stood, or nothing.
struct FilterInput {
  enum class Kind { kNothing, kMove, kStand };
  Kind kind = Kind::kNothing;
  /// In an interval of standing only the duration and the gyro's angle count.
  Motion motion{0.0, 0.0, 0.0};
  /// Rise of base_link's x and y axes per metre, at its end.
  Eigen::Vector2d slope = Eigen::Vector2d::Zero();
  /// Its 1 sigma along each axis.
  double slope_sigma = 0.0;
};

/// State of the filter at one wheel sample.
struct FilterStep {
  std::int64_t stamp_ns;
  /// Since the step before.
  FilterInput input;
  PoseFilter filter;
  /// Pose by wheels and gyro alone, which never jumps: base_link in odom.
  PoseVector odom;
};

/// Steps of the last half second, oldest first; there is always one.
class FilterHistory {
 public:
  FilterHistory(const PoseFilter& filter, std::int64_t stamp_ns) { restart(filter, stamp_ns, PoseVector::Zero()); }

  /// Forgets the past; by value, for they may be of it.
  void restart(PoseFilter filter, std::int64_t stamp_ns, PoseVector odom);
  /// The newest step is the only one from now on.
  void forget_past() { restart(newest().filter, newest().stamp_ns, newest().odom); }
  void advance(std::int64_t stamp_ns, const FilterInput& input);

  const FilterStep& newest() const { return steps_.back(); }
  const FilterStep& oldest() const { return steps_.front(); }
  std::size_t size() const { return steps_.size(); }
  const FilterStep& at(std::size_t index) const { return steps_[index]; }

  /// Index of the step nearest to a time.
  std::size_t nearest(std::int64_t time_ns) const;
  /// Base_link in odom at a time; after the newest step with the velocity of that step.
  PoseVector odom_at(std::int64_t time_ns) const;

  /// Changes the filter at a step, and what came of it since.
  void change(std::size_t index, const std::function<void(PoseFilter&)>& change);
  void change_newest(const std::function<void(PoseFilter&)>& change) { change(steps_.back().filter); }

 private:
  std::deque<FilterStep> steps_;
};

}  // namespace mtr_localization
