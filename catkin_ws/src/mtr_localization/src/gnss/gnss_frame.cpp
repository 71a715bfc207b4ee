/// @file
/// Tangent plane, rigid transform, and their uncertainty.
// SPDX-License-Identifier: Apache-2.0
#include "gnss/gnss_frame.hpp"

#include <algorithm>
#include <cmath>

#include "map_names.hpp"

namespace mtr_localization {
namespace {

// WGS-84.
constexpr double kSemiMajorM = 6378137.0;
constexpr double kEccentricitySquared = 6.69437999014e-3;
// Distance between pairs; a drive round a Car gives 20 to 40 of them. Then the frame is fixed, so that later pose
// errors cannot distort it.
constexpr double kPairEveryM = 0.5;
constexpr std::size_t kMinPairs = 8;
constexpr std::size_t kMaxPairs = 40;
// The heading error of the frame is the fix error over the spread: at most a fifth of a radian.
constexpr double kMinSpreadInSigmas = 5.0;

}  // namespace

void GnssFrame::clear() { *this = GnssFrame(); }

void GnssFrame::learn(const GnssFix& fix, const Eigen::Vector2d& antenna_in_map) {
  if (pairs_.size() >= kMaxPairs || (!pairs_.empty() && (pairs_.back().map - antenna_in_map).norm() < kPairEveryM)) {
    return;
  }
  if (!origin_) {
    origin_ = fix;
  }
  pairs_.push_back({level_of(fix), antenna_in_map, fix.sigma_m});
  if (pairs_.size() >= kMinPairs) {
    fit();
  }
}

std::optional<GnssPosition> GnssFrame::in_map(const GnssFix& fix) const {
  if (!is_known_) {
    return std::nullopt;
  }
  const Eigen::Vector2d from_centre = rotation(map_from_level_rad_) * (level_of(fix) - level_centre_);
  const double turned_m = sigma_m_ / spread_m_ * from_centre.norm();
  return GnssPosition{map_centre_ + from_centre, std::hypot(std::hypot(fix.sigma_m, sigma_m_), turned_m)};
}

Eigen::Vector2d GnssFrame::level_of(const GnssFix& fix) const {
  const double sin = std::sin(origin_->latitude_rad);
  const double flattened = 1.0 - kEccentricitySquared * sin * sin;
  const double across_m = kSemiMajorM / std::sqrt(flattened);
  const double along_m = across_m * (1.0 - kEccentricitySquared) / flattened;
  return {wrapped(fix.longitude_rad - origin_->longitude_rad) * across_m * std::cos(origin_->latitude_rad),
          (fix.latitude_rad - origin_->latitude_rad) * along_m};
}

void GnssFrame::fit() {
  const auto count = static_cast<double>(pairs_.size());
  level_centre_.setZero();
  map_centre_.setZero();
  sigma_m_ = 0.0;
  for (const Pair& pair : pairs_) {
    level_centre_ += pair.level / count;
    map_centre_ += pair.map / count;
    sigma_m_ = std::max(sigma_m_, pair.sigma_m);
  }
  double cosine = 0.0;
  double sine = 0.0;
  double squares = 0.0;
  for (const Pair& pair : pairs_) {
    const Eigen::Vector2d level = pair.level - level_centre_;
    const Eigen::Vector2d map = pair.map - map_centre_;
    cosine += level.dot(map);
    sine += level.x() * map.y() - level.y() * map.x();
    squares += map.squaredNorm();
  }
  map_from_level_rad_ = std::atan2(sine, cosine);
  spread_m_ = std::sqrt(squares / count);
  is_known_ = spread_m_ >= kMinSpreadInSigmas * sigma_m_;
}

}  // namespace mtr_localization
