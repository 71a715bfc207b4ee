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

// A drive round a Car at 1 m distance gives about 60 key frames.
constexpr std::size_t kMinKeyFrames = 10;
// The Car alone gives 50 to 150 surfels.
constexpr std::size_t kMinSurfels = 20;
// Loop closure compares the surfels of the last key frame with the surfels seen earlier at the same place. The limit is
// a share, because next to a Car alone a noisy LiDAR sees fewer than ten long surfels. The minimum count is enough to
// constrain a pose.
constexpr double kSharedShare = 0.4;
constexpr int kMinSharedSurfels = 3;
// A closed path must be this many times longer than the closing distance, so that a stationary or manoeuvring robot
// does not count.
constexpr double kMinLoop = 4.0;
// Limits of the residuals in sigmas and of the outlier share. No scene with correctly specified sensors has exceeded
// them.
constexpr double kMaxRatio = 3.0;
constexpr double kMaxMotionRatio = 20.0;
constexpr double kMaxOutlierShare = 0.3;
// Slipping wheels and a noisy gyro cause smaller errors between key frames, which are 0.3 m or 0.25 rad apart. A map
// that mistook the ground for walls had three jumps of 0.2 to 0.6 m and 0.9 to 2.6 deg. Ten correct maps on the same
// ground had no excluded motion.
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

/// Returns true if the path came back to an earlier place and saw the same surfels there. A LiDAR with a limited field
/// of view sees other surfels under another heading, so the required share refers to the smaller of both views.
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
