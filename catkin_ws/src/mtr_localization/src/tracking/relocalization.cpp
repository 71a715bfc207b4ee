/// @file
/// Coarse grid, fine matching, proof of uniqueness, confirmation.
// SPDX-License-Identifier: Apache-2.0
#include "tracking/relocalization.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "map_names.hpp"
#include "tracking/agreement.hpp"

namespace mtr_localization {
namespace {

constexpr double kStepM = 0.2;
constexpr int kHeadings = 120;
constexpr double kStepRad = 2.0 * M_PI / kHeadings;
// Work of one sweep, about 2 ms.
constexpr int kHeadingsPerSweep = 6;
constexpr std::size_t kCandidatesPerSweep = 2;
constexpr std::size_t kSearchPoints = 60;
constexpr std::size_t kMaxCandidates = 24;
constexpr std::size_t kMinPoints = 15;
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
constexpr int kMinSeen = 12;

bool same_place(const PoseVector& a, const PoseVector& b) {
  return (a - b).head<2>().norm() < kSamePlaceM && std::abs(wrapped(a.z() - b.z())) < kSameHeadingRad;
}

Eigen::Matrix3d pose_covariance(double sigma_m, double sigma_rad) {
  return Eigen::Vector3d(sigma_m * sigma_m, sigma_m * sigma_m, sigma_rad * sigma_rad).asDiagonal();
}

}  // namespace

Relocalization::Relocalization(const TrackingParameters& parameters, const ReferenceMap& map)
    : parameters_(parameters), map_(map), matcher_(parameters), field_(map.surfaces.surfels()) {}

void Relocalization::begin(const PoseVector& around, const SearchView& view) {
  phase_ = Phase::kIdle;
  points_.clear();
  candidates_.clear();
  refined_.clear();
  around_ = around;
  first_odom_ = view.odom;
  if (view.scan.points.size() < kMinPoints) {
    return;
  }
  phase_ = Phase::kCoarse;
  next_heading_ = 0;
  const double stride = std::max(1.0, static_cast<double>(view.scan.points.size()) / kSearchPoints);
  for (double i = 0.0; i < static_cast<double>(view.scan.points.size()); i += stride) {
    points_.push_back(view.scan.points[static_cast<std::size_t>(i)].position);
  }
}

std::optional<Relocalization::Found> Relocalization::advance(const SearchView& view) {
  if (phase_ == Phase::kCoarse) {
    score_headings();
  } else if (phase_ == Phase::kFine) {
    refine(view);
  } else if (phase_ == Phase::kConfirm) {
    return confirm(view);
  } else {
    begin(carried(around_, view), view);
  }
  return std::nullopt;
}

void Relocalization::score_headings() {
  const int end = std::min(next_heading_ + kHeadingsPerSweep, kHeadings);
  const int steps = static_cast<int>(std::floor(parameters_.search_radius_m / kStepM));
  std::vector<Eigen::Vector2d> turned(points_.size());
  for (; next_heading_ < end; ++next_heading_) {
    const double heading = wrapped(around_.z() + next_heading_ * kStepRad);
    const Eigen::Matrix2d turn = rotation(heading);
    std::transform(points_.begin(), points_.end(), turned.begin(), [&](const auto& point) { return turn * point; });
    for (int x = -steps; x <= steps; ++x) {
      for (int y = -steps; y <= steps; ++y) {
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

void Relocalization::keep(const Candidate& candidate) {
  if (candidates_.size() == kMaxCandidates && candidate.score <= candidates_.back().score) {
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
  candidates_.resize(std::min(candidates_.size(), kMaxCandidates));
}

void Relocalization::refine(const SearchView& view) {
  const std::size_t end = std::min(next_candidate_ + kCandidatesPerSweep, candidates_.size());
  for (; next_candidate_ < end; ++next_candidate_) {
    PoseVector pose = carried(candidates_[next_candidate_].pose, view);
    for (int i = 0; i < kRefinements; ++i) {
      pose = match_at(pose, view, i == 0 ? kCoarseSigmaM : kFineSigmaM, i == 0 ? kCoarseSigmaRad : kFineSigmaRad).pose;
    }
    // Back to the first sweep's time, where all candidates are at home.
    const PoseVector at_first = compose(pose, relative(view.odom, first_odom_));
    refined_.push_back({at_first, agreement_at(pose, view)});
  }
  if (next_candidate_ == candidates_.size()) {
    phase_ = choose() ? Phase::kConfirm : Phase::kIdle;
    confirmed_ = 0;
  }
}

bool Relocalization::choose() {
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

std::optional<Relocalization::Found> Relocalization::confirm(const SearchView& view) {
  const PoseVector pose = carried(best_.pose, view);
  const ScanMatch match = match_at(pose, view, kFineSigmaM, kFineSigmaRad);
  if (agreement_at(match.pose, view) < parameters_.found_agreement) {
    phase_ = Phase::kIdle;
    return std::nullopt;
  }
  best_.pose = compose(match.pose, relative(view.odom, first_odom_));
  if (++confirmed_ < kConfirmations) {
    return std::nullopt;
  }
  phase_ = Phase::kIdle;
  return Found{match.pose, pose_covariance(kFineSigmaM, kFineSigmaRad)};
}

PoseVector Relocalization::carried(const PoseVector& pose, const SearchView& view) const {
  return compose(pose, relative(first_odom_, view.odom));
}

double Relocalization::agreement_at(const PoseVector& pose, const SearchView& view) const {
  // Both count: a place must explain what is seen, and show what it lets expect.
  const Agreement agreement = agreement_of(view.sweep, {pose, 0.0, 0.0, view.slope}, map_.surfaces, kToleranceM);
  if (agreement.seen < kMinSeen) {
    return 0.0;
  }
  return 0.5 * (agreement.share_of_expected() + agreement.share_of_returns());
}

ScanMatch Relocalization::match_at(const PoseVector& pose, const SearchView& view, double sigma_m,
                                   double sigma_rad) const {
  const Eigen::Matrix3d covariance = pose_covariance(sigma_m, sigma_rad);
  return matcher_.match(view.scan, map_, {pose, covariance, covariance});
}

}  // namespace mtr_localization
