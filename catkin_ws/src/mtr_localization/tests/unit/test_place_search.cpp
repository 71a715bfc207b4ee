/// @file
/// Branch and bound finds the result of an exhaustive search.
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <random>

#include "tracking/place_search.hpp"

namespace mtr_localization {
namespace {

/// Returns the walls of an asymmetric room, as surfels that face inwards.
std::vector<Surfel> room() {
  std::vector<Surfel> surfels;
  const std::vector<Eigen::Vector2d> corners{{-4.0, -3.0}, {5.0, -3.0}, {5.0, 1.0},
                                             {2.0, 1.0},   {2.0, 4.0},  {-4.0, 4.0}};
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Eigen::Vector2d side = corners[(i + 1) % corners.size()] - corners[i];
    const Eigen::Vector2d along = side.normalized();
    for (double at = 0.1; at < side.norm(); at += 0.2) {
      surfels.push_back({corners[i] + at * along, {-along.y(), along.x()}, 0.2, 0.002, 50});
    }
  }
  return surfels;
}

/// Returns every third surfel as seen from a pose.
std::vector<Eigen::Vector2d> seen_from(const PoseVector& pose, const std::vector<Surfel>& surfels) {
  std::vector<Eigen::Vector2d> points;
  for (std::size_t i = 0; i < surfels.size(); i += 3) {
    points.push_back(relative(pose, {surfels[i].position.x(), surfels[i].position.y(), 0.0}).head<2>());
  }
  return points;
}

int score(const DistanceField& field, const PoseVector& pose, const std::vector<Eigen::Vector2d>& points) {
  int sum = 0;
  for (const Eigen::Vector2d& point : points) {
    sum += field.nearness(0, transformed(pose, point));
  }
  return sum;
}

TEST(PlaceSearch, FindsThePlaceFromAnywhereWithinItsRadius) {
  const std::vector<Surfel> surfels = room();
  const DistanceField field(surfels);
  std::mt19937 random(1);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  for (int i = 0; i < 20; ++i) {
    const PoseVector truth(1.5 * uniform(random), 2.0 * uniform(random), M_PI * uniform(random));
    PlaceSearch search(field);
    search.begin({truth.x() + 7.0 * uniform(random), truth.y() + 7.0 * uniform(random), uniform(random)}, 8.0,
                 seen_from(truth, surfels));
    while (!search.advance()) {
    }
    ASSERT_FALSE(search.places().empty());
    EXPECT_TRUE(is_same_place(search.places().front(), truth)) << search.places().front().transpose();
  }
}

TEST(PlaceSearch, NoPoseOfTheGridIsBetterThanTheFirst) {
  const std::vector<Surfel> surfels = room();
  const DistanceField field(surfels);
  const std::vector<Eigen::Vector2d> points = seen_from({0.33, -0.21, 0.7}, surfels);
  PlaceSearch search(field);
  const PoseVector around(1.0, 1.0, 0.0);
  search.begin(around, 2.0, points);
  while (!search.advance()) {
  }
  const int first = score(field, search.places().front(), points);
  for (int heading = 0; heading < 120; ++heading) {
    for (int x = -10; x <= 10; ++x) {
      for (int y = -10; y <= 10; ++y) {
        const PoseVector pose(around.x() + 0.2 * x, around.y() + 0.2 * y, heading * 2.0 * M_PI / 120);
        EXPECT_LE(score(field, pose, points), first);
      }
    }
  }
}

TEST(PlaceSearch, PlacesAreDifferentOnesBestFirst) {
  const std::vector<Surfel> surfels = room();
  const DistanceField field(surfels);
  const std::vector<Eigen::Vector2d> points = seen_from({0.33, -0.21, 0.7}, surfels);
  PlaceSearch search(field);
  search.begin({0.0, 0.0, 0.0}, 6.0, points);
  while (!search.advance()) {
  }
  for (std::size_t i = 1; i < search.places().size(); ++i) {
    EXPECT_LE(score(field, search.places()[i], points), score(field, search.places()[i - 1], points));
    for (std::size_t k = 0; k < i; ++k) {
      EXPECT_FALSE(is_same_place(search.places()[i], search.places()[k]));
    }
  }
}

TEST(PlaceSearch, NothingInViewLeadsNowhere) {
  const DistanceField field(room());
  PlaceSearch search(field);
  search.begin({0.0, 0.0, 0.0}, 3.0, {{50.0, 0.0}, {50.0, 1.0}});
  while (!search.advance()) {
  }
  EXPECT_TRUE(search.places().empty());
}

}  // namespace
}  // namespace mtr_localization
