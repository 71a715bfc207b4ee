/// @file
/// A cumulative sum (Page, Biometrika 1954) of the share of beams that look through surfaces.
// SPDX-License-Identifier: Apache-2.0
#include "tracking/contradiction_watch.hpp"

#include <algorithm>

namespace mtr_localization {
namespace {

// Of 46,000 level views of right poses in simulation (four scenes, 24 drives) 1 of 1000 had a share of more than 2 to
// 6 % beyond two beams; beside a van of which nothing but the wheels is seen it was 9 % for seconds. Wrong poses that
// half agreed had 18 % and more.
constexpr int kUsualBeams = 2;
constexpr double kUsualShare = 0.1;
constexpr double kMaxExcessS = 0.05;
// Where the map explains so much of what is seen, what is missing was overlooked: from low down and 10 m away wheels
// and sills of a right pose go unseen for seconds, while all that returns lies on the map (0.9 and more).
constexpr double kExplainedShare = 0.9;
// A longer gap between views says nothing of the time in between.
constexpr double kMaxGapS = 0.1;
// Level ground: over so long the slopes are that small; 0.003 in the simulated lots, 0.012 and more on slopes of 1 deg.
constexpr double kSlopeMeanS = 5.0;
constexpr double kMaxSlope = 0.007;

}  // namespace

void ContradictionWatch::reset() { excess_s_ = 0.0; }

bool ContradictionWatch::add(std::int64_t stamp_ns, const Agreement& view, const Eigen::Vector2d& slope) {
  if (stamp_ns_ == 0) {
    stamp_ns_ = stamp_ns;
    slope_square_ = slope.squaredNorm();
  }
  const double gap_s = std::clamp(static_cast<double>(stamp_ns - stamp_ns_) * 1e-9, 0.0, kMaxGapS);
  stamp_ns_ = stamp_ns;
  slope_square_ += gap_s / kSlopeMeanS * (slope.squaredNorm() - slope_square_);
  if (view.expected() < Agreement::kMinEvidence || slope_square_ > kMaxSlope * kMaxSlope) {
    return false;
  }
  const bool is_explained = view.seen >= Agreement::kMinEvidence && view.share_of_returns() >= kExplainedShare;
  const bool is_usual = view.is_expected() || is_explained;
  const int through = is_usual ? 0 : std::max(0, view.through() - kUsualBeams);
  const double share = static_cast<double>(through) / view.expected();
  excess_s_ = std::max(0.0, excess_s_ + gap_s * (share - kUsualShare));
  return excess_s_ >= kMaxExcessS;
}

}  // namespace mtr_localization
