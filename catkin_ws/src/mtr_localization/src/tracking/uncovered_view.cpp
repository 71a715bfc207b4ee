/// @file
/// Required time, distance and turn of agreement.
// SPDX-License-Identifier: Apache-2.0
#include "tracking/uncovered_view.hpp"

#include <cmath>

namespace mtr_localization {
namespace {

constexpr std::int64_t kTimeNs = 1'000'000'000;
// Vicinity of the last agreement.
constexpr double kNearM = 1.0;
constexpr double kNearRad = 0.5;
constexpr double kWayM = 1.0;
constexpr double kTurnRad = 1.0;
constexpr double kContradictedWayM = 2.0;
// Lowest share of exact returns among those near surfaces. In simulation it was 0.9 to 1 at nearly all correct places,
// also on slopes. At look-alike places 0.3 to 1.2 m off it was 0.3 to 0.75.
constexpr double kExactShare = 0.85;
// Number of returns that is sufficient for a decision.
constexpr int kMinNear = 100;

bool is_within(const PoseVector& way, double distance_m, double turn_rad) {
  return way.head<2>().norm() <= distance_m && std::abs(way.z()) <= turn_rad;
}

bool lies_on_map(const ScanFit& fit) { return fit.near >= kMinNear && fit.exact >= kExactShare * fit.near; }

}  // namespace

bool UncoveredView::add(std::int64_t stamp_ns, const PoseVector& agreed_odom, const PoseVector& odom,
                        bool is_contradicted, const ScanFit& fit) {
  since_ = since_.value_or(Beginning{stamp_ns, odom});
  since_->fit.near += fit.near;
  since_->fit.exact += fit.exact;
  if (!lies_on_map(since_->fit)) {
    return false;
  }
  const PoseVector way = relative(since_->odom, odom);
  if (is_contradicted) {
    return way.head<2>().norm() >= kContradictedWayM;
  }
  const bool is_near = is_within(relative(agreed_odom, odom), kNearM, kNearRad);
  return stamp_ns - since_->stamp_ns >= kTimeNs && (is_near || !is_within(way, kWayM, kTurnRad));
}

}  // namespace mtr_localization
