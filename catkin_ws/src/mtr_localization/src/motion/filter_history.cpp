/// @file
/// History of filter steps, which are replayed after a correction.
// SPDX-License-Identifier: Apache-2.0
#include "motion/filter_history.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "map_names.hpp"

namespace mtr_localization {
namespace {

// Covers the slowest sweep (0.2 s) with a delay of two sweeps.
constexpr std::int64_t kKeptNs = 600'000'000;

void apply(const FilterInput& input, PoseFilter& filter) {
  if (input.kind == FilterInput::Kind::kMove) {
    filter.move(input.motion);
  } else if (input.kind == FilterInput::Kind::kStand) {
    filter.stand(input.motion.duration_s, input.motion.gyro_angle_rad / input.motion.duration_s);
  }
}

}  // namespace

void FilterHistory::restart(PoseFilter filter, std::int64_t stamp_ns, PoseVector odom) {
  steps_.clear();
  steps_.push_back({stamp_ns, {}, std::move(filter), std::move(odom)});
}

void FilterHistory::advance(std::int64_t stamp_ns, const FilterInput& input) {
  FilterStep step = steps_.back();
  step.stamp_ns = stamp_ns;
  step.input = input;
  if (input.kind == FilterInput::Kind::kMove) {
    step.odom = compose(step.odom, step.filter.step_of(input.motion));
  }
  apply(input, step.filter);
  steps_.push_back(step);
  while (stamp_ns - steps_.front().stamp_ns > kKeptNs) {
    steps_.pop_front();
  }
}

std::size_t FilterHistory::nearest(std::int64_t time_ns) const {
  const auto best = std::min_element(steps_.begin(), steps_.end(), [time_ns](const auto& a, const auto& b) {
    return std::abs(a.stamp_ns - time_ns) < std::abs(b.stamp_ns - time_ns);
  });
  return static_cast<std::size_t>(best - steps_.begin());
}

PoseVector FilterHistory::odom_at(std::int64_t time_ns) const {
  auto after = std::lower_bound(steps_.begin(), steps_.end(), time_ns,
                                [](const FilterStep& step, std::int64_t t) { return step.stamp_ns < t; });
  if (after == steps_.end()) {
    --after;
  }
  if (after == steps_.begin() || after->stamp_ns == time_ns) {
    return after->odom;
  }
  const FilterStep& before = *std::prev(after);
  const double share =
      static_cast<double>(time_ns - before.stamp_ns) / static_cast<double>(after->stamp_ns - before.stamp_ns);
  PoseVector pose = before.odom + share * (after->odom - before.odom);
  pose.z() = wrapped(before.odom.z() + share * wrapped(after->odom.z() - before.odom.z()));
  return pose;
}

void FilterHistory::change(std::size_t index, const std::function<void(PoseFilter&)>& change) {
  change(steps_[index].filter);
  for (std::size_t i = index + 1; i < steps_.size(); ++i) {
    steps_[i].filter = steps_[i - 1].filter;
    apply(steps_[i].input, steps_[i].filter);
  }
}

}  // namespace mtr_localization
