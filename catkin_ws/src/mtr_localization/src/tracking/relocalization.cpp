/// @file
/// Views from several places, hypotheses of places, and the decision for one of them.
// SPDX-License-Identifier: Apache-2.0
#include "tracking/relocalization.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <numeric>

#include "map_names.hpp"

namespace mtr_localization {
namespace {

constexpr std::size_t kSearchPoints = 60;
constexpr std::size_t kMinPoints = 15;
// Work per sweep, some milliseconds.
constexpr std::size_t kRefinedPerSweep = 2;
constexpr std::size_t kComparedPerSweep = 6;
// Uncertainty after each step of the search.
constexpr double kCoarseSigmaM = 0.15;
constexpr double kCoarseSigmaRad = 0.03;
constexpr double kFineSigmaM = 0.05;
constexpr double kFineSigmaRad = 0.01;
constexpr int kRefinements = 3;
constexpr double kToleranceM = 0.12;
// Lowest number of mapped returns that can confirm a place: a Car at 12 m is met by 20 beams of one degree.
constexpr int kMinSeen = 12;
// Distance and turn between views: from there, a LiDAR sees other sides of objects, at other ranges.
constexpr double kApartM = 0.5;
constexpr double kApartRad = 0.5;
constexpr std::size_t kViewsToDecide = 3;
constexpr std::size_t kMaxViews = 6;
constexpr std::size_t kMaxHypotheses = 40;
// A place that explains less of the view that led to it is discarded.
constexpr double kMinShare = 0.25;
// A place is a competitor if it explains this share of what the best place explains in all views. A low LiDAR does not
// always see everything that the map has at the correct place. In simulation, correct and opposite places had 0.82 and
// 0.98, or 0.64 and 0.77.
constexpr double kRivalPart = 0.75;
// A place is also a competitor if it explains this share of the returns, because expected but unseen surfaces may have
// been overlooked. For a van with only its wheels visible, the correct and the opposite place explained 0.93 and 0.91
// of the returns, and 0.44 and 0.98 of the expected surfaces.
constexpr double kRivalReturns = 0.8;
// Unless the robot was carried, the pose of wheels and gyro is correct. Therefore it is a competitor as long as it
// explains more than chance.
constexpr double kReckonedShare = 0.5;
// Largest rms residual over all views in sigmas; with a larger one, the place only looks similar. At 8 m, an agreeing
// view may be 0.3 m off. At the correct place the residual is 1.0, and 2 on slopes of 1 degree.
constexpr double kMaxResidual = 2.5;
// A place this close to the boundary of the search has neighbours that were not tried.
constexpr double kRimM = 0.5;

Eigen::Matrix3d pose_covariance(double sigma_m, double sigma_rad) {
  return Eigen::Vector3d(sigma_m * sigma_m, sigma_m * sigma_m, sigma_rad * sigma_rad).asDiagonal();
}

std::vector<Eigen::Vector2d> thinned(const ScanPoints& scan) {
  std::vector<Eigen::Vector2d> points;
  const double stride = std::max(1.0, static_cast<double>(scan.points.size()) / kSearchPoints);
  for (double i = 0.0; i < static_cast<double>(scan.points.size()); i += stride) {
    points.push_back(scan.points[static_cast<std::size_t>(i)].position);
  }
  return points;
}

PoseVector inverse(const PoseVector& pose) { return relative(pose, PoseVector::Zero()); }

}  // namespace

double Relocalization::Hypothesis::mean() const {
  return std::accumulate(shares.begin(), shares.end(), 0.0,
                         [](double sum, const Shares& each) { return sum + each.both; }) /
         static_cast<double>(shares.size());
}

double Relocalization::Hypothesis::least() const {
  return std::min_element(shares.begin(), shares.end(),
                          [](const Shares& a, const Shares& b) { return a.both < b.both; })
      ->both;
}

double Relocalization::Hypothesis::mean_of_returns() const {
  return std::accumulate(shares.begin(), shares.end(), 0.0,
                         [](double sum, const Shares& each) { return sum + each.returns; }) /
         static_cast<double>(shares.size());
}

Relocalization::Relocalization(const TrackingParameters& parameters, const ReferenceMap& map, Extent extent)
    : parameters_(parameters),
      map_(map),
      extent_(extent),
      matcher_(parameters),
      field_(map.surfaces.surfels()),
      places_(field_) {}

std::optional<Relocalization::Found> Relocalization::advance(const View& view, const PoseVector& reckoned) {
  reckoned_ = reckoned;
  switch (phase_) {
    case Phase::kWait:
      phase_ = begin(view, reckoned) ? Phase::kSearch : Phase::kWait;
      return std::nullopt;
    case Phase::kSearch:
      search();
      return std::nullopt;
    case Phase::kRefine:
      refine();
      return std::nullopt;
    case Phase::kCompare:
      compare();
      return std::nullopt;
    default:
      return decide(view);
  }
}

bool Relocalization::begin(const View& view, const PoseVector& reckoned) {
  if (view.scan.points.size() < kMinPoints || !is_new(view)) {
    return false;
  }
  views_.push_back(view);
  found_ = {reckoned};
  next_ = 0;
  around_ = around_.value_or(reckoned);
  if (extent_ == Extent::kEverywhere) {
    places_.begin(*around_, parameters_.search_radius_m, thinned(view.scan));
  }
  return true;
}

bool Relocalization::is_new(const View& view) const {
  return std::all_of(views_.begin(), views_.end(), [&](const View& other) {
    const PoseVector way = relative(other.odom, view.odom);
    return way.head<2>().norm() > kApartM || std::abs(way.z()) > kApartRad;
  });
}

void Relocalization::search() {
  if (extent_ == Extent::kEverywhere) {
    if (!places_.advance()) {
      return;
    }
    found_.insert(found_.end(), places_.places().begin(), places_.places().end());
  }
  phase_ = Phase::kRefine;
}

void Relocalization::refine() {
  const View& view = views_.back();
  const std::size_t end = std::min(next_ + kRefinedPerSweep, found_.size());
  for (; next_ < end; ++next_) {
    PoseVector& pose = found_[next_];
    for (int i = 0; i < kRefinements; ++i) {
      pose = matched(view, pose, i == 0 ? kCoarseSigmaM : kFineSigmaM, i == 0 ? kCoarseSigmaRad : kFineSigmaRad);
    }
  }
  if (next_ == found_.size()) {
    next_ = 0;
    known_ = hypotheses_.size();
    phase_ = Phase::kCompare;
  }
}

void Relocalization::compare() {
  const View& view = views_.back();
  std::size_t work = 0;
  // Evaluate earlier hypotheses in the newest view.
  for (; next_ < known_ && work < kComparedPerSweep; ++next_, ++work) {
    Hypothesis& known = hypotheses_[next_];
    const PoseVector pose = matched(view, compose(known.map_from_odom, view.odom), kFineSigmaM, kFineSigmaRad);
    known.map_from_odom = compose(pose, inverse(view.odom));
    known.shares.push_back(shares_at(view, pose));
  }
  // Evaluate places of the newest view in all views.
  for (; next_ < known_ + found_.size() && work < kComparedPerSweep; ++next_, work += views_.size()) {
    add(found_[next_ - known_]);
  }
  if (next_ < known_ + found_.size()) {
    return;
  }
  std::sort(hypotheses_.begin(), hypotheses_.end(),
            [](const Hypothesis& a, const Hypothesis& b) { return a.mean() > b.mean(); });
  hypotheses_.resize(std::min(hypotheses_.size(), kMaxHypotheses));
  phase_ = Phase::kDecide;
}

void Relocalization::add(const PoseVector& pose) {
  const View& newest = views_.back();
  if (shares_at(newest, pose).both < kMinShare) {
    return;
  }
  const Hypothesis found = laid(pose);
  for (Hypothesis& other : hypotheses_) {
    if (is_same_place(compose(other.map_from_odom, newest.odom), compose(found.map_from_odom, newest.odom))) {
      other = found.mean() > other.mean() ? found : other;
      return;
    }
  }
  hypotheses_.push_back(found);
}

Relocalization::Hypothesis Relocalization::laid(const PoseVector& pose) const {
  Hypothesis found{compose(pose, inverse(views_.back().odom)), {}};
  for (const View& view : views_) {
    const PoseVector there = matched(view, compose(found.map_from_odom, view.odom), kFineSigmaM, kFineSigmaRad);
    found.shares.push_back(shares_at(view, there));
  }
  return found;
}

std::optional<Relocalization::Found> Relocalization::decide(const View& view) {
  std::optional<Found> found;
  if (views_.size() >= kViewsToDecide && !hypotheses_.empty()) {
    const Hypothesis& best = hypotheses_.front();
    const Found here = settled(view, compose(best.map_from_odom, view.odom));
    if (best.least() >= parameters_.found_agreement && is_alone(best) && is_exact(best, here.pose, view) &&
        !is_at_rim(here.pose) && shares_at(view, here.pose).both >= parameters_.found_agreement) {
      found = here;
    }
  }
  // Forget old views, because the scene changes and wheels and gyro drift.
  if (views_.size() >= kMaxViews) {
    views_.pop_front();
    for (Hypothesis& hypothesis : hypotheses_) {
      hypothesis.shares.pop_front();
    }
  }
  phase_ = Phase::kWait;
  return found;
}

bool Relocalization::is_alone(const Hypothesis& best) const {
  const PoseVector& odom = views_.back().odom;
  return std::all_of(hypotheses_.begin(), hypotheses_.end(), [&](const Hypothesis& other) {
    const PoseVector place = compose(other.map_from_odom, odom);
    return is_same_place(place, compose(best.map_from_odom, odom)) ||
           !is_rival(other, best, is_same_place(place, reckoned_));
  });
}

bool Relocalization::is_rival(const Hypothesis& other, const Hypothesis& best, bool is_reckoned) const {
  const double limit = is_reckoned ? kReckonedShare : kRivalPart * best.mean();
  return other.mean() > std::min(best.mean() - parameters_.found_margin, limit) ||
         other.mean_of_returns() >= kRivalReturns * best.mean_of_returns();
}

bool Relocalization::is_exact(const Hypothesis& best, const PoseVector& pose, const View& view) const {
  double squares = 0.0;
  for (const View& seen : views_) {
    const ScanMatch match = fit(seen, compose(best.map_from_odom, seen.odom), kFineSigmaM, kFineSigmaRad);
    if (agreement_of(seen, match.pose, map_.surfaces, kToleranceM).seen < kMinSeen) {
      // A competitor does not need this evidence.
      return false;
    }
    squares += match.residual_rms * match.residual_rms;
  }
  if (extent_ == Extent::kReckonedOnly) {
    // There is only one place, and an incomplete map is not accurate yet.
    return true;
  }
  const bool lies_on_surfaces = squares <= static_cast<double>(views_.size()) * kMaxResidual * kMaxResidual;
  return lies_on_surfaces && is_same_place(pose, compose(best.map_from_odom, view.odom));
}

Relocalization::Found Relocalization::settled(const View& view, const PoseVector& pose) const {
  // Poses within one place; directions that the view leaves open keep this covariance.
  const ScanMatch match = fit(view, pose, kSamePlaceM, kSameHeadingRad);
  const Eigen::Matrix3d open = pose_covariance(kSamePlaceM, kSameHeadingRad);
  return {match.pose, open * (Eigen::Matrix3d::Identity() + match.correction.information * open).inverse()};
}

bool Relocalization::is_at_rim(const PoseVector& pose) const {
  return extent_ == Extent::kEverywhere &&
         (pose - *around_).head<2>().cwiseAbs().maxCoeff() > parameters_.search_radius_m - kRimM;
}

Relocalization::Shares Relocalization::shares_at(const View& view, const PoseVector& pose) const {
  // Both shares count: a place must explain the returns, and show the expected surfaces.
  const Agreement agreement = agreement_of(view, pose, map_.surfaces, kToleranceM);
  return {agreement.share_of_both(), agreement.share_of_returns()};
}

PoseVector Relocalization::matched(const View& view, const PoseVector& pose, double sigma_m, double sigma_rad) const {
  return fit(view, pose, sigma_m, sigma_rad).pose;
}

ScanMatch Relocalization::fit(const View& view, const PoseVector& pose, double sigma_m, double sigma_rad) const {
  const Eigen::Matrix3d covariance = pose_covariance(sigma_m, sigma_rad);
  return matcher_.match(view.scan, map_, {pose, covariance, covariance});
}

}  // namespace mtr_localization
