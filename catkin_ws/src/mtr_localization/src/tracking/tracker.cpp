/// @file
/// The tracked map, and the handling of a pose whose view does not agree with it.
// SPDX-License-Identifier: Apache-2.0
#include "tracking/tracker.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "map_names.hpp"
#include "problems.hpp"

namespace mtr_localization {
namespace {

constexpr int kMinEvidence = Agreement::kMinEvidence;
constexpr int kMinMatched = 5;
// If no surface is expected, this number of returns is more than one person causes; 20 beams are 0.6 m at 2 m.
constexpr int kMinUnexplained = 20;
constexpr double kToleranceM = 0.12;
// Lever arm that converts an angle to a distance.
constexpr double kLeverM = 1.0;
constexpr double kMinInformation = 1e-6;
// Distance that wheels and gyro bridge while mapping, because a LiDAR on uneven ground looks over and under bumpers and
// sills. In simulation, they were 4 to 6 cm off over 14 m of the path. Views in between are added to the map.
constexpr double kMaxBridgedM = 2.0;
// A robot that moved less since the last agreement was carried, or an object is in front of it.
constexpr double kStoodM = 0.05;
// Slope limit of level ground: 1 cm per metre. On steeper ground or when braking, a LiDAR looks over and under
// surfaces, and a correct pose shows only half of them.
constexpr double kLevelSlope = 0.01;
// Settling time before views are used in a search: a robot that was put down rocks, and sees the ground or over
// objects.
constexpr std::int64_t kSettledNs = 500'000'000;
// With this number of returns near surfaces, a pose within its covariance has nearly all of them on the surfaces.
constexpr int kMinNear = 15;
constexpr double kMinExactShare = 0.5;

double weakest_sigma_m(const Eigen::Matrix3d& information) {
  const Eigen::Vector3d scale(1.0, 1.0, 1.0 / kLeverM);
  const Eigen::Matrix3d scaled = scale.asDiagonal() * information * scale.asDiagonal();
  const double least =
      Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(scaled, Eigen::EigenvaluesOnly).eigenvalues().minCoeff();
  return 1.0 / std::sqrt(std::max(least, kMinInformation));
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
  // A search refers to the previous map.
  search_.reset();
}

int ScanTracker::enter(const AdjustedMap& adjusted, const FilterStep& here) {
  auto map = std::make_unique<ReferenceMap>();
  map->sources = error_sources_of(adjusted.surfels);
  map->surfaces = SurfelMap(adjusted.surfels);
  map->range_bias = adjusted.range_bias;
  search_.reset();
  map_ = std::move(map);
  contradictions_.reset();
  state_ = State::kLocalized;
  note_agreement(here);
  fitted_ns_ = here.stamp_ns;
  patience_s_ = parameters_.lost_hidden_after_s;
  return map_->error_sources();
}

void ScanTracker::lose(const mtr_core::Problem& reason) {
  lose_sight(reason);
  is_reckoned_ = state_ == State::kMapping;
}

void ScanTracker::doubt(const mtr_core::Problem& reason, bool reckoned) {
  lose_sight(reason);
  is_reckoned_ = reckoned;
}

void ScanTracker::give_up(const mtr_core::Problem& reason) {
  state_ = State::kNoMap;
  map_ = std::make_unique<ReferenceMap>();
  search_.reset();
  doubt(reason, false);
}

void ScanTracker::lose_sight(const mtr_core::Problem& reason) {
  lost_reason_ = reason;
  degenerate_ = false;
  uncovered_.reset();
  lost_ns_.reset();
  is_reckoned_ = true;
}

void ScanTracker::find(const FilterStep& step) {
  lost_reason_ = {};
  is_contradicted_ = false;
  contradictions_.reset();
  note_agreement(step);
  fitted_ns_ = step.stamp_ns;
  // While mapping, unmapped places contain little evidence that something hides the view.
  patience_s_ = state_ == State::kMapping ? parameters_.lost_hidden_after_s : parameters_.lost_after_s;
  search_.reset();
}

void ScanTracker::note_agreement(const FilterStep& step) {
  has_agreed_ = true;
  agreed_ns_ = step.stamp_ns;
  agreed_odom_ = step.odom;
}

Judgement ScanTracker::judge(const ScanSet& set, const FilterHistory& history) {
  if (!has_map() || map_->surfaces.surfels().empty()) {
    return Judgement::kNoMap;
  }
  if (lost()) {
    return Judgement::kLost;
  }
  const FilterStep& step = history.at(set.step);
  const double tolerance_m = kToleranceM + 3.0 * history.newest().filter.position_sigma_m();
  const View view = view_of(set, {}, history);
  const Agreement all = agreement_of(view, step.filter.pose(), map_->surfaces, tolerance_m);
  const bool is_right = agrees(all);
  const bool says_nothing = is_unanswered(all);
  if (is_right && !says_nothing) {
    patience_s_ = patience_after(all, view.slope, step);
    note_agreement(step);
    is_contradicted_ = false;
  } else if (!is_right) {
    fitted_ns_ = step.stamp_ns;
  }
  has_agreed_ = is_right && !says_nothing;
  if (!has_agreed_ && is_beyond_patience(all, step)) {
    // No search while mapping: next to a Car alone, an incomplete map has look-alike places.
    lose_sight(state_ == State::kMapping ? problems::kOtherViewWhileMapping() : problems::kOtherView());
  }
  if (state_ == State::kLocalized && contradictions_.add(step.stamp_ns, all, view.slope)) {
    is_contradicted_ = true;
    lose_sight(problems::kOtherView());
  }
  if (is_too_uncertain(history.newest().filter)) {
    lose_sight(problems::kOutOfView());
  }
  is_contradicted_ = is_contradicted_ || all.is_contradicted();
  if (lost()) {
    return Judgement::kLost;
  }
  degenerate_ = degenerate_ || !is_right;
  return is_right ? Judgement::kAgrees : Judgement::kDisagrees;
}

bool ScanTracker::agrees(const Agreement& all) {
  // Either share is sufficient. On uneven ground, the LiDAR looks over or under expected surfaces, or meets the ground
  // all round; a wrong pose fails both.
  figures_.agreement = std::max(all.share_of_expected(), all.share_of_returns());
  if (all.expected() < kMinEvidence) {
    return !is_unexplained(all);
  }
  return figures_.agreement >= parameters_.min_agreement;
}

bool ScanTracker::is_unexplained(const Agreement& all) const {
  // A growing map does not contain everything yet.
  return state_ == State::kLocalized && all.expected() < kMinEvidence && all.unknown >= kMinUnexplained &&
         all.share_of_returns() < parameters_.min_agreement;
}

bool ScanTracker::is_unanswered(const Agreement& all) const {
  const bool has_nothing_to_see = all.expected() + all.excused < kMinEvidence;
  return state_ == State::kLocalized && all.expected() < kMinEvidence && !(has_agreed_ && has_nothing_to_see);
}

double ScanTracker::patience_after(const Agreement& all, const Eigen::Vector2d& slope, const FilterStep& step) const {
  if (state_ == State::kMapping || all.is_expected()) {
    return parameters_.lost_hidden_after_s;
  }
  if (slope.norm() > kLevelSlope) {
    return patience_s_;
  }
  const double since_s = static_cast<double>(step.stamp_ns - agreed_ns_) * 1e-9;
  return std::max(patience_s_ - since_s, all.is_contradicted() ? 0.0 : parameters_.lost_after_s);
}

bool ScanTracker::is_beyond_patience(const Agreement& all, const FilterStep& step) const {
  const double bridged_m = relative(agreed_odom_, step.odom).head<2>().norm();
  if (state_ == State::kMapping && bridged_m > kStoodM) {
    return bridged_m > kMaxBridgedM;
  }
  const bool is_hidden =
      is_unexplained(all) || is_unanswered(all) || all.hidden > all.beyond + all.missing + all.passed;
  const double patience_s = is_hidden ? patience_s_ : std::min(patience_s_, parameters_.lost_after_s);
  return static_cast<double>(step.stamp_ns - agreed_ns_) * 1e-9 >= patience_s;
}

ScanMatch ScanTracker::match(const ScanPoints& scan, const PoseFilter& filter) const {
  return matcher_.match(scan, *map_, {filter.pose(), filter.prior_covariance(), filter.pose_covariance()});
}

bool ScanTracker::is_enough(const ScanMatch& match) { return match.matched >= kMinMatched; }

bool ScanTracker::accept(const ScanMatch& match) {
  figures_.points = match.points;
  figures_.matched = match.matched;
  figures_.residual_rms = match.residual_rms;
  figures_.weakest_sigma_m = weakest_sigma_m(match.correction.information);
  degenerate_ = figures_.weakest_sigma_m > parameters_.degenerate_sigma_m;
  return is_enough(match);
}

bool ScanTracker::fits(const ScanPoints& scan, const FilterStep& step) {
  const PoseFilter& filter = step.filter;
  const ScanFit fit = matcher_.fit(scan, *map_, {filter.pose(), filter.prior_covariance(), filter.pose_covariance()});
  if (fit.near < kMinNear || fit.exact >= kMinExactShare * fit.near) {
    fitted_ns_ = step.stamp_ns;
  } else if (static_cast<double>(step.stamp_ns - fitted_ns_) * 1e-9 >= parameters_.lost_after_s) {
    is_contradicted_ = true;
    lose_sight(state_ == State::kMapping ? problems::kOtherViewWhileMapping() : problems::kOtherView());
  }
  return !lost();
}

std::optional<Relocalization::Found> ScanTracker::relocalize(const ScanSet& set, const ScanPoints& scan,
                                                             const FilterHistory& history) {
  const FilterStep& step = history.at(set.step);
  const View view = view_of(set, scan, history);
  const bool is_mapping = state_ == State::kMapping;
  const Relocalization::Found near = matched_near(view, step.filter);
  if (is_uncovered(view, near.pose, history, step)) {
    find(step);
    return is_mapping ? std::nullopt : std::optional(near);
  }
  if (is_mapping && !is_reckoned_) {
    return std::nullopt;
  }
  lost_ns_ = lost_ns_.value_or(step.stamp_ns);
  if (step.stamp_ns - *lost_ns_ < kSettledNs) {
    return std::nullopt;
  }
  if (!search_) {
    // An incomplete map is not searched, because next to a Car alone it has look-alike places.
    using Extent = Relocalization::Extent;
    search_.emplace(parameters_, *map_, is_mapping ? Extent::kReckonedOnly : Extent::kEverywhere);
  }
  const auto found = search_->advance(view, step.filter.pose());
  if (!found) {
    return std::nullopt;
  }
  find(step);
  // The growing map continues at the pose of wheels and gyro.
  return is_mapping ? std::nullopt : found;
}

Relocalization::Found ScanTracker::matched_near(const View& view, const PoseFilter& filter) const {
  // After a gap bridged by wheels, the heading is known to a few degrees.
  const Eigen::Matrix3d covariance = filter.pose_covariance();
  const ScanMatch match = this->match(view.scan, filter);
  if (!is_enough(match) || match.contradicts(covariance)) {
    return {filter.pose(), covariance};
  }
  const Eigen::Matrix3d open = Eigen::Matrix3d::Identity() + match.correction.information * covariance;
  return {match.pose, covariance * open.inverse()};
}

bool ScanTracker::is_uncovered(const View& view, const PoseVector& pose, const FilterHistory& history,
                               const FilterStep& step) {
  const Agreement all = agreement_of(view, pose, map_->surfaces, kToleranceM);
  is_contradicted_ = is_contradicted_ || all.is_contradicted();
  const bool is_known = history.newest().filter.position_sigma_m() <= parameters_.lost_sigma_m;
  const bool is_expected = all.is_expected() || (state_ == State::kMapping && all.is_expected_so_far());
  const bool is_wrong = all.is_contradicted() || (is_contradicted_ && state_ == State::kMapping);
  if (!is_reckoned_ || is_wrong || !is_known || !is_expected) {
    uncovered_.reset();
    return false;
  }
  const ScanFit fit =
      matcher_.fit(view.scan, *map_, {pose, step.filter.prior_covariance(), step.filter.pose_covariance()});
  return uncovered_.add(step.stamp_ns, agreed_odom_, step.odom, is_contradicted_, fit);
}

}  // namespace mtr_localization
