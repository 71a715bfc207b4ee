/// @file
/// Coarse grid, fine matching, proof of uniqueness, confirmation.
// SPDX-License-Identifier: Apache-2.0
#include "mtr_localization/pose_search.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "mtr_localization/map_names.hpp"
#include "mtr_localization/view_agreement.hpp"

namespace mtr_localization {
namespace {

constexpr double kStepM = 0.2;
constexpr int kHeadings = 120;
constexpr double kStepRad = 2.0 * M_PI / kHeadings;
// Work of one sweep, about 2 ms.
constexpr int kHeadingsPerSweep = 6;
constexpr std::size_t kCandidatesPerSweep = 2;
constexpr std::size_t kSearchPoints = 60;
constexpr std::size_t kMostCandidates = 24;
constexpr std::size_t kLeastPoints = 15;
// Poses closer than this are the same place.
constexpr double kSamePlaceM = 0.3;
constexpr double kSameHeadingRad = 0.12;
// What a grid step leaves to find.
constexpr double kCoarseSigmaM = 0.15;
constexpr double kCoarseSigmaRad = 0.03;
constexpr double kFineSigmaM = 0.05;
constexpr double kFineSigmaRad = 0.01;
constexpr int kRefinements = 3;
constexpr double kToleranceM = 0.12;
constexpr int kConfirmations = 5;
// Fewer beams of one degree on the map than these are no proof of a place: a Car is met by 20 of them at 12 m.
constexpr int kLeastSeen = 12;

bool same_place(const PoseVector& a, const PoseVector& b) {
  return (a - b).head<2>().norm() < kSamePlaceM && std::abs(wrapped(a.z() - b.z())) < kSameHeadingRad;
}

Eigen::Matrix3d pose_covariance(double sigma_m, double sigma_rad) {
  return Eigen::Vector3d(sigma_m * sigma_m, sigma_m * sigma_m, sigma_rad * sigma_rad).asDiagonal();
}

}  // namespace

PoseSearch::PoseSearch(const TrackingParameters& parameters, const ReferenceMap& map)
    : parameters_(parameters), map_(map), matcher_(parameters), field_(map.surfaces.surfels()) {}

void PoseSearch::begin(const PoseVector& around, const Look& look) {
  phase_ = Phase::kIdle;
  points_.clear();
  candidates_.clear();
  refined_.clear();
  around_ = around;
  first_odom_ = look.odom;
  if (look.scan.points.size() < kLeastPoints) {
    return;
  }
  phase_ = Phase::kCoarse;
  next_heading_ = 0;
  const double stride = std::max(1.0, static_cast<double>(look.scan.points.size()) / kSearchPoints);
  for (double i = 0.0; i < static_cast<double>(look.scan.points.size()); i += stride) {
    points_.push_back(look.scan.points[static_cast<std::size_t>(i)].position);
  }
}

std::optional<PoseSearch::Found> PoseSearch::advance(const Look& look) {
  if (phase_ == Phase::kCoarse) {
    score_headings();
  } else if (phase_ == Phase::kFine) {
    refine(look);
  } else if (phase_ == Phase::kConfirm) {
    return confirm(look);
  } else {
    begin(carried(around_, look), look);
  }
  return std::nullopt;
}

void PoseSearch::score_headings() {
  const int end = std::min(next_heading_ + kHeadingsPerSweep, kHeadings);
  const int reach = static_cast<int>(std::floor(parameters_.search_radius_m / kStepM));
  std::vector<Eigen::Vector2d> turned(points_.size());
  for (; next_heading_ < end; ++next_heading_) {
    const double heading = wrapped(around_.z() + next_heading_ * kStepRad);
    const Eigen::Matrix2d turn = rotation(heading);
    std::transform(points_.begin(), points_.end(), turned.begin(), [&](const auto& point) { return turn * point; });
    for (int x = -reach; x <= reach; ++x) {
      for (int y = -reach; y <= reach; ++y) {
        const Eigen::Vector2d place = around_.head<2>() + kStepM * Eigen::Vector2d(x, y);
        int sum = 0;
        for (const Eigen::Vector2d& point : turned) {
          sum += field_.nearness(place + point);
        }
        keep({{place.x(), place.y(), heading}, static_cast<double>(sum)});
      }
    }
  }
  if (next_heading_ == kHeadings) {
    next_candidate_ = 0;
    phase_ = Phase::kFine;
  }
}

void PoseSearch::keep(const Candidate& candidate) {
  if (candidates_.size() == kMostCandidates && candidate.score <= candidates_.back().score) {
    return;
  }
  for (Candidate& other : candidates_) {
    if (same_place(other.pose, candidate.pose)) {
      if (candidate.score > other.score) {
        other = candidate;
      }
      return;
    }
  }
  candidates_.push_back(candidate);
  std::sort(candidates_.begin(), candidates_.end(), [](const auto& a, const auto& b) { return a.score > b.score; });
  candidates_.resize(std::min(candidates_.size(), kMostCandidates));
}

void PoseSearch::refine(const Look& look) {
  const std::size_t end = std::min(next_candidate_ + kCandidatesPerSweep, candidates_.size());
  for (; next_candidate_ < end; ++next_candidate_) {
    PoseVector pose = carried(candidates_[next_candidate_].pose, look);
    for (int i = 0; i < kRefinements; ++i) {
      pose = match_at(pose, look, i == 0 ? kCoarseSigmaM : kFineSigmaM, i == 0 ? kCoarseSigmaRad : kFineSigmaRad).pose;
    }
    // Back to the first sweep's time, where all candidates are at home.
    const PoseVector at_first = compose(pose, relative(look.odom, first_odom_));
    refined_.push_back({at_first, agreement_at(pose, look)});
  }
  if (next_candidate_ == candidates_.size()) {
    phase_ = choose() ? Phase::kConfirm : Phase::kIdle;
    confirmed_ = 0;
  }
}

bool PoseSearch::choose() {
  const auto best = std::max_element(refined_.begin(), refined_.end(),
                                     [](const auto& a, const auto& b) { return a.score < b.score; });
  if (best == refined_.end() || best->score < parameters_.found_agreement) {
    return false;
  }
  best_ = *best;
  return std::all_of(refined_.begin(), refined_.end(), [&](const Candidate& other) {
    return same_place(other.pose, best_.pose) || other.score <= best_.score - parameters_.found_margin;
  });
}

std::optional<PoseSearch::Found> PoseSearch::confirm(const Look& look) {
  const PoseVector pose = carried(best_.pose, look);
  const ScanMatch match = match_at(pose, look, kFineSigmaM, kFineSigmaRad);
  if (agreement_at(match.pose, look) < parameters_.found_agreement) {
    phase_ = Phase::kIdle;
    return std::nullopt;
  }
  best_.pose = compose(match.pose, relative(look.odom, first_odom_));
  if (++confirmed_ < kConfirmations) {
    return std::nullopt;
  }
  phase_ = Phase::kIdle;
  return Found{match.pose, pose_covariance(kFineSigmaM, kFineSigmaRad)};
}

PoseVector PoseSearch::carried(const PoseVector& pose, const Look& look) const {
  return compose(pose, relative(first_odom_, look.odom));
}

double PoseSearch::agreement_at(const PoseVector& pose, const Look& look) const {
  // Both count: a place must explain what is seen, and show what it lets expect.
  const Agreement agreement = agreement_of(look.sweep, {pose, 0.0, 0.0, look.slope}, map_.surfaces, kToleranceM);
  if (agreement.seen < kLeastSeen) {
    return 0.0;
  }
  return 0.5 * (agreement.share_of_expected() + agreement.share_of_returns());
}

ScanMatch PoseSearch::match_at(const PoseVector& pose, const Look& look, double sigma_m, double sigma_rad) const {
  const Eigen::Matrix3d covariance = pose_covariance(sigma_m, sigma_rad);
  return matcher_.match(look.scan, map_, {pose, covariance, covariance});
}

}  // namespace mtr_localization
