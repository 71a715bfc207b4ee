/// @file
/// The tracked map, and what becomes of a pose whose view does not agree with it.
// SPDX-License-Identifier: Apache-2.0
#include "tracking/tracker.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "map_names.hpp"
#include "problems.hpp"

namespace mtr_localization {
namespace {

// Fewer expected beams than these say nothing about being lost: a Car 12 m away is met by 20 of one degree.
constexpr int kMinEvidence = 8;
constexpr int kMinMatched = 5;
constexpr double kToleranceM = 0.12;
// Lever that makes an angle comparable with a distance.
constexpr double kLeverM = 1.0;
constexpr double kMinInformation = 1e-6;
// While the map grows, wheels and gyro carry the pose over places where a LiDAR on uneven ground looks over and under
// bumpers and sills by turns: over 14 m of a way round they were 4 to 6 cm off in simulation. What is seen meanwhile
// joins the map.
constexpr double kMaxBridgedM = 2.0;
// A robot that moved less since the view agreed was carried, or something stands before it.
constexpr double kStoodM = 0.05;
// Sweeps that must agree, one after the other, with where wheels and gyro say the robot is.
constexpr int kAgreementsToResume = 5;

double weakest_sigma_m(const Eigen::Matrix3d& information) {
  const Eigen::Vector3d scale(1.0, 1.0, 1.0 / kLeverM);
  const Eigen::Matrix3d scaled = scale.asDiagonal() * information * scale.asDiagonal();
  const double least =
      Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(scaled, Eigen::EigenvaluesOnly).eigenvalues().minCoeff();
  return 1.0 / std::sqrt(std::max(least, kMinInformation));
}

double position_sigma_m(const PoseFilter& filter) {
  const Eigen::Matrix2d covariance = filter.pose_covariance().topLeftCorner<2, 2>();
  return std::sqrt(
      Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d>(covariance, Eigen::EigenvaluesOnly).eigenvalues().maxCoeff());
}

}  // namespace

void ScanTracker::begin_map(const FilterStep& here) {
  state_ = State::kMapping;
  growing_.clear();
  map_ = std::make_unique<ReferenceMap>();
  degenerate_ = false;
  find(here);
}

void ScanTracker::extend(const KeyFrame& frame) {
  growing_.insert(frame.pose, frame.scan);
  auto map = std::make_unique<ReferenceMap>();
  map->surfaces = SurfelMap(growing_.surfels());
  map_ = std::move(map);
  // A search refers to the map that it began with.
  search_.reset();
}

int ScanTracker::enter(const AdjustedMap& adjusted, const FilterStep& here) {
  auto map = std::make_unique<ReferenceMap>();
  map->sources = error_sources_of(adjusted.surfels);
  map->surfaces = SurfelMap(adjusted.surfels);
  map->range_bias_m = adjusted.range_bias_m;
  map->range_bias_sigma_m = adjusted.range_bias_sigma_m;
  search_.reset();
  map_ = std::move(map);
  state_ = State::kLocalized;
  agreed_ns_ = here.stamp_ns;
  agreed_odom_ = here.odom;
  // The constant error of the range is one more.
  return map_->sources.count + 1;
}

void ScanTracker::lose(const mtr_core::Problem& reason) {
  lose_sight(reason);
  is_reckoned_ = state_ == State::kMapping;
}

void ScanTracker::lose_sight(const mtr_core::Problem& reason) {
  lost_reason_ = reason;
  degenerate_ = false;
  agreeing_ = 0;
  is_reckoned_ = true;
}

void ScanTracker::find(const FilterStep& step) {
  lost_reason_ = {};
  agreed_ns_ = step.stamp_ns;
  agreed_odom_ = step.odom;
  search_.reset();
}

Judgement ScanTracker::judge(const ScanSet& set, const FilterHistory& history) {
  if (!has_map() || map_->surfaces.surfels().empty()) {
    return Judgement::kNoMap;
  }
  if (lost()) {
    return Judgement::kLost;
  }
  const FilterStep& step = history.at(set.step);
  const Agreement all = agreement(set, history);
  const bool is_right = agrees(all);
  if (is_right) {
    agreed_ns_ = step.stamp_ns;
    agreed_odom_ = step.odom;
  } else if (is_beyond_patience(all, step)) {
    // Nobody searches while mapping: beside a Car alone a map of half a way round has places that look alike.
    lose_sight(state_ == State::kMapping ? problems::kOtherViewWhileMapping() : problems::kOtherView());
  }
  if (position_sigma_m(history.newest().filter) > parameters_.lost_sigma_m && state_ == State::kLocalized) {
    lose_sight(problems::kOutOfView());
  }
  if (lost()) {
    return Judgement::kLost;
  }
  degenerate_ = degenerate_ || !is_right;
  return is_right ? Judgement::kAgrees : Judgement::kDisagrees;
}

Agreement ScanTracker::agreement(const ScanSet& set, const FilterHistory& history) const {
  const FilterStep& step = history.at(set.step);
  const double sigma_m = position_sigma_m(history.newest().filter);
  Agreement all;
  for (const Sweep& sweep : set.sweeps) {
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
  return all.expected() < kMinEvidence || figures_.agreement >= parameters_.min_agreement;
}

bool ScanTracker::is_beyond_patience(const Agreement& all, const FilterStep& step) const {
  const double bridged_m = relative(agreed_odom_, step.odom).head<2>().norm();
  if (state_ == State::kMapping && bridged_m > kStoodM) {
    return bridged_m > kMaxBridgedM;
  }
  const bool is_hidden = all.hidden > all.beyond + all.missing + all.passed;
  const double patience_s = is_hidden ? parameters_.lost_hidden_after_s : parameters_.lost_after_s;
  return static_cast<double>(step.stamp_ns - agreed_ns_) * 1e-9 >= patience_s;
}

ScanMatch ScanTracker::match(const ScanPoints& scan, const PoseFilter& filter) const {
  return matcher_.match(scan, *map_, {filter.pose(), filter.prior_covariance(), filter.pose_covariance()});
}

bool ScanTracker::accept(const ScanMatch& match) {
  figures_.points = match.points;
  figures_.matched = match.matched;
  figures_.residual_rms = match.residual_rms;
  figures_.weakest_sigma_m = weakest_sigma_m(match.correction.information);
  degenerate_ = figures_.weakest_sigma_m > parameters_.degenerate_sigma_m;
  return match.matched >= kMinMatched;
}

std::optional<Relocalization::Found> ScanTracker::relocalize(const ScanSet& set, const ScanPoints& scan,
                                                             const FilterHistory& history) {
  // Where the view is the expected one again, the pose by wheels and gyro is better than one that is searched for. A
  // half-made map is not searched at all.
  if (is_reckoned_) {
    resume(set, history);
  }
  if (!lost() || state_ != State::kLocalized) {
    return std::nullopt;
  }
  const FilterStep& step = history.at(set.step);
  return search({set.sweeps.front(), scan, step.odom, step.input.slope}, step);
}

void ScanTracker::resume(const ScanSet& set, const FilterHistory& history) {
  const Agreement all = agreement(set, history);
  // What is expected of a place that is hardly known agrees with much.
  const bool is_known =
      state_ == State::kMapping || position_sigma_m(history.newest().filter) <= parameters_.lost_sigma_m;
  agreeing_ = is_known && agrees(all) && all.expected() >= kMinEvidence ? agreeing_ + 1 : 0;
  if (agreeing_ >= kAgreementsToResume) {
    find(history.at(set.step));
  }
}

std::optional<Relocalization::Found> ScanTracker::search(const SearchView& view, const FilterStep& step) {
  if (!search_) {
    search_.emplace(parameters_, *map_);
    search_->begin(step.filter.pose(), view);
    return std::nullopt;
  }
  const std::optional<Relocalization::Found> found = search_->advance(view);
  if (found) {
    find(step);
  }
  return found;
}

}  // namespace mtr_localization
