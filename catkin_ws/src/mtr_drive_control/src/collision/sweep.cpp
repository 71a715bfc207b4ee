/// @file
/// Detects faults of a LiDAR from its sweeps.
// SPDX-License-Identifier: Apache-2.0
#include "mtr_drive_control/collision/sweep.hpp"

#include <algorithm>
#include <cmath>

#include "mtr_core/steady_time.hpp"
#include "problems.hpp"

namespace mtr_drive_control {
namespace {

// Noise changes some range of a live LiDAR in every sweep, unless almost nothing is in range.
constexpr int kFrozenAfterRepetitions = 2;
constexpr std::ptrdiff_t kFewestEchoesToTell = 10;
// A turn of the slowest supported LiDAR lasts 0.2 s.
constexpr double kMaxSweepS = 0.25;
// Limit of the time between beams relative to its value from the LiDAR's turns; some firmware states three times as
// much.
constexpr double kMostTimeRatio = 1.5;
constexpr double kPi = 3.14159265358979323846;
constexpr double kMicroseconds = 1e6;
// A hand, mud or a wrong driver on this share of the view makes the LiDAR blind.
constexpr double kCoveredShare = 0.5;
// Three beams meet a leg of 0.14 m at 1.3 m.
constexpr double kWidestStepRad = 0.035;

/// Detects impossible sweep times, which would give the echoes a wrong age.
mtr_core::Problem time_defect(const Sweep& sweep, const std::string& lidar) {
  const double sweep_s = sweep.time_increment_s * static_cast<double>(sweep.ranges_m.size() - 1);
  if (!(sweep_s >= 0.0) || sweep_s > kMaxSweepS) {
    return problems::kLidarSweepTime({{"lidar", lidar}, {"sweep_s", sweep_s}, {"most_s", kMaxSweepS}});
  }
  const double by_turns_s = sweep.scan_time_s * std::abs(sweep.angle_increment_rad) / (2.0 * kPi);
  if (by_turns_s > 0.0 && sweep.time_increment_s > kMostTimeRatio * by_turns_s) {
    return problems::kLidarTimeIncrement({{"lidar", lidar},
                                          {"stated_us", kMicroseconds * sweep.time_increment_s},
                                          {"expected_us", kMicroseconds * by_turns_s}});
  }
  return {};
}

}  // namespace

mtr_core::Problem defect_of(const Sweep& sweep, const std::string& lidar) {
  if (sweep.frame_id != sweep.expected_frame_id) {
    return problems::kLidarFrame({{"lidar", lidar}, {"frame", sweep.frame_id}, {"expected", sweep.expected_frame_id}});
  }
  if (sweep.ranges_m.size() < 2) {
    return problems::kLidarWithoutBeams({{"lidar", lidar}});
  }
  if (!std::isfinite(sweep.angle_min_rad) || !(std::abs(sweep.angle_increment_rad) > 0.0) ||
      !std::isfinite(sweep.angle_increment_rad) || !std::isfinite(sweep.time_increment_s)) {
    return problems::kLidarNotNumbers({{"lidar", lidar}});
  }
  if (mtr_core::Problem problem = time_defect(sweep, lidar)) {
    return problem;
  }
  if (std::abs(sweep.angle_increment_rad) > kWidestStepRad) {
    return problems::kLidarTooCoarse({{"lidar", lidar}, {"step_deg", sweep.angle_increment_rad * 180.0 / kPi}});
  }
  if (!(sweep.range_min_m >= 0.0) || !(sweep.range_max_m > sweep.range_min_m)) {
    return problems::kLidarWithoutRange({{"lidar", lidar}});
  }
  std::size_t seeing = 0;
  for (std::size_t beam = 0; beam < sweep.ranges_m.size(); ++beam) {
    seeing += sweep.is_echo(beam) || sweep.is_far(beam) ? 1 : 0;
  }
  const double covered = 1.0 - static_cast<double>(seeing) / static_cast<double>(sweep.ranges_m.size());
  return covered > kCoveredShare ? problems::kLidarCovered({{"lidar", lidar}}) : mtr_core::Problem{};
}

bool LidarWatch::take(const std::shared_ptr<const Sweep>& sweep) {
  if (!sweep || (newest_ && sweep->stamp_ns == newest_->stamp_ns)) {
    return false;
  }
  repetitions_ = newest_ && repeats(*sweep) ? repetitions_ + 1 : 0;
  newest_ = sweep;
  defect_ = defect_of(*sweep, name_);
  has_wrong_times_ =
      defect_.code == problems::kLidarSweepTime.code || defect_.code == problems::kLidarTimeIncrement.code;
  if (!defect_ && repetitions_ >= kFrozenAfterRepetitions) {
    defect_ = problems::kLidarFrozen({{"lidar", name_}});
  }
  return !defect_;
}

mtr_core::Problem LidarWatch::problem_at(std::int64_t tick_ns) const {
  if (!newest_) {
    return problems::kWaitingForLidar({{"lidar", name_}});
  }
  // Wrong times make a sweep look old, so they are reported as the cause.
  if (has_wrong_times_) {
    return defect_;
  }
  if (!mtr_core::is_fresh(newest_->stamp_ns, tick_ns, timeout_s_)) {
    const bool is_old = newest_->stamp_ns < tick_ns;
    return (is_old ? problems::kLidarSilent : problems::kLidarInFuture)({{"lidar", name_}});
  }
  return defect_;
}

bool LidarWatch::repeats(const Sweep& sweep) const {
  const auto& ranges = sweep.ranges_m;
  const auto echoes = std::count_if(ranges.begin(), ranges.end(), [](float range) { return std::isfinite(range); });
  // NaN is never equal, so a repeated sweep may contain it at the same beams.
  return echoes >= kFewestEchoesToTell &&
         std::equal(ranges.begin(), ranges.end(), newest_->ranges_m.begin(), newest_->ranges_m.end(),
                    [](float a, float b) { return a == b || (std::isnan(a) && std::isnan(b)); });
}

}  // namespace mtr_drive_control
