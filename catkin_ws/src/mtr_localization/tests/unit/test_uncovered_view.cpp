/// @file
/// Detection that an obstruction has gone.
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "tracking/uncovered_view.hpp"

namespace mtr_localization {
namespace {

constexpr std::int64_t kTickNs = 40'000'000;
constexpr double kTickS = 0.04;
constexpr ScanFit kOnMap{40, 38};
/// Half a metre off the correct place.
constexpr ScanFit kBesideMap{40, 30};
constexpr ScanFit kFew{4, 4};

/// Lost at the origin of odom, where the view agreed last.
class UncoveredViewTest : public ::testing::Test {
 protected:
  /// Returns the ticks of an expected view on a straight path until it is sufficient; 0 if it never is.
  int ticks(double speed_mps, double turn_radps, const ScanFit& fit, double duration_s) {
    const int most = static_cast<int>(duration_s / kTickS);
    for (int tick = 1; tick <= most; ++tick) {
      odom.x() += speed_mps * kTickS;
      odom.z() += turn_radps * kTickS;
      now_ns += kTickNs;
      if (view.add(now_ns, PoseVector::Zero(), odom, is_contradicted, fit)) {
        return tick;
      }
    }
    return 0;
  }

  UncoveredView view;
  PoseVector odom = PoseVector::Zero();
  std::int64_t now_ns = 1'000'000'000;
  bool is_contradicted = false;
};

TEST_F(UncoveredViewTest, SecondIsEnoughNearThePlaceWhereItAgreedLast) { EXPECT_EQ(ticks(0.0, 0.0, kOnMap, 5.0), 26); }

TEST_F(UncoveredViewTest, FewReturnsAreEnoughThere) { EXPECT_EQ(ticks(0.0, 0.0, kFew, 5.0), 26); }

TEST_F(UncoveredViewTest, ViewThatLiesBesideTheMapIsNotEnoughThere) { EXPECT_EQ(ticks(0.0, 0.0, kBesideMap, 20.0), 0); }

TEST_F(UncoveredViewTest, ElsewhereItHasToGoOnOverAWayOrATurn) {
  odom.x() = 3.0;
  EXPECT_EQ(ticks(0.0, 0.0, kOnMap, 20.0), 0);
  const int way = ticks(0.5, 0.0, kOnMap, 5.0);
  EXPECT_NEAR(way * kTickS * 0.5, 1.0, 0.05);
  view.reset();
  const int turn = ticks(0.0, 0.5, kOnMap, 5.0);
  EXPECT_NEAR(turn * kTickS * 0.5, 1.0, 0.05);
}

TEST_F(UncoveredViewTest, ElsewhereAViewThatLiesBesideTheMapIsNeverEnough) {
  odom.x() = 3.0;
  EXPECT_EQ(ticks(0.5, 0.0, kBesideMap, 20.0), 0);
}

TEST_F(UncoveredViewTest, ReturnsThatTellNothingAreNeverEnough) { EXPECT_EQ(ticks(0.5, 0.0, {0, 0}, 20.0), 0); }

TEST_F(UncoveredViewTest, AfterAContradictionOnlyALongerWayIsEnough) {
  is_contradicted = true;
  EXPECT_EQ(ticks(0.0, 0.5, kOnMap, 5.0), 0);
  const int way = ticks(0.5, 0.0, kOnMap, 20.0);
  EXPECT_NEAR(way * kTickS * 0.5, 2.0, 0.05);
  view.reset();
  EXPECT_EQ(ticks(0.5, 0.0, kBesideMap, 20.0), 0);
}

TEST_F(UncoveredViewTest, WhatWasSeenBeforeItWasLostFromSightCountsNoMore) {
  EXPECT_EQ(ticks(0.0, 0.0, kBesideMap, 0.9), 0);
  view.reset();
  EXPECT_EQ(ticks(0.0, 0.0, kOnMap, 5.0), 26);
}

}  // namespace
}  // namespace mtr_localization
