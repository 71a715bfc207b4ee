/// @file
/// Order, completeness and grouping of sweeps.
// SPDX-License-Identifier: Apache-2.0
#include "scans/scan_queue.hpp"

#include <algorithm>
#include <utility>

#include "one_instant.hpp"

namespace mtr_localization {
namespace {

// A larger jump back of the driver's time means that it was restarted.
constexpr std::int64_t kRestartNs = 1'000'000'000;
// Limit of waiting sweeps per LiDAR: without wheel odometry nothing is used, and the oldest sweeps are dropped.
constexpr std::ptrdiff_t kMaxWaiting = 20;
// On the robot's clock, a sweep does not wait for the next wheel message, which arrives within 20 ms. In this time,
// braking with 2.5 m/s2 causes less than 1 mm of extrapolation error.
constexpr std::int64_t kExtrapolatedNs = 25'000'000;
// Smallest number of ranges for the detection of a frozen LiDAR. Among 4,000 sweeps of a SICK S3000, a NAV350 and
// Hokuyos, on stationary and moving robots, no sweep equalled its predecessor. With fewer ranges, LiDARs with a
// resolution of centimetres may repeat a sweep.
constexpr std::ptrdiff_t kMinRepeated = 20;

}  // namespace

std::string ScanQueue::add(Sweep sweep) {
  const std::string problem = problem_with(sweep);
  if (!problem.empty()) {
    ++refused_;
    return problem;
  }
  // A LiDAR whose stamps run ahead must not displace sweeps of the other one.
  const auto is_of_same = [lidar = sweep.lidar](const Sweep& other) { return other.lidar == lidar; };
  newest_ns_[static_cast<std::size_t>(sweep.lidar)] = sweep.stamp_ns;
  newest_ranges_[static_cast<std::size_t>(sweep.lidar)] = sweep.ranges_m;
  // Equal stamps are sorted by LiDAR, so that the order of arrival does not matter.
  const auto place = std::upper_bound(waiting_.begin(), waiting_.end(), sweep, [](const Sweep& a, const Sweep& b) {
    return std::make_pair(a.stamp_ns, a.lidar) < std::make_pair(b.stamp_ns, b.lidar);
  });
  waiting_.insert(place, std::move(sweep));
  if (std::count_if(waiting_.begin(), waiting_.end(), is_of_same) > kMaxWaiting) {
    waiting_.erase(std::find_if(waiting_.begin(), waiting_.end(), is_of_same));
    ++refused_;
  }
  return "";
}

std::string ScanQueue::problem_with(const Sweep& sweep) const {
  const std::string problem = sweep.problem();
  if (!problem.empty()) {
    return problem;
  }
  const auto& newest_ns = newest_ns_[static_cast<std::size_t>(sweep.lidar)];
  const bool is_restart = newest_ns && sweep.stamp_ns < *newest_ns - kRestartNs;
  if (newest_ns && sweep.stamp_ns <= *newest_ns + kOneInstantNs && !is_restart) {
    return "A scan is not newer than the previous one; look for a second driver on its topic, or a clock that was set.";
  }
  return is_repeated(sweep)
             ? "A scan repeats all ranges of the previous one: the LiDAR or its driver is frozen; restart it."
             : "";
}

bool ScanQueue::is_repeated(const Sweep& sweep) const {
  const auto returns = std::count_if(sweep.ranges_m.begin(), sweep.ranges_m.end(), [&sweep](float range_m) {
    return range_m >= sweep.range_min_m && range_m < sweep.range_max_m;
  });
  return returns >= kMinRepeated && sweep.ranges_m == newest_ranges_[static_cast<std::size_t>(sweep.lidar)];
}

std::int64_t ScanQueue::due_ns(const Sweep& sweep) const {
  return lag_ns_ ? sweep.end_ns() + *lag_ns_ : sweep.last_beam_ns() - kExtrapolatedNs;
}

std::vector<ScanSet> ScanQueue::take_due(const FilterHistory& history) {
  std::vector<ScanSet> sets;
  std::deque<Sweep> later;
  for (Sweep& sweep : waiting_) {
    if (due_ns(sweep) > history.newest().stamp_ns) {
      later.push_back(std::move(sweep));
    } else if (sweep.stamp_ns < history.oldest().stamp_ns) {
      // The sweep arrived too late, or while the pose was reset.
      ++refused_;
    } else {
      const std::int64_t middle_ns = sweep.stamp_ns + (sweep.last_beam_ns() - sweep.stamp_ns) / 2;
      const std::size_t step = history.nearest(middle_ns);
      if (sets.empty() || sets.back().step != step) {
        sets.push_back({{}, step});
      }
      sets.back().sweeps.push_back(std::move(sweep));
      ++used_;
    }
  }
  waiting_ = std::move(later);
  return sets;
}

}  // namespace mtr_localization
