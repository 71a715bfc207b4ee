/// @file
/// Nearest surfel, and surfels that a line of sight crosses.
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "mtr_surfel_map/surfel_map.hpp"

namespace mtr_surfel_map {
namespace {

const Eigen::Vector2d kDown(0.0, -1.0);

/// Returns a surface along x at height y_m, visible from above.
Surfel flat(double x_m, double y_m, double length_m = 0.4) { return {{x_m, y_m}, {0.0, 1.0}, length_m, 0.002, 20}; }

std::vector<int> crossed(const SurfelMap& map, const Eigen::Vector2d& from, const Eigen::Vector2d& to) {
  std::vector<int> indices;
  map.append_crossed(from, to, indices);
  return indices;
}

TEST(SurfelMap, PointAboveASurfelMatchesItWithItsSignedDistance) {
  const SurfelMap map({flat(1.0, 2.0)});
  const auto above = map.match({1.1, 2.03}, 0.1, kDown);
  ASSERT_TRUE(above);
  EXPECT_EQ(above->surfel, &map.surfels()[0]);
  EXPECT_NEAR(above->distance_along_normal_m, 0.03, 1e-12);
  EXPECT_NEAR(map.match({1.1, 1.96}, 0.1, kDown)->distance_along_normal_m, -0.04, 1e-12);
}

TEST(SurfelMap, OfTwoSurfelsTheNearerMatches) {
  const SurfelMap map({flat(1.0, 2.0), flat(1.0, 2.1)});
  EXPECT_EQ(map.match({1.0, 2.08}, 0.3, kDown)->surfel, &map.surfels()[1]);
  EXPECT_EQ(map.match({1.0, 2.03}, 0.3, kDown)->surfel, &map.surfels()[0]);
}

TEST(SurfelMap, SurfelSeenFromBehindOrAlongItselfDoesNotMatch) {
  const SurfelMap map({flat(1.0, 2.0)});
  EXPECT_FALSE(map.match({1.0, 2.0}, 0.1, -kDown));
  EXPECT_FALSE(map.match({1.0, 2.0}, 0.1, {1.0, 0.0}));
}

TEST(SurfelMap, PointBesideTheEndOrTooFarDoesNotMatch) {
  const SurfelMap map({flat(1.0, 2.0)});
  EXPECT_FALSE(map.match({1.3, 2.0}, 0.5, kDown));
  EXPECT_FALSE(map.match({1.0, 2.2}, 0.1, kDown));
}

TEST(SurfelMap, PointThatIsNoNumberOrVeryFarDoesNotMatch) {
  const SurfelMap map({flat(1.0, 2.0)});
  EXPECT_FALSE(map.match({std::nan(""), 2.0}, 0.1, kDown));
  EXPECT_FALSE(map.match({1e300, std::numeric_limits<double>::infinity()}, 0.1, kDown));
  EXPECT_FALSE(map.match({-1e30, 1e30}, 0.1, kDown));
}

TEST(SurfelMap, EmptyMapMatchesNothing) {
  EXPECT_FALSE(SurfelMap().match({0.0, 0.0}, 10.0, kDown));
  EXPECT_FALSE(SurfelMap(std::vector<Surfel>()).match({0.0, 0.0}, 10.0, kDown));
  EXPECT_TRUE(crossed(SurfelMap(), {0.0, 0.0}, {5.0, 5.0}).empty());
}

TEST(SurfelMap, StraySurfelFarAwayLeavesTheOthersFindable) {
  const SurfelMap map({flat(1.0, 2.0), flat(5e4, -5e4)});
  EXPECT_TRUE(map.match({1.0, 2.0}, 0.1, kDown));
}

TEST(SurfelMap, AnswersAsASearchThroughAllSurfelsDoes) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> place(-4.0, 4.0);
  std::uniform_real_distribution<double> angle(-M_PI, M_PI);
  std::vector<Surfel> surfels;
  for (int i = 0; i < 300; ++i) {
    const double normal = angle(random);
    surfels.push_back({{place(random), place(random)}, {std::cos(normal), std::sin(normal)}, 0.3, 0.002, 5});
  }
  const SurfelMap map(surfels);
  int found = 0;
  for (int i = 0; i < 2000; ++i) {
    const Eigen::Vector2d point(place(random), place(random));
    const double direction = angle(random);
    const Eigen::Vector2d along(std::cos(direction), std::sin(direction));
    double nearest = std::numeric_limits<double>::infinity();
    for (const Surfel& surfel : surfels) {
      const Eigen::Vector2d offset = point - surfel.position;
      const double across = surfel.normal.x() * offset.y() - surfel.normal.y() * offset.x();
      if (surfel.normal.dot(along) < -0.1 && std::abs(across) <= 0.17) {
        nearest = std::min(nearest, std::abs(surfel.normal.dot(offset)));
      }
    }
    const auto match = map.match(point, 0.6, along);
    ASSERT_EQ(match.has_value(), nearest <= 0.6) << i;
    if (match) {
      EXPECT_NEAR(std::abs(match->distance_along_normal_m), nearest, 1e-12);
      ++found;
    }
  }
  EXPECT_GT(found, 200);
}

TEST(SurfelMap, LineOfSightCrossesTheMiddleButNotTheEdge) {
  const SurfelMap map({flat(1.0, 2.0)});
  EXPECT_EQ(crossed(map, {1.0, 5.0}, {1.0, 0.0}).size(), 1U);
  EXPECT_TRUE(crossed(map, {1.17, 5.0}, {1.17, 0.0}).empty());
  EXPECT_TRUE(crossed(map, {1.0, 5.0}, {1.0, 2.5}).empty());
  EXPECT_TRUE(crossed(map, {-3.0, 2.1}, {5.0, 1.9}).empty());
}

}  // namespace
}  // namespace mtr_surfel_map
