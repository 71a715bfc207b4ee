/// @file
/// Branch-and-bound search over squares of places.
// SPDX-License-Identifier: Apache-2.0
#include "tracking/place_search.hpp"

#include <algorithm>
#include <cmath>

namespace mtr_localization {
namespace {

constexpr int kHeadings = 120;
constexpr double kHeadingStepRad = 2.0 * M_PI / kHeadings;
constexpr int kTopLevel = DistanceField::kLevels - 1;
constexpr std::size_t kMaxPlaces = 24;
// Number of scored squares in one piece of work, about 2 ms.
constexpr int kSquaresPerPiece = 6000;
// Lowest nearness of a place, as a share of its points.
constexpr double kMinNearness = 0.3;
// Limit of the search if many places look alike.
constexpr int kMaxSquares = 200'000;

}  // namespace

void PlaceSearch::begin(const PoseVector& around, double radius_m, const std::vector<Eigen::Vector2d>& points) {
  places_.clear();
  squares_ = {};
  next_heading_ = 0;
  work_left_ = kMaxSquares;
  const int half = static_cast<int>(std::floor(radius_m / DistanceField::kStepM));
  places_aside_ = 2 * half + 1;
  corner_ = around;
  corner_.head<2>() -= Eigen::Vector2d::Constant(half * DistanceField::kStepM);
  turned_.assign(kHeadings, points);
  for (int heading = 0; heading < kHeadings; ++heading) {
    const Eigen::Matrix2d turn = rotation(around.z() + heading * kHeadingStepRad);
    for (Eigen::Vector2d& point : turned_[static_cast<std::size_t>(heading)]) {
      point = turn * point;
    }
  }
}

bool PlaceSearch::advance() {
  int work = kSquaresPerPiece;
  for (; next_heading_ < kHeadings && work > 0; ++next_heading_) {
    for (int x = 0; x < places_aside_; x += 1 << kTopLevel) {
      for (int y = 0; y < places_aside_; y += 1 << kTopLevel) {
        squares_.push(scored(kTopLevel, next_heading_, x, y));
        --work;
      }
    }
  }
  if (next_heading_ < kHeadings) {
    return false;
  }
  const double enough = kMinNearness * 255.0 * static_cast<double>(turned_.front().size());
  while (work > 0 && work_left_ > 0 && !squares_.empty() && places_.size() < kMaxPlaces) {
    const Square best = squares_.top();
    if (best.bound < enough) {
      return true;
    }
    squares_.pop();
    if (best.level > 0) {
      split(best);
      work -= 4;
      work_left_ -= 4;
      continue;
    }
    const PoseVector pose = pose_of(best);
    const bool is_known = std::any_of(places_.begin(), places_.end(),
                                      [&](const PoseVector& place) { return is_same_place(place, pose); });
    if (!is_known) {
      places_.push_back(pose);
    }
    --work;
  }
  return work > 0;
}

void PlaceSearch::split(const Square& square) {
  const int level = square.level - 1;
  const int side = 1 << level;
  for (const int x : {square.x, square.x + side}) {
    for (const int y : {square.y, square.y + side}) {
      if (x < places_aside_ && y < places_aside_) {
        squares_.push(scored(level, square.heading, x, y));
      }
    }
  }
}

PlaceSearch::Square PlaceSearch::scored(int level, int heading, int x, int y) const {
  const Eigen::Vector2d place = corner_.head<2>() + DistanceField::kStepM * Eigen::Vector2d(x, y);
  int sum = 0;
  for (const Eigen::Vector2d& point : turned_[static_cast<std::size_t>(heading)]) {
    sum += field_.nearness(level, place + point);
  }
  return {sum, level, heading, x, y};
}

PoseVector PlaceSearch::pose_of(const Square& square) const {
  return {corner_.x() + DistanceField::kStepM * square.x, corner_.y() + DistanceField::kStepM * square.y,
          wrapped(corner_.z() + square.heading * kHeadingStepRad)};
}

}  // namespace mtr_localization
