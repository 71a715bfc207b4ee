/// @file
/// Cumulative sum (Page, Biometrika 1954) of the share of beams that pass through surfaces.
// SPDX-License-Identifier: Apache-2.0
#include "tracking/contradiction_watch.hpp"

#include <algorithm>

namespace mtr_localization {
namespace {

// Usual share. Of 46,000 level views from correct poses in simulation (four scenes, 24 drives), 1 of 1000 exceeded 2 to
// 6 %, not counting two beams. Next to a van with only its wheels visible, the share was 9 % for seconds. Half-agreeing
// wrong poses had 18 % and more.
constexpr int kUsualBeams = 2;
constexpr double kUsualShare = 0.1;
constexpr double kMaxExcessS = 0.05;
// If the map explains this share of the returns, missing surfaces were overlooked. At 10 m, wheels and sills may be
// invisible from a low LiDAR for seconds at a correct pose, while 0.9 and more of the returns are on the map.
constexpr double kExplainedShare = 0.9;
// A longer gap between views is not counted.
constexpr double kMaxGapS = 0.1;
// Averaging time and limit of the slope of level ground: 0.003 in the simulated lots, 0.012 and more on slopes of 1
// deg.
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
