/// @file
/// Distances of the robot's outline from a border.
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <random>

#include "mtr_drive_control/area/polygon.hpp"

namespace mtr_drive_control {
namespace {

constexpr Footprint kFootprint{0.3, 0.2, 0.25};

Polygon rectangle(double half_x, double half_y) {
  return Polygon({{-half_x, -half_y}, {half_x, -half_y}, {half_x, half_y}, {-half_x, half_y}});
}

/// A slot of 0.04 m from the upper side down to y = 0.2 at x = 0.
Polygon with_slot() {
  return Polygon({{-2, -2}, {2, -2}, {2, 2}, {0.02, 2}, {0.02, 0.2}, {-0.02, 0.2}, {-0.02, 2}, {-2, 2}});
}

TEST(Polygon, ContainsWhatIsInsideInEitherDirectionOfRotation) {
  const Polygon clockwise({{0, 0}, {0, 1}, {1, 1}, {1, 0}});
  EXPECT_TRUE(clockwise.contains({0.5, 0.5}));
  EXPECT_FALSE(clockwise.contains({1.5, 0.5}));
  EXPECT_TRUE(rectangle(1, 1).contains({0.0, 0.0}));
  EXPECT_FALSE(with_slot().contains({0.0, 1.0}));
}

TEST(Polygon, ClearanceIsTheDistanceOfTheNearestSide) {
  EXPECT_NEAR(rectangle(2, 2).clearance_m(kFootprint, Pose()), 1.7, 1e-12);
  EXPECT_NEAR(rectangle(2, 2).clearance_m(kFootprint, Pose(1.0, 0.0, 0.0)), 0.7, 1e-12);
  EXPECT_NEAR(rectangle(2, 2).clearance_m(kFootprint, Pose(1.0, 0.0, std::acos(-1.0))), 0.8, 1e-12);
  EXPECT_NEAR(rectangle(2, 2).clearance_m(kFootprint, Pose(0.0, 1.0, std::acos(0.0))), 0.7, 1e-12);
}

TEST(Polygon, ClearanceIsMinusThePartThatIsOutside) {
  EXPECT_NEAR(rectangle(2, 2).clearance_m(kFootprint, Pose(1.8, 0.0, 0.0)), -0.1, 1e-12);
  EXPECT_NEAR(rectangle(2, 2).clearance_m(kFootprint, Pose(5.0, 0.0, 0.0)), -std::hypot(3.3, 0.0), 1e-9);
}

TEST(Polygon, CornerAndNarrowSlotThatReachIntoTheOutlineAreOutside) {
  // The slot passes between the points of the outline, and all corners of the outline are inside.
  EXPECT_LT(with_slot().clearance_m(kFootprint, Pose(0.05, 0.0, 0.0)), -0.04);
  EXPECT_LE(with_slot().clearance_m(kFootprint, Pose(0.05, 1.0, 0.0)), 0.0);
  EXPECT_NEAR(with_slot().clearance_m(kFootprint, Pose(0.0, -0.25, 0.0)), 0.2, 1e-12);
}

TEST(Polygon, AreaWithoutRoomHasNoneInside) {
  EXPECT_LE(Polygon(std::vector<Point>(3)).clearance_m(kFootprint, Pose()), 0.0);
  EXPECT_LE(Polygon(std::vector<Point>(3)).clearance_m(kFootprint, Pose(3.0, 1.0, 0.2)), 0.0);
}

TEST(Polygon, ClearanceAgreesWithSamplesOfTheOutline) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  for (int trial = 0; trial < 300; ++trial) {
    std::vector<Point> corners;
    const int count = 3 + trial % 9;
    for (int i = 0; i < count; ++i) {
      const double bearing = 2.0 * std::acos(-1.0) * (i + 0.8 * unit(random)) / count;
      const double radius = 1.0 + 3.0 * unit(random);
      corners.push_back({radius * std::cos(bearing), radius * std::sin(bearing)});
    }
    const Polygon polygon(corners);
    const Pose pose(4.0 * unit(random) - 2.0, 4.0 * unit(random) - 2.0, 6.0 * unit(random));
    const double clearance = polygon.clearance_m(kFootprint, pose);
    double sampled = 1e9;
    bool is_inside = true;
    for (double x = -kFootprint.rear_m; x <= kFootprint.front_m + 1e-9; x += 0.01) {
      for (double y = -kFootprint.half_width_m; y <= kFootprint.half_width_m + 1e-9; y += 0.01) {
        const Point point = pose.apply({x, y});
        is_inside = is_inside && polygon.contains(point);
        sampled = std::min(sampled, polygon.distance_to_border_m(point));
      }
    }
    if (clearance > 0.0) {
      EXPECT_TRUE(is_inside) << trial;
      EXPECT_NEAR(clearance, sampled, 0.01) << trial;
    } else if (clearance < -0.02) {
      EXPECT_FALSE(is_inside) << trial;
    }
  }
}

}  // namespace
}  // namespace mtr_drive_control
