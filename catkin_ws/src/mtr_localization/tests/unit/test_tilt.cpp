/// @file
/// Tilt of the robot, and its effect on points and views.
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "map_names.hpp"
#include "motion/ground_level.hpp"
#include "motion/tilt_filter.hpp"
#include "scans/deskew.hpp"
#include "tracking/agreement.hpp"

namespace mtr_localization {
namespace {

constexpr double kGravity = 9.81;
constexpr std::int64_t kStepNs = 20'000'000;

ImuSample imu(const Eigen::Vector2d& slope, double forward_mps2 = 0.0) {
  return {0, 0.0, Eigen::Vector2d::Zero(), {kGravity * slope.x() + forward_mps2, kGravity * slope.y(), kGravity}};
}

Sweep sweep_of_range(float range_m) {
  Sweep sweep;
  sweep.angle_min_rad = -0.5;
  sweep.angle_max_rad = 0.5;
  sweep.angle_increment_rad = 0.01;
  sweep.range_min_m = 0.1;
  sweep.range_max_m = 30.0;
  sweep.ranges_m.assign(101, range_m);
  return sweep;
}

FilterHistory leaning(const Eigen::Vector2d& slope, double slope_sigma = 0.0) {
  FilterHistory history(PoseFilter(SensorParameters{}), 0);
  FilterInput input;
  input.slope = slope;
  input.slope_sigma = slope_sigma;
  history.advance(kStepNs, input);
  return history;
}

TEST(TiltFilter, RobotAtRestShowsTheSlopeOfItsPlace) {
  TiltFilter tilt;
  for (int i = 0; i < 100; ++i) {
    tilt.advance(0.02, imu({0.02, -0.01}), 0.0, true);
  }
  EXPECT_NEAR(tilt.slope().x(), 0.02, 1e-4);
  EXPECT_NEAR(tilt.slope().y(), -0.01, 1e-4);
}

TEST(TiltFilter, BlowFromTheSideIsNoSlope) {
  TiltFilter tilt;
  for (int i = 0; i < 50; ++i) {
    tilt.advance(0.02, imu({0.0, 0.0}), 0.0, false);
  }
  // A robot that is put down roughly: 8 m/s2 laterally for 0.1 s.
  for (int i = 0; i < 5; ++i) {
    tilt.advance(0.02, imu({0.0, 0.8}), 0.0, false);
  }
  EXPECT_LT(tilt.slope().norm(), 1e-3);
}

TEST(TiltFilter, SlopeThatTheFilterWasWrongAboutIsLearnedInTheEnd) {
  TiltFilter tilt;
  tilt.advance(0.02, imu({0.4, 0.0}), 0.0, false);
  for (int i = 0; i < 1000; ++i) {
    tilt.advance(0.02, imu({0.02, 0.0}), 0.0, false);
  }
  EXPECT_NEAR(tilt.slope().x(), 0.02, 1e-3);
}

TEST(TiltFilter, RobotThatGathersSpeedDoesNotLean) {
  TiltFilter tilt;
  for (int i = 0; i <= 50; ++i) {
    tilt.advance(0.02, imu({0.0, 0.0}, i > 0 ? 1.0 : 0.0), 0.02 * i, false);
  }
  EXPECT_NEAR(tilt.slope().norm(), 0.0, 1e-6);
}

TEST(TiltFilter, GyroIsFollowedAtOnceAndItsBiasIsNot) {
  TiltFilter tilt;
  ImuSample sample = imu({0.0, 0.0});
  sample.tilt_rate_radps = {0.004, -0.003};
  for (int i = 0; i < 500; ++i) {
    tilt.advance(0.02, sample, 0.0, true);
  }
  EXPECT_NEAR(tilt.slope().norm(), 0.0, 1e-3);
  // The nose goes down by 0.02 rad in 0.1 s.
  sample.tilt_rate_radps.y() += 0.2;
  for (int i = 0; i < 5; ++i) {
    tilt.advance(0.02, sample, 0.0, false);
  }
  EXPECT_NEAR(tilt.slope().x(), -0.02, 0.002);
}

TEST(TiltFilter, AccelerometerThatShowsNoGravityMeansLevel) {
  TiltFilter tilt;
  for (const double z : {0.0, -kGravity, std::numeric_limits<double>::quiet_NaN()}) {
    ImuSample sample = imu({0.1, 0.1});
    sample.force_mps2.z() = z;
    tilt.advance(0.02, sample, 0.0, true);
    EXPECT_EQ(tilt.slope().norm(), 0.0) << z;
  }
}

TEST(GroundLevel, BiasAndSlopeOfTheGroundAreToldApartByDrivingRound) {
  const Eigen::Vector2d bias(0.004, -0.003);
  const Eigen::Vector2d ground(0.01, 0.015);
  GroundLevel level;
  for (int i = 0; i < 60; ++i) {
    const double heading = 0.2 * i;
    level.add(heading, bias + rotation(-heading) * ground);
  }
  const Eigen::Vector2d own(0.02, 0.0);
  const Eigen::Vector2d shown = bias + rotation(-1.0) * ground + own;
  EXPECT_NEAR((level.relative(1.0, shown) - own).norm(), 0.0, 0.0005);
}

TEST(GroundLevel, UnevenGroundTellsLessOfItsPlaneThanALevelOne) {
  GroundLevel level;
  GroundLevel uneven;
  for (int i = 0; i < 60; ++i) {
    level.add(0.0, Eigen::Vector2d::Zero());
    // Waves of 3 m, sampled every 0.3 m.
    uneven.add(0.0, 0.017 * Eigen::Vector2d(std::sin(0.63 * i), std::cos(0.63 * i)));
  }
  EXPECT_NEAR(level.sigma(), 0.002, 1e-9);
  EXPECT_NEAR(uneven.sigma(), 0.006, 0.001);
}

TEST(Deskew, LeaningRobotKeepsItsPointsWhereALevelOneSeesThem) {
  Sweep sweep = sweep_of_range(3.0F);
  sweep.mount_height_m = 0.24;
  const ScanPoints scan = deskew({{sweep}, 1}, leaning({0.03, 0.0}));
  ASSERT_EQ(scan.points.size(), 101u);
  EXPECT_NEAR(scan.points[50].position.x(), 3.0 * std::cos(0.03) - 0.24 * 0.03, 1e-5);
  EXPECT_NEAR(scan.points[50].rise_m, 0.09, 1e-9);
}

TEST(Deskew, WhatALeaningRobotSeesNearTheGroundIsLeftOut) {
  const ScanPoints down = deskew({{sweep_of_range(10.0F)}, 1}, leaning({-0.03, 0.0}));
  EXPECT_TRUE(down.points.empty());
  const ScanPoints up = deskew({{sweep_of_range(10.0F)}, 1}, leaning({0.03, 0.0}));
  EXPECT_EQ(up.points.size(), 101u);
}

TEST(Deskew, WhatMayBeGroundIsLeftOutWhereTheLeanIsKnownBadly) {
  // 8 cm below the LiDAR, 10 m away.
  const Eigen::Vector2d slope(-0.008, 0.0);
  EXPECT_EQ(deskew({{sweep_of_range(10.0F)}, 1}, leaning(slope, 0.002)).points.size(), 101u);
  EXPECT_TRUE(deskew({{sweep_of_range(10.0F)}, 1}, leaning(slope, 0.006)).points.empty());
  // At short range, the tilt error does not matter.
  EXPECT_EQ(deskew({{sweep_of_range(2.0F)}, 1}, leaning(slope, 0.006)).points.size(), 101u);
}

class LeaningViewTest : public ::testing::Test {
 protected:
  Agreement seen(float range_m, double slope, double slope_sigma = 0.0) const {
    return agreement_of(sweep_of_range(range_m), {PoseVector::Zero(), {}, {slope, 0.0}, slope_sigma}, wall, 0.1);
  }

