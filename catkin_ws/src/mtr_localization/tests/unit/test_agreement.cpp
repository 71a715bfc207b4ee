/// @file
/// Result of beams near the ends of mapped surfaces.
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <limits>

#include "tracking/agreement.hpp"
#include "tracking/contradiction_watch.hpp"

namespace mtr_localization {
namespace {

constexpr float kNothing = std::numeric_limits<float>::infinity();

/// Returns a narrow fan ahead, of 1 rad, with this range in all beams.
Sweep fan(float range_m) {
  Sweep sweep;
  sweep.angle_min_rad = -0.5;
  sweep.angle_max_rad = 0.5;
  sweep.angle_increment_rad = 0.01;
  sweep.range_min_m = 0.1;
  sweep.range_max_m = 30.0;
  sweep.ranges_m.assign(101, range_m);
  return sweep;
}

class ViewAgreementTest : public ::testing::Test {
 protected:
  Agreement seen(const Sweep& sweep) const { return agreement_of(sweep, ViewPose{PoseVector::Zero()}, tyre, 0.1); }

  /// A tyre 5 m ahead, as wide as the lateral tolerance on both sides.
  SurfelMap tyre{{{{5.0, 0.0}, {-1.0, 0.0}, 0.4, 0.002, 50}}};
};

TEST_F(ViewAgreementTest, TyreWhereItIsExpectedAgreesAndNothingBesideItContradicts) {
  Sweep sweep = fan(kNothing);
  for (std::size_t beam = 46; beam <= 54; ++beam) {
    sweep.ranges_m[beam] = 5.0F;
  }
  const Agreement agreement = seen(sweep);
  EXPECT_GT(agreement.seen, 3);
  EXPECT_EQ(agreement.unknown, 0);
  EXPECT_DOUBLE_EQ(agreement.share_of_expected(), 1.0);
}

TEST_F(ViewAgreementTest, KnownWallBehindWhatIsExpectedIsSeen) {
  EXPECT_GT(seen(fan(8.0F)).beyond + seen(fan(8.0F)).passed, 3);
  // The fan of 8 m meets a wall of short pieces, each perpendicular to its beam.
  std::vector<Surfel> surfels = tyre.surfels();
  for (double angle = -0.5; angle <= 0.5; angle += 0.02) {
    const Eigen::Vector2d direction(std::cos(angle), std::sin(angle));
    surfels.push_back({8.0 * direction, -direction, 0.2, 0.002, 50});
  }
  tyre = SurfelMap(surfels);
  EXPECT_EQ(seen(fan(8.0F)).beyond + seen(fan(8.0F)).passed, 0);
  EXPECT_GT(seen(fan(7.0F)).hidden, 20);
}

TEST_F(ViewAgreementTest, SomethingBesideTheEndOfASurfaceDoesNotAgreeWithNothing) {
  const Agreement agreement = seen(fan(2.0F));
  EXPECT_EQ(agreement.seen, 0);
  EXPECT_GT(agreement.hidden, 3);
  EXPECT_GT(agreement.unknown, 20);
}

TEST_F(ViewAgreementTest, EdgesExcuseNothingWhenNothingIsSeen) {
  const Agreement agreement = seen(fan(kNothing));
  EXPECT_GT(agreement.passed, 3);
  EXPECT_DOUBLE_EQ(agreement.share_of_expected(), 0.0);
}

TEST_F(ViewAgreementTest, SurfaceAsFarAsideAsItMayBeOffIsSeen) {
  Sweep sweep = fan(kNothing);
  for (std::size_t beam = 47; beam <= 56; ++beam) {
    sweep.ranges_m[beam] = 5.0F;
  }
  EXPECT_EQ(seen(sweep).unknown, 0);
  EXPECT_DOUBLE_EQ(seen(sweep).share_of_expected(), 1.0);
}

/// Returns true if views of 40 beams every 40 ms, with this number through surfaces, are excessive within a time.
bool is_too_much(int through, double time_s, int expected = 40, double slope = 0.0) {
  ContradictionWatch watch;
  Agreement view;
  view.beyond = through / 2;
  view.missing = through - view.beyond;
  view.seen = expected - through;
  bool found = false;
  for (std::int64_t ns = 1; static_cast<double>(ns) * 1e-9 <= time_s; ns += 40'000'000) {
    found = found || watch.add(ns, view, {slope, 0.0});
  }
  return found;
}

TEST(ContradictionWatch, FewBeamsThatLookThroughAreUsualForever) { EXPECT_FALSE(is_too_much(3, 60.0)); }

TEST(ContradictionWatch, ThirdOfTheViewIsTooMuchWithinASecond) {
  EXPECT_TRUE(is_too_much(14, 1.0));
  EXPECT_FALSE(is_too_much(14, 0.1));
}

TEST(ContradictionWatch, FifthOfAViewOfWhichAllElseIsSeenIsAThingThatHasLeft) { EXPECT_FALSE(is_too_much(8, 60.0)); }

TEST(ContradictionWatch, WhatIsOverlookedFromLowDownIsNoContradictionWhileAllReturnsAreOnTheMap) {
  ContradictionWatch watch;
  // View from 10 m in front of a van with only its wheels on the map, at the correct place.
  Agreement view;
  view.seen = 20;
  view.missing = 20;
  view.passed = 60;
  view.unknown = 1;
  bool found = false;
  for (std::int64_t i = 1; i < 1500; ++i) {
    found = found || watch.add(i * 40'000'000, view, Eigen::Vector2d::Zero());
  }
  EXPECT_FALSE(found);
  // Some returns are not on the map.
  view.unknown = 8;
  for (std::int64_t i = 1500; i < 1600; ++i) {
    found = found || watch.add(i * 40'000'000, view, Eigen::Vector2d::Zero());
  }
  EXPECT_TRUE(found);
}

TEST(ContradictionWatch, OnSlopesTheLidarLooksOverAndUnderSurfaces) { EXPECT_FALSE(is_too_much(14, 60.0, 40, 0.03)); }

TEST(ContradictionWatch, RobotThatPitchesAsItSetsOffLooksUnderTheCarAndNotThroughIt) {
  ContradictionWatch watch;
  // View from 7 m next to a hatchback, 3 cm above its lower edge, while the robot accelerated for 0.7 s.
  Agreement view;
  view.seen = 13;
  view.missing = 17;
  view.beyond = 2;
  view.passed = 7;
  view.unsure = 17;
  bool found = false;
  for (std::int64_t i = 1; i < 18; ++i) {
    found = found || watch.add(i * 40'000'000, view, {-0.006, 0.0});
  }
  EXPECT_FALSE(found);
  // The same surfaces are missed at heights at which they were met.
  view.unsure = 0;
  for (std::int64_t i = 18; i < 35; ++i) {
    found = found || watch.add(i * 40'000'000, view, {-0.006, 0.0});
  }
  EXPECT_TRUE(found);
}

TEST(ContradictionWatch, OneViewAloneIsNotTooMuch) { EXPECT_FALSE(is_too_much(40, 0.05)); }

TEST(ContradictionWatch, TooFewExpectedBeamsTellNothing) { EXPECT_FALSE(is_too_much(7, 60.0, 7)); }

TEST(ContradictionWatch, WhatIsHiddenIsNoContradiction) {
  ContradictionWatch watch;
  Agreement view;
  view.hidden = 40;
  for (std::int64_t i = 1; i < 1000; ++i) {
    EXPECT_FALSE(watch.add(i * 40'000'000, view, Eigen::Vector2d::Zero()));
  }
}

TEST(ContradictionWatch, UsualViewsMakeGoodWhatWasTooMuch) {
  ContradictionWatch watch;
  Agreement bad, good;
  bad.beyond = bad.seen = 20;
  good.seen = 40;
  bool found = false;
  for (std::int64_t i = 1; i < 1000; ++i) {
    found = found || watch.add(i * 40'000'000, i % 50 == 0 ? bad : good, Eigen::Vector2d::Zero());
  }
  EXPECT_FALSE(found);
}

}  // namespace
}  // namespace mtr_localization
