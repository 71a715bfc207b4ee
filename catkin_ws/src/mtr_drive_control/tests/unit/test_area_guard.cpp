/// @file
/// The robot stops before the border of its test area, with any source.
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "scene.hpp"

namespace mtr_drive_control {
namespace {

constexpr std::uint64_t kOrigin = 5;
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
const std::vector<Point> kSquare{{-3, -3}, {3, -3}, {3, 3}, {-3, 3}};

class AreaGuardTest : public ::testing::TestWithParam<bool> {
 protected:
  AreaGuardTest() {
    robot.area = [this] { return inputs(); };
    set_area(kSquare);
    robot.settle();
  }

  void set_area(const std::vector<Point>& corners, bool required = true) {
    area = std::make_shared<const TestArea>(
        TestArea{required, kOrigin, corners.empty() ? std::nullopt : std::optional<Polygon>(Polygon(corners))});
  }

  AreaInputs inputs() const {
    if (!has_pose) {
      return {area, std::nullopt};
    }
    const Point at = robot.world_from_base.position();
    return {area, AreaPose{robot.now_ns - age_ns, Pose(at.x_m, at.y_m, robot.world_from_base.heading_rad()), sigma_m,
                           heading_sigma_rad, origin_id}};
  }

  double clearance() const { return area->polygon->clearance_m(robot.control.footprint(), robot.world_from_base); }

  Decision drive(const Velocity& desired, double duration_s) { return robot.drive(desired, duration_s, GetParam()); }

