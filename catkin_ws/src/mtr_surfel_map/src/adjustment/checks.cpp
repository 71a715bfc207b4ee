/// @file
/// Conditions that a map must meet.
// SPDX-License-Identifier: Apache-2.0
#include "adjustment/checks.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <set>

#include "problems.hpp"

namespace mtr_surfel_map {
namespace {

// A way round a Car at 1 m gives some 60 key frames.
constexpr std::size_t kMinKeyFrames = 10;
// The Car alone gives 50 to 150 surfels.
constexpr std::size_t kMinSurfels = 20;
// Surfels of the last key frame that were seen when the robot was here before: a share, for beside a Car alone
// a key frame of a noisy LiDAR sees fewer than ten long ones; and enough to hold a pose.
constexpr double kSharedShare = 0.4;
constexpr int kMinSharedSurfels = 3;
// A return is a path of this many times the closing distance, so that a robot that stands or shuffles has not closed.
constexpr double kMinLoop = 4.0;
// Sizes of differences in sigmas, and share of outliers, that no scene with right sensors has shown.
constexpr double kMaxRatio = 3.0;
constexpr double kMaxMotionRatio = 20.0;
constexpr double kMaxOutlierShare = 0.3;
// From one key frame to the next, 0.3 m or 0.25 rad on, wheels that slip and a gyro that scatters are off by less. With
// ground taken for walls one map had three jumps of 0.2 to 0.6 m and 0.9 to 2.6 deg; ten right ones on the same ground
// had no motion that was excluded at all.
constexpr double kMaxJumpM = 0.15;
constexpr double kMaxJumpRad = 0.015;
constexpr double kDegPerRad = 180.0 / M_PI;

bool is_finite(const KeyFrame& frame) {
  const auto finite = [](const ScanPoint& point) { return point.position.allFinite() && point.direction.allFinite(); };
  return frame.pose.allFinite() && frame.motion.allFinite() && frame.motion_covariance.allFinite() &&
         std::all_of(frame.scan.points.begin(), frame.scan.points.end(), finite);
}

std::set<int> surfels_seen_by(int key_frame, const std::vector<Observation>& observations) {
  std::set<int> surfels;
  for (const Observation& seen : observations) {
    if (seen.key_frame == key_frame) {
      surfels.insert(seen.surfel);
    }
  }
  return surfels;
}

int shared(const std::set<int>& a, const std::set<int>& b) {
  return static_cast<int>(std::count_if(a.begin(), a.end(), [&](int surfel) { return b.count(surfel) > 0; }));
}

/// The path came back to an earlier place and saw the same from there. A LiDAR that does not look everywhere, and looks
/// another way than before, sees more that is new: of the smaller of both views a share has to be in the other.
bool is_closed(const std::vector<KeyFrame>& frames, const std::vector<Observation>& observations,
               double closing_distance_m) {
  const int last = static_cast<int>(frames.size()) - 1;
  std::set<int> seen_before;
  double path_m = 0.0;
  for (int i = last - 1; i >= 0; --i) {
    path_m += (frames[i + 1].pose - frames[i].pose).head<2>().norm();
    const double distance_m = (frames[last].pose - frames[i].pose).head<2>().norm();
    if (path_m > kMinLoop * closing_distance_m && distance_m < closing_distance_m) {
      seen_before.merge(surfels_seen_by(i, observations));
    }
  }
  const std::set<int> seen_last = surfels_seen_by(last, observations);
  const double wanted = kSharedShare * static_cast<double>(std::min(seen_last.size(), seen_before.size()));
  return shared(seen_last, seen_before) >= std::max<double>(kMinSharedSurfels, wanted);
}

std::int64_t whole(std::size_t count) { return static_cast<std::int64_t>(count); }

}  // namespace

mtr_core::Problem problem_with(const std::vector<KeyFrame>& key_frames) {
  if (key_frames.size() < kMinKeyFrames) {
    return problems::kFewKeyFrames({{"count", whole(key_frames.size())}, {"needed", whole(kMinKeyFrames)}});
  }
  if (!std::all_of(key_frames.begin(), key_frames.end(), is_finite)) {
    return problems::kNotNumbers();
  }
  return {};
}

mtr_core::Problem problem_with(const Adjustment& state, const std::vector<Observation>& observations, const Fit& fit,
                               const AdjustmentParameters& parameters) {
  if (state.surfels.size() < kMinSurfels) {
    return problems::kFewSurfaces({{"count", whole(state.surfels.size())}, {"needed", whole(kMinSurfels)}});
  }
  if (!is_closed(state.key_frames, observations, parameters.closing_distance_m)) {
    return problems::kNotClosed({{"limit_m", parameters.closing_distance_m}});
  }
  if (fit.surface_ratio > kMaxRatio) {
    return problems::kScansDisagree({{"ratio", fit.surface_ratio}});
  }
  if (fit.outlier_share > kMaxOutlierShare) {
    return problems::kOutliers({{"percent", 100.0 * fit.outlier_share}});
  }
  if (fit.jump.distance_m > kMaxJumpM || fit.jump.angle_rad > kMaxJumpRad) {
    return problems::kJump({{"distance_m", fit.jump.distance_m}, {"angle_deg", kDegPerRad * fit.jump.angle_rad}});
  }
  if (fit.motion_ratio > kMaxMotionRatio) {
    return problems::kMotionDisagrees({{"ratio", fit.motion_ratio}});
  }
  return {};
}

}  // namespace mtr_surfel_map
