/// @file
/// Learns the frame of the receiver while the LiDARs determine the pose, and checks fixes against the pose.
// SPDX-License-Identifier: Apache-2.0
#include "gnss/gnss_monitor.hpp"

#include <algorithm>
#include <cmath>

#include "map_names.hpp"
#include "one_instant.hpp"
#include "problems.hpp"

namespace mtr_localization {
namespace {

// Fixes arrive at 1 to 10 Hz, some of them late. Like orders, they take effect this long after their stamp, independent
// of the order of arrival.
constexpr std::int64_t kLagNs = 100'000'000;
// A receiver without corrections has an error of 2 to 5 m in a street.
constexpr double kMaxSigmaM = 5.0;
// Corrected receivers (RTK) claim 1 cm; among buildings their error is below twice that.
constexpr double kMinSigmaM = 0.02;
constexpr double kTwiceAsUncertain = 2.0;
// Reflections from cars and walls shift fixes for some seconds, so only large and persistent deviations count.
constexpr double kFarInSigmas = 5.0;
constexpr double kFarM = 1.0;
constexpr int kContradictions = 5;
// A fix within this distance confirms the pose.
constexpr double kNearInSigmas = 3.0;
// A pose must be this accurate to teach the frame, and a fix to confirm a pose.
constexpr double kKnownSigmaM = 0.1;

Eigen::Matrix<double, 2, 3> antenna_by_pose(const PoseVector& pose, const Eigen::Vector2d& antenna) {
  Eigen::Matrix<double, 2, 3> jacobian = Eigen::Matrix<double, 2, 3>::Identity();
  const Eigen::Vector2d arm = rotation(pose.z()) * antenna;
  jacobian.col(2) << -arm.y(), arm.x();
  return jacobian;
}

}  // namespace

bool GnssMonitor::add(const GnssFix& fix) {
  const bool is_position = std::isfinite(fix.latitude_rad) && std::isfinite(fix.longitude_rad) &&
                           std::abs(fix.latitude_rad) < 0.5 * M_PI && fix.antenna.allFinite();
  if (!is_position || !(fix.sigma_m > 0.0) || fix.sigma_m > kMaxSigmaM ||
      (!waiting_.empty() && fix.stamp_ns <= waiting_.back().stamp_ns + kOneInstantNs)) {
    ++figures_.refused;
    return false;
  }
  waiting_.push_back(fix);
  waiting_.back().sigma_m = std::max(fix.sigma_m, kMinSigmaM);
  return true;
}

void GnssMonitor::clear() {
  waiting_.clear();
  frame_.clear();
  contradictions_ = 0;
  agreed_ns_ = 0;
  figures_.residual_m = 0.0;
}

mtr_core::Problem GnssMonitor::use_due(const ScanTracker& tracker, FilterHistory& history) {
  mtr_core::Problem problem;
  while (!waiting_.empty() && waiting_.front().stamp_ns + kLagNs <= history.newest().stamp_ns) {
    const GnssFix fix = waiting_.front();
    waiting_.pop_front();
    // A fix older than the history is too late.
    if (!problem && fix.stamp_ns >= history.oldest().stamp_ns) {
      problem = use(fix, tracker, history);
    }
  }
  return problem;
}

mtr_core::Problem GnssMonitor::use(const GnssFix& fix, const ScanTracker& tracker, FilterHistory& history) {
  if (tracker.lost() || tracker.state() == ScanTracker::State::kNoMap) {
    contradictions_ = 0;
    return {};
  }
  const FilterStep& step = history.at(history.nearest(fix.stamp_ns));
  const std::optional<GnssPosition> seen = frame_.in_map(fix);
  if (seen && tracker.state() == ScanTracker::State::kLocalized) {
    mtr_core::Problem problem = compare(fix, *seen, history);
    if (problem || contradictions_ > 0) {
      return problem;
    }
  }
  if (!tracker.degenerate() && step.filter.position_sigma_m() < kKnownSigmaM) {
    frame_.learn(fix, transformed(step.filter.pose(), fix.antenna));
  }
  return {};
}

mtr_core::Problem GnssMonitor::compare(const GnssFix& fix, const GnssPosition& seen, FilterHistory& history) {
  const std::size_t index = history.nearest(fix.stamp_ns);
  const PoseFilter& filter = history.at(index).filter;
  const Eigen::Vector2d residual = seen.position - transformed(filter.pose(), fix.antenna);
  const Eigen::Matrix<double, 2, 3> jacobian = antenna_by_pose(filter.pose(), fix.antenna);
  const double pose_sigma_m = worst_sigma_m(jacobian * filter.pose_covariance() * jacobian.transpose());
  figures_.residual_m = residual.norm();
  if (figures_.residual_m > kFarM && figures_.residual_m > kFarInSigmas * std::hypot(seen.sigma_m, pose_sigma_m)) {
    if (++contradictions_ < kContradictions) {
      return {};
    }
    contradictions_ = 0;
    return problems::kElsewhere({{"distance_m", figures_.residual_m}});
  }
  contradictions_ = 0;
  if (seen.sigma_m <= kKnownSigmaM && figures_.residual_m <= kNearInSigmas * std::hypot(seen.sigma_m, pose_sigma_m)) {
    agreed_ns_ = fix.stamp_ns;
  }
  if (pose_sigma_m > kTwiceAsUncertain * seen.sigma_m) {
    const double weight = 1.0 / (seen.sigma_m * seen.sigma_m);
    PoseCorrection correction;
    correction.information_vector = weight * jacobian.transpose() * residual;
    correction.information = weight * jacobian.transpose() * jacobian;
    history.change(index, [&](PoseFilter& corrected) { corrected.correct(correction); });
    ++figures_.used;
  }
  return {};
}

}  // namespace mtr_localization
