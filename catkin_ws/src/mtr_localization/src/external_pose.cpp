/// @file
/// Poses, validity and key frames from the transform of another program.
// SPDX-License-Identifier: Apache-2.0
#include "external_pose.hpp"

#include <utility>

#include "problems.hpp"
#include "scans/deskew.hpp"

namespace mtr_localization {
namespace {

/// Returns key frames without adjustment.
AdjustedMap unadjusted(const std::vector<KeyFrame>& key_frames) {
  GrowingMap points;
  AdjustedMap map;
  for (const KeyFrame& frame : key_frames) {
    points.insert(frame.pose, frame.scan);
    map.pose_covariances.push_back(Eigen::Matrix3d::Zero());
  }
  map.surfels = points.surfels();
  map.key_frames = key_frames;
  map.valid = !map.surfels.empty();
  map.message = map.valid ? problems::kNotAdjusted() : problems::kNoScan();
  return map;
}

}  // namespace

ExternalPose::ExternalPose(const Parameters& parameters, const ExternalParameters& own, LookUp look_up)
    : PoseSource(parameters, unadjusted), own_(own), look_up_(std::move(look_up)) {}

void ExternalPose::look_up() {
  if (const std::optional<StampedPose> newest = look_up_()) {
    map_from_odom_ = newest;
  }
}

Estimate ExternalPose::step(const GatedSample& sample) {
  const std::int64_t now_ns = sample.wheels.stamp_ns;
  look_up();
  odometry().predict(sample, gyro(), false);
  mapper().travel(history().newest().input, filter().pose().z(), false);
  if (mapper().begins(now_ns)) {
    odometry().begin_map();
  }
  mapper().finish(now_ns);
  correct_by_scans();
  return answer(now_ns, problem_at(now_ns));
}

bool ExternalPose::correct_by_scans() {
  const std::vector<ScanSet> sets = scans().take_due(history());
  for (const ScanSet& set : sets) {
    if (map_from_odom_) {
      const FilterStep& here = history().at(set.step);
      mapper().add({deskew(set, history()), compose(map_from_odom_->pose, here.odom), here.odom, odometry().standing(),
                    here.filter.gyro_bias_sigma_radps()});
    }
  }
  return !sets.empty();
}

mtr_core::Problem ExternalPose::problem_at(std::int64_t stamp_ns) const {
  if (odometry().state() != MotionState::kTracking) {
    return odometry().problem();
  }
  const bool is_fresh =
      map_from_odom_ && static_cast<double>(stamp_ns - map_from_odom_->stamp_ns) * 1e-9 <= own_.external_timeout_s;
  return is_fresh ? mtr_core::Problem{} : problems::kWaitingForOther();
}

Estimate ExternalPose::pose_at(std::int64_t stamp_ns) const {
  const double position = own_.external_position_sigma_m;
  const double heading = own_.external_heading_sigma_rad;
  const Eigen::Vector3d variances(position * position, position * position, heading * heading);
  const PoseVector map_from_odom = map_from_odom_.value_or(StampedPose{}).pose;
  Estimate estimate = estimate_of(stamp_ns, compose(map_from_odom, history().newest().odom), variances.asDiagonal());
  if (odometry().state() == MotionState::kLost) {
    estimate.mode = PoseMode::kLost;
  } else if (map_from_odom_) {
    estimate.mode = PoseMode::kLocalized;
  }
  return estimate;
}

}  // namespace mtr_localization
