/// @file
/// Surface elements from points on known surfaces.
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "extraction/surfel_builder.hpp"

namespace mtr_surfel_map {
namespace {

constexpr double kNoiseM = 0.01;
const SurfelShape kShape{0.4, 0.1, 0.03, {0.0, 0.0}};

/// Points on surfaces, seen from ten places.
class Points {
 public:
  /// Adds points on a line between two positions, seen along a direction.
  void add_line(const Eigen::Vector2d& from, const Eigen::Vector2d& to, const Eigen::Vector2d& direction) {
    const int count = static_cast<int>((to - from).norm() * 500.0);
    for (int i = 0; i < count; ++i) {
      add(from + (to - from) * (i + 0.5) / count, direction);
    }
  }

  void add(const Eigen::Vector2d& point, const Eigen::Vector2d& direction, int key_frame = -1) {
    const Eigen::Vector2d noise(kNoiseM * normal_(random_), kNoiseM * normal_(random_));
    const int place = key_frame >= 0 ? key_frame : static_cast<int>(points_.size()) % 10;
    points_.push_back({point + noise, direction, 3.0, place});
  }

  std::vector<Surfel> surfels() const { return build_surfels(points_, kShape); }

 private:
  SeenPoints points_;
  std::mt19937 random_{3};
  std::normal_distribution<double> normal_{0.0, 1.0};
};

double covered_m(const std::vector<Surfel>& surfels) {
  double sum = 0.0;
  for (const Surfel& surfel : surfels) {
    sum += surfel.length_m;
  }
  return sum;
}

TEST(SurfelBuilder, WallIsCoveredOnceByElementsThatFaceTheViewer) {
  Points points;
  points.add_line({0.0, 0.13}, {3.0, 0.13}, {0.0, 1.0});
  const std::vector<Surfel> surfels = points.surfels();
  EXPECT_NEAR(covered_m(surfels), 3.0, 0.3);
  for (const Surfel& surfel : surfels) {
    EXPECT_NEAR(surfel.position.y(), 0.13, 0.003);
    EXPECT_LT(surfel.normal.y(), -0.99);
    EXPECT_LE(surfel.length_m, 0.5);
  }
}

TEST(SurfelBuilder, WallAlongTheBorderOfSquaresIsOneLayer) {
  Points points;
  points.add_line({0.0, 0.403}, {3.0, 0.403}, {0.0, 1.0});
  const std::vector<Surfel> surfels = points.surfels();
  EXPECT_NEAR(covered_m(surfels), 3.0, 0.3);
  for (const Surfel& surfel : surfels) {
    EXPECT_NEAR(surfel.position.y(), 0.403, 0.003);
  }
}

TEST(SurfelBuilder, TwoSidesOfAThinPanelAreTwoSurfaces) {
  Points points;
  points.add_line({0.05, 0.20}, {0.35, 0.20}, {0.0, -1.0});
  points.add_line({0.05, 0.18}, {0.35, 0.18}, {0.0, 1.0});
  const std::vector<Surfel> surfels = points.surfels();
  ASSERT_EQ(surfels.size(), 2U);
  for (const Surfel& surfel : surfels) {
    EXPECT_NEAR(surfel.position.y(), surfel.normal.y() > 0.0 ? 0.20 : 0.18, 0.003);
  }
}

TEST(SurfelBuilder, StepInASurfaceIsNotBridged) {
  Points points;
  points.add_line({0.0, 0.20}, {0.2, 0.20}, {0.0, 1.0});
  points.add_line({0.2, 0.26}, {0.4, 0.26}, {0.0, 1.0});
  for (const Surfel& surfel : points.surfels()) {
    const double height = surfel.position.x() < 0.2 ? 0.20 : 0.26;
    EXPECT_NEAR(surfel.position.y(), height, 0.006) << surfel.position.transpose();
  }
}

TEST(SurfelBuilder, RoundCornerIsMadeOfShortElementsNearIt) {
  Points points;
  constexpr double kRadiusM = 0.3;
  constexpr int kPoints = 4000;
  for (int i = 0; i < kPoints; ++i) {
    const double angle = M_PI_2 * i / kPoints;
    const Eigen::Vector2d out(std::cos(angle), std::sin(angle));
    points.add(kRadiusM * out, -out);
  }
  const std::vector<Surfel> surfels = points.surfels();
  EXPECT_GE(surfels.size(), 3U);
  for (const Surfel& surfel : surfels) {
    EXPECT_NEAR(surfel.position.norm(), kRadiusM, 0.006);
    EXPECT_LT(surfel.length_m, 0.25);
  }
}

TEST(SurfelBuilder, PointsOfOneOrTwoPlacesAreNoSurface) {
  Points points;
  for (int i = 0; i < 100; ++i) {
    points.add({0.003 * i, 0.2}, {0.0, 1.0}, i % 2);
  }
  EXPECT_TRUE(points.surfels().empty());
}

TEST(SurfelBuilder, NoPointsGiveNoSurface) { EXPECT_TRUE(build_surfels({}, kShape).empty()); }

}  // namespace
}  // namespace mtr_surfel_map