  /// A wall 5 m ahead.
  SurfelMap wall{{{{5.0, 0.0}, {-1.0, 0.0}, 4.0, 0.002, 50}}};
};

TEST_F(LeaningViewTest, LevelRobotThatSeesBeyondTheMapIsContradicted) {
  EXPECT_GT(seen(12.0F, 0.0).beyond, 20);
  EXPECT_GT(seen(2.0F, 0.0).hidden, 20);
}

TEST_F(LeaningViewTest, LookingUnderTheMapOrAtTheGroundSaysNothing) {
  const Agreement agreement = seen(12.0F, -0.03);
  EXPECT_EQ(agreement.hidden + agreement.beyond + agreement.missing, 0);
  EXPECT_EQ(agreement.unknown, 0);
}

TEST_F(LeaningViewTest, WhatMayBeGroundSaysNothingWhereTheLeanIsKnownBadly) {
  wall = SurfelMap({{{12.0, 0.0}, {-1.0, 0.0}, 4.0, 0.002, 50}});
  const Agreement known = seen(9.0F, -0.008, 0.002);
  EXPECT_GT(known.hidden, 10);
  EXPECT_GT(known.unknown, 10);
  const Agreement unknown = seen(9.0F, -0.008, 0.006);
  EXPECT_EQ(unknown.hidden, 0);
  EXPECT_EQ(unknown.unknown, 0);
}

TEST_F(LeaningViewTest, SurfaceMetAtAnotherHeightIsNotMissed) {
  const double slope = 0.01;
  EXPECT_EQ(seen(12.0F, slope).beyond, 0);
  // Now the surface was also met at that height.
  wall = SurfelMap({{{5.0, 0.0}, {-1.0, 0.0}, 4.0, 0.002, 50, 0.0, 0.05}});
  EXPECT_GT(seen(12.0F, slope).beyond, 20);
}

TEST_F(LeaningViewTest, SurfaceMissedALittleAboveOrBelowWhereItWasMetIsNotLookedThrough) {
  wall = SurfelMap({{{5.0, 0.0}, {-1.0, 0.0}, 4.0, 0.002, 50, -0.01, 0.01}});
  for (const double slope : {0.005, -0.005}) {
    const Agreement over = seen(12.0F, slope);
    EXPECT_GT(over.beyond, 20);
    EXPECT_EQ(over.through(), 0);
  }
  const Agreement at = seen(12.0F, 0.001);
  EXPECT_EQ(at.through(), at.beyond);
}

TEST_F(LeaningViewTest, WhatStandsNearInTheWayCountsHoweverTheRobotLeans) { EXPECT_GT(seen(2.0F, -0.03).hidden, 20); }

}  // namespace
}  // namespace mtr_localization