  TestRobot robot;
  std::shared_ptr<const TestArea> area;
  bool has_pose = true;
  std::int64_t age_ns = 0;
  double sigma_m = 0.01;
  double heading_sigma_rad = 0.001;
  std::uint64_t origin_id = kOrigin;
};

INSTANTIATE_TEST_SUITE_P(PlannerAndPerson, AreaGuardTest, ::testing::Bool());

TEST_P(AreaGuardTest, RobotStopsAtTheBorderWithItsMarginAndSaysSo) {
  const Decision decision = drive({1.0, 0.0}, 12.0);
  EXPECT_TRUE(robot.velocity.is_zero());
  EXPECT_EQ(decision.message.code, "drive_control.area_border");
  EXPECT_EQ(decision.zone, Zone::kBlocked);
  EXPECT_GT(clearance(), 0.05 + 2.0 * sigma_m);
  EXPECT_LT(clearance(), 0.3);
}

TEST_P(AreaGuardTest, RobotLeavesTheBorderBackwards) {
  drive({1.0, 0.0}, 12.0);
  drive({-0.5, 0.0}, 2.0);
  EXPECT_GT(clearance(), 0.5);
}

TEST_P(AreaGuardTest, UncertainPositionStopsItEarlier) {
  sigma_m = 0.3;
  drive({1.0, 0.0}, 12.0);
  EXPECT_GT(clearance(), 0.65);
}

TEST_P(AreaGuardTest, NoMotionByThePlannerAndACrawlByHandWithoutAPose) {
  has_pose = false;
  const Decision decision = drive({1.0, 0.0}, 3.0);
  EXPECT_EQ(decision.message.code, "drive_control.area_position_unknown");
  EXPECT_DOUBLE_EQ(robot.velocity.linear_mps, GetParam() ? 0.1 : 0.0);
}

TEST_P(AreaGuardTest, PoseThatIsLostOnTheWaySlowsOrStopsTheRobotAtOnce) {
  drive({0.8, 0.0}, 1.5);
  ASSERT_GT(robot.velocity.linear_mps, 0.7);
  has_pose = false;
  drive({0.8, 0.0}, 0.4);
  EXPECT_LE(robot.velocity.linear_mps, GetParam() ? 0.1 : 0.0);
}

TEST_P(AreaGuardTest, PoseThatIsOldOrNoNumberOrOfAnotherOriginIsUnknown) {
  const double permitted = GetParam() ? 0.1 : 0.0;
  for (const double sigma : {kNan, std::numeric_limits<double>::infinity(), -1.0}) {
    sigma_m = sigma;
    drive({0.5, 0.0}, 1.0);
    EXPECT_DOUBLE_EQ(robot.velocity.linear_mps, permitted) << sigma;
  }
  sigma_m = 0.01;
  age_ns = 300 * kTestMs;
  EXPECT_EQ(drive({0.5, 0.0}, 1.0).message.code, "drive_control.area_position_unknown");
  EXPECT_DOUBLE_EQ(robot.velocity.linear_mps, permitted);
  age_ns = 0;
  origin_id = kOrigin + 1;
  EXPECT_EQ(drive({0.5, 0.0}, 1.0).message.code, "drive_control.area_of_other_origin");
  EXPECT_DOUBLE_EQ(robot.velocity.linear_mps, permitted);
  origin_id = kOrigin;
  drive({0.5, 0.0}, 1.0);
  EXPECT_GT(robot.velocity.linear_mps, 0.4);
}

TEST_P(AreaGuardTest, RequiredAreaThatIsMissingStopsThePlannerAndNotThePerson) {
  set_area({});
  const Decision decision = drive({0.5, 0.0}, 1.0);
  EXPECT_EQ(robot.velocity.is_zero(), !GetParam());
  EXPECT_EQ(decision.message.code, GetParam() ? "" : "drive_control.area_missing");
}

TEST_P(AreaGuardTest, WithoutAnAreaThatIsRequiredNothingChanges) {
  set_area({}, false);
  drive({0.5, 0.0}, 1.0);
  EXPECT_GT(robot.velocity.linear_mps, 0.4);
  area = nullptr;
  EXPECT_EQ(drive({0.5, 0.0}, 1.0).message.text, "");
  EXPECT_GT(robot.velocity.linear_mps, 0.4);
}

TEST_P(AreaGuardTest, RobotOutsideMovesBackInsideSlowlyAndNoFartherOut) {
  robot.world_from_base = Pose(3.5, 0.0, 0.0);
  robot.settle();
  const double outside = clearance();
  ASSERT_LT(outside, -0.5);
  EXPECT_EQ(drive({0.5, 0.0}, 2.0).message.code, "drive_control.outside_area");
  EXPECT_GE(clearance(), outside - 1e-6);
  for (int tick = 0; tick < 2000 && clearance() < 0.2; ++tick) {
    drive({-0.5, 0.0}, 0.02);
    if (clearance() < 0.0) {
      EXPECT_LE(std::abs(robot.velocity.linear_mps), 0.15 + 1e-9);
    }
  }
  EXPECT_GT(clearance(), 0.19);
}

TEST_P(AreaGuardTest, AreaThatIsDrawnAroundAMovingRobotTooTightlyStopsItAtOnce) {
  drive({0.8, 0.0}, 1.5);
  const double x = robot.world_from_base.position().x_m;
  set_area({{x - 2, -2}, {x + 0.3, -2}, {x + 0.3, 2}, {x - 2, 2}});
  drive({0.8, 0.0}, 1.0);
  EXPECT_TRUE(robot.velocity.is_zero());
  EXPECT_LT(robot.world_from_base.position().x_m, x + 0.45);
}

TEST_P(AreaGuardTest, TickAndPoseThatComeLateDoNotTakeItAcross) {
  age_ns = 0;
  robot.period_ns = 80 * kTestMs;
  drive({1.0, 0.3}, 12.0);
  EXPECT_GT(clearance(), 0.0);
}

/// Star-shaped about the origin: simple, with corners that point inward.
std::vector<Point> random_area(std::mt19937& random) {
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  const int count = 3 + static_cast<int>(unit(random) * 10.0);
  std::vector<Point> corners;
  for (int i = 0; i < count; ++i) {
    const double bearing = 2.0 * kTestPi * (i + 0.7 * unit(random)) / count;
    const double radius = 1.2 + 3.0 * unit(random);
    corners.push_back({radius * std::cos(bearing), radius * std::sin(bearing)});
  }
  return corners;
}

TEST_P(AreaGuardTest, FootprintNeverCrossesTheBorderOfAnyAreaOnAnyArc) {
  std::mt19937 random(GetParam() ? 11 : 12);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  int borders = 0;
  for (int trial = 0; trial < 16; ++trial) {
    set_area(random_area(random));
    robot.world_from_base = Pose(0.3 * unit(random), 0.3 * unit(random), kTestPi * unit(random));
    robot.drive({}, 1.0);
    if (clearance() < 0.1) {
      continue;
    }
    for (int leg = 0; leg < 12; ++leg) {
      const Velocity desired{unit(random), leg % 3 == 0 ? 0.0 : 1.5 * unit(random)};
      for (int tick = 0; tick < 60; ++tick) {
        const Decision decision = robot.step(desired, GetParam());
        ASSERT_GT(clearance(), 0.05) << "trial " << trial << " leg " << leg << " tick " << tick;
        borders += decision.message.code == "drive_control.area_border" ? 1 : 0;
      }
    }
  }
  // The border must be reached repeatedly, otherwise the test proves nothing.
  EXPECT_GT(borders, 200);
}

}  // namespace
}  // namespace mtr_drive_control
