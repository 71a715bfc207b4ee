/// @file
/// Lookup and integration of the gyro rate.
// SPDX-License-Identifier: Apache-2.0
#include "motion/yaw_rate_history.hpp"

#include <algorithm>
#include <cstdlib>

#include "one_instant.hpp"

namespace mtr_localization {

bool YawRateHistory::add(const ImuSample& sample) {
  if (newest_received_ns_ && std::abs(sample.stamp_ns - *newest_received_ns_) <= kOneInstantNs) {
    return true;
  }
  const bool ordered = !newest_received_ns_ || sample.stamp_ns > *newest_received_ns_;
  if (!ordered) {
    samples_.clear();
  }
  newest_received_ns_ = sample.stamp_ns;
  if (sample.is_plausible()) {
    samples_.push_back(sample);
  }
  return ordered;
}

bool YawRateHistory::newest_is_good() const {
  return !samples_.empty() && samples_.back().stamp_ns == newest_received_ns_;
}

bool YawRateHistory::covers(std::int64_t time_ns) const {
  return !samples_.empty() && samples_.front().stamp_ns <= time_ns && time_ns <= samples_.back().stamp_ns;
}

const ImuSample& YawRateHistory::sample_at(std::int64_t time_ns) const {
  return *std::lower_bound(samples_.begin(), samples_.end(), time_ns,
                           [](const ImuSample& sample, std::int64_t t) { return sample.stamp_ns < t; });
}

double YawRateHistory::integral(std::int64_t from_ns, std::int64_t to_ns) const {
  double angle_rad = 0.0;
  for (std::size_t i = 1; i < samples_.size(); ++i) {
    const std::int64_t begin_ns = std::max(from_ns, samples_[i - 1].stamp_ns);
    const std::int64_t end_ns = std::min(to_ns, samples_[i].stamp_ns);
    if (begin_ns < end_ns) {
      angle_rad += samples_[i].yaw_rate_radps * static_cast<double>(end_ns - begin_ns) * 1e-9;
    }
  }
  return angle_rad;
}

std::int64_t YawRateHistory::max_gap_ns(std::int64_t from_ns, std::int64_t to_ns) const {
  std::int64_t max_ns = 0;
  for (std::size_t i = 1; i < samples_.size(); ++i) {
    if (samples_[i].stamp_ns > from_ns && samples_[i - 1].stamp_ns < to_ns) {
      max_ns = std::max(max_ns, samples_[i].stamp_ns - samples_[i - 1].stamp_ns);
    }
  }
  return max_ns;
}

void YawRateHistory::forget_before(std::int64_t time_ns) {
  while (samples_.size() > 1 && samples_[1].stamp_ns <= time_ns) {
    samples_.pop_front();
  }
}

}  // namespace mtr_localization
