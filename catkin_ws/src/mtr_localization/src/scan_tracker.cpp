/// @file
/// Agreement first, then correction; search while lost.
// SPDX-License-Identifier: Apache-2.0
#include "mtr_localization/scan_tracker.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "mtr_localization/map_names.hpp"

namespace mtr_localization {
namespace {

// Fewer expected beams than these say nothing about being lost: a Car 12 m away is met by 20 of one degree.
constexpr int kLeastEvidence = 8;
constexpr int kLeastMatched = 5;
constexpr double kToleranceM = 0.12;
// A scan and its prior contradict each other: chi squared with 3 degrees of freedom, once in a million.
constexpr double kContradiction = 30.7;
// Lever that makes an angle comparable with a distance.
constexpr double kLeverM = 1.0;
constexpr double kLeastInformation = 1e-6;
// While the map grows, wheels and gyro carry the pose over places where a LiDAR on uneven ground looks over and under
// bumpers and sills by turns: over 14 m of a way round they were 4 to 6 cm off in simulation. What is seen meanwhile
// joins the map.
constexpr double kMostBridgedM = 2.0;
// A robot that moved less since the view agreed was carried, or something stands before it.
constexpr double kStoodM = 0.05;
// Sweeps that must agree, one after the other, with where wheels and gyro say the robot is.
constexpr int kAgreementsToResume = 5;

constexpr char kLost[] =
    "Position lost: the LiDAR does not see what the map shows here. Searching near the last position.";
// No search: beside a Car alone a map of half a way round has places that look alike.
constexpr char kLostWhileMapping[] =
    "Position lost: the LiDAR does not see what it saw on the way. Unless it does again, map the Car again.";

double weakest_sigma_m(const Eigen::Matrix3d& information) {
  const Eigen::Vector3d scale(1.0, 1.0, 1.0 / kLeverM);
  const Eigen::Matrix3d scaled = scale.asDiagonal() * information * scale.asDiagonal();
  const double least =
      Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(scaled, Eigen::EigenvaluesOnly).eigenvalues().minCoeff();
  return 1.0 / std::sqrt(std::max(least, kLeastInformation));
}

/// Shift that the scan alone asks for, where it holds the pose at all.
Eigen::Vector3d shift_of(const PoseCorrection& correction) {
  const Eigen::Matrix3d held = correction.information + Eigen::Vector3d(1.0, 1.0, 1.0).asDiagonal().toDenseMatrix();
  return held.inverse() * correction.pull;
}

double contradiction(const PoseCorrection& correction, const Eigen::Matrix3d& prior) {
  const Eigen::Matrix3d& information = correction.information;
  const Eigen::Matrix3d spread =
      information + information * prior * information + kLeastInformation * Eigen::Matrix3d::Identity();
  return correction.pull.dot(spread.inverse() * correction.pull);
}

PosePrior prior_of(const PoseFilter& filter) {
  return {filter.pose(), filter.prior_covariance(), filter.pose_covariance()};
}

}  // namespace

void ScanTracker::begin_mapping(FilterHistory& history) {
  state_ = State::kMapping;
  growing_.clear();
  map_ = std::make_unique<ReferenceMap>();
  search_.reset();
  lost_reason_.clear();
  degenerate_ = false;
  history.change(history.size() - 1, [](PoseFilter& filter) { filter.consider_sources(0); });
  history.restart(history.newest().filter, history.newest().stamp_ns, history.newest().odom);
  agreed_ns_ = history.newest().stamp_ns;
  agreed_odom_ = history.newest().odom;
}

void ScanTracker::extend(const PoseVector& pose, const ScanPoints& scan) {
  growing_.insert(pose, scan);
  auto map = std::make_unique<ReferenceMap>();
  map->surfaces = SurfelMap(growing_.surfels());
  map_ = std::move(map);
  // A search refers to the map that it began with.
  search_.reset();
}

void ScanTracker::freeze(const AdjustedMap& adjusted, FilterHistory& history) {
  auto map = std::make_unique<ReferenceMap>();
  map->sources = error_sources_of(adjusted.surfels);
  map->surfaces = SurfelMap(adjusted.surfels);
  map->range_bias_m = adjusted.range_bias_m;
  map->range_bias_sigma_m = adjusted.range_bias_sigma_m;
  search_.reset();
  map_ = std::move(map);
  state_ = State::kLocalized;
  const int sources = map_->sources.count + 1;
  history.change(history.size() - 1, [sources](PoseFilter& filter) { filter.consider_sources(sources); });
  history.restart(history.newest().filter, history.newest().stamp_ns, history.newest().odom);
  agreed_ns_ = history.newest().stamp_ns;
  agreed_odom_ = history.newest().odom;
}

void ScanTracker::lose(const std::string& reason) {
  lose_sight(reason);
  is_reckoned_ = state_ == State::kMapping;
}

void ScanTracker::lose_sight(const std::string& reason) {
  lost_reason_ = reason;
  degenerate_ = false;
  agreeing_ = 0;
  is_reckoned_ = true;
}

void ScanTracker::track(const Look& look, FilterHistory& history) {
  if (state_ == State::kNoMap || map_->surfaces.surfels().empty()) {
    return;
  }
  if (!lost()) {
    judge(look, history);
  }
  if (lost()) {
    // Where the view is the expected one again, the pose by wheels and gyro is better than one that is searched for. A
    // half-made map is not searched at all.
    if (is_reckoned_) {
      resume(look, history);
    }
    if (lost() && state_ == State::kLocalized) {
      search(look, history);
    }
  } else if (agrees_) {
    correct(look, history);
  } else {
    degenerate_ = true;
  }
}

Agreement ScanTracker::agreement(const Look& look, const FilterHistory& history) const {
  const FilterStep& step = history.at(look.step);
  const double sigma_m = position_sigma(history.newest().filter);
  Agreement all;
  for (const Sweep& sweep : look.sweeps) {
    ViewPose view{step.filter.pose()};
    view.turned_at_first_beam_rad = wrapped(history.odom_at(sweep.stamp_ns).z() - step.odom.z());
    view.turned_at_last_beam_rad = wrapped(history.odom_at(sweep.last_beam_ns()).z() - step.odom.z());
    view.slope = step.input.slope;
    all += agreement_of(sweep, view, map_->surfaces, kToleranceM + 3.0 * sigma_m);
  }
  return all;
}

bool ScanTracker::agrees(const Agreement& all) {
  // Either is enough. Where the ground is uneven the LiDAR looks over or under what is expected, or meets the ground
  // all round; a pose that is wrong fails both.
  figures_.agreement = std::max(all.share_of_expected(), all.share_of_returns());
  return all.expected() < kLeastEvidence || figures_.agreement >= parameters_.least_agreement;
}

void ScanTracker::judge(const Look& look, const FilterHistory& history) {
  const FilterStep& step = history.at(look.step);
  const Agreement all = agreement(look, history);
  agrees_ = agrees(all);
  if (agrees_) {
    agreed_ns_ = step.stamp_ns;
    agreed_odom_ = step.odom;
  } else if (is_beyond_patience(all, step)) {
    lose_sight(state_ == State::kMapping ? kLostWhileMapping : kLost);
  }
  if (position_sigma(history.newest().filter) > parameters_.lost_sigma_m && state_ == State::kLocalized) {
    lose_sight("Position lost: nothing of the map has been in view for too long. Searching near the last position.");
  }
}

bool ScanTracker::is_beyond_patience(const Agreement& all, const FilterStep& step) const {
  const double bridged_m = relative(agreed_odom_, step.odom).head<2>().norm();
  if (state_ == State::kMapping && bridged_m > kStoodM) {
    return bridged_m > kMostBridgedM;
  }
  const bool is_hidden = all.hidden > all.beyond + all.missing + all.passed;
  const double patience_s = is_hidden ? parameters_.lost_hidden_after_s : parameters_.lost_after_s;
  return static_cast<double>(step.stamp_ns - agreed_ns_) * 1e-9 >= patience_s;
}

void ScanTracker::resume(const Look& look, const FilterHistory& history) {
  const Agreement all = agreement(look, history);
  // What is expected of a place that is hardly known agrees with much.
  const bool is_known =
      state_ == State::kMapping || position_sigma(history.newest().filter) <= parameters_.lost_sigma_m;
  agreeing_ = is_known && agrees(all) && all.expected() >= kLeastEvidence ? agreeing_ + 1 : 0;
  if (agreeing_ >= kAgreementsToResume) {
    lost_reason_.clear();
    agreed_ns_ = history.at(look.step).stamp_ns;
    agreed_odom_ = history.at(look.step).odom;
    agrees_ = true;
    search_.reset();
  }
}

void ScanTracker::correct(const Look& look, FilterHistory& history) {
  PosePrior prior = prior_of(history.at(look.step).filter);
  ScanMatch match = matcher_.match(look.scan, *map_, prior);
  figures_.points = match.points;
  figures_.matched = match.matched;
  figures_.residual_rms = match.residual_rms;
  figures_.weakest_sigma_m = weakest_sigma_m(match.correction.information);
  degenerate_ = figures_.weakest_sigma_m > parameters_.degenerate_sigma_m;
  if (match.matched < kLeastMatched) {
    return;
  }
  if (contradiction(match.correction, prior.full_covariance) > kContradiction) {
    // It was pushed, or slid: the prior's covariance does not know of that.
    const Eigen::Vector3d shift = shift_of(match.correction);
    const Eigen::Matrix3d surprise = shift.cwiseAbs2().asDiagonal();
    history.change(look.step, [&](PoseFilter& filter) { filter.add_pose_noise(surprise); });
    prior = prior_of(history.at(look.step).filter);
    match = matcher_.match(look.scan, *map_, prior);
  }
  history.change(look.step, [&](PoseFilter& filter) { filter.correct(match.correction); });
}

void ScanTracker::search(const Look& look, FilterHistory& history) {
  const FilterStep& step = history.at(look.step);
  const PoseSearch::Look view{look.sweeps.front(), look.scan, step.odom, step.input.slope};
  if (!search_) {
    search_.emplace(parameters_, *map_);
    search_->begin(step.filter.pose(), view);
    return;
  }
  if (const auto found = search_->advance(view)) {
    history.change(look.step, [&](PoseFilter& filter) { filter.set_pose(found->pose, found->covariance); });
    lost_reason_.clear();
    agreed_ns_ = step.stamp_ns;
    agreed_odom_ = step.odom;
    agrees_ = true;
    search_.reset();
  }
}

double ScanTracker::position_sigma(const PoseFilter& filter) const {
  const Eigen::Matrix2d covariance = filter.pose_covariance().topLeftCorner<2, 2>();
  return std::sqrt(
      Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d>(covariance, Eigen::EigenvaluesOnly).eigenvalues().maxCoeff());
}

}  // namespace mtr_localization
