/// @file
/// Sweeps: rejection, time of use, and removal of motion distortion.
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <limits>

#include "map_names.hpp"
#include "scans/deskew.hpp"
#include "scans/scan_queue.hpp"

namespace mtr_localization {
namespace {

constexpr std::int64_t kMs = 1'000'000;
constexpr float kInf = std::numeric_limits<float>::infinity();

Sweep sweep_at(std::int64_t stamp_ns, float range_m = 3.0F, std::size_t beams = 101) {
  Sweep sweep;
  sweep.stamp_ns = stamp_ns;
  sweep.angle_min_rad = -0.5;
  sweep.angle_max_rad = 0.5;
  sweep.angle_increment_rad = 1.0 / static_cast<double>(beams - 1);
  sweep.time_increment_s = 0.03 / static_cast<double>(beams);
  sweep.scan_time_s = 0.04;
  sweep.range_min_m = 0.1;
  sweep.range_max_m = 30.0;
  sweep.ranges_m.assign(beams, range_m);
  return sweep;
}

/// Returns steps of 20 ms from time 0, each with this motion.
FilterHistory history_of(int steps, double distance_m, double angle_rad) {
  FilterHistory history(PoseFilter(SensorParameters{}), 0);
  for (int i = 1; i <= steps; ++i) {
    history.advance(i * 20 * kMs, {FilterInput::Kind::kMove, {0.02, distance_m, angle_rad}});
  }
  return history;
}

TEST(Sweep, GoodOneHasNoProblemAndAnyNumberOfBeams) {
  EXPECT_EQ(sweep_at(0).problem(), "");
  EXPECT_EQ(sweep_at(0, 3.0F, 1081).problem(), "");
}

TEST(Sweep, NumberOfBeamsThatDoesNotFitTheAnglesIsTold) {
  Sweep sweep = sweep_at(0);
  sweep.ranges_m.resize(50);
  EXPECT_EQ(sweep.problem(),
            "A scan's number of beams contradicts its angles; correct angle_min, angle_max or angle_increment in its "
            "driver.");
}

TEST(Sweep, HeaderThatIsNotANumberIsTold) {
  Sweep sweep = sweep_at(0);
  sweep.angle_min_rad = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(sweep.problem(),
            "A scan's angles, times or range limits are not finite; correct the settings of its driver.");
}

TEST(Sweep, BeamsAreTimedAsToldWhereTheDriverDoesNotSayIt) {
  Sweep silent = sweep_at(0);
  silent.time_increment_s = 0.0;
  silent.time_beams(1e-4);
  EXPECT_EQ(silent.last_beam_ns(), 10 * kMs);
  Sweep said = sweep_at(0);
  const std::int64_t last_ns = said.last_beam_ns();
  said.time_beams(1e-4);
  EXPECT_EQ(said.last_beam_ns(), last_ns);
}

TEST(Sweep, EmptyOneAndNegativeTimeAreTold) {
  Sweep sweep = sweep_at(0);
  sweep.time_increment_s = -1e-4;
  EXPECT_EQ(sweep.problem(),
            "A scan lasts less than 0 s or more than 0.25 s; its scan_time and time_increment must be in seconds.");
  sweep.ranges_m.clear();
  EXPECT_EQ(sweep.problem(), "A scan has fewer than two beams; look for the fault in the LiDAR or its driver.");
}

TEST(Deskew, RangesThatAreNoneGiveNoPoints) {
  for (const float range : {0.0F, -1.0F, kInf, -kInf, std::numeric_limits<float>::quiet_NaN(), 31.0F, 0.05F}) {
    const FilterHistory history = history_of(3, 0.0, 0.0);
    const ScanPoints scan = deskew({{sweep_at(0, range)}, 1}, history);
    EXPECT_TRUE(scan.points.empty()) << range;
  }
}

TEST(Deskew, SingleReturnBetweenOthersIsADropOfRain) {
  Sweep sweep = sweep_at(0);
  sweep.ranges_m[40] = 1.0F;
  const ScanPoints scan = deskew({{sweep}, 1}, history_of(3, 0.0, 0.0));
  EXPECT_EQ(scan.points.size(), 100u);
}

TEST(Deskew, BeamOnAnEdgeBetweenTwoSurfacesIsLeftOut) {
  Sweep sweep = sweep_at(0);
  for (std::size_t i = 51; i < 101; ++i) {
    sweep.ranges_m[i] = 5.0F;
  }
  sweep.ranges_m[50] = 4.0F;
  const ScanPoints scan = deskew({{sweep}, 1}, history_of(3, 0.0, 0.0));
  EXPECT_EQ(scan.points.size(), 100u);
}

TEST(Deskew, PointsOfATurningRobotLieWhereTheyAreAtTheReference) {
  // At 1 rad/s, a beam at 30 ms is 0.01 rad ahead of the reference at 20 ms.
  const FilterHistory history = history_of(3, 0.0, 0.02);
  const ScanPoints scan = deskew({{sweep_at(0)}, 1}, history);
  ASSERT_EQ(scan.points.size(), 101u);
  EXPECT_NEAR(std::atan2(scan.points[0].position.y(), scan.points[0].position.x()), -0.5 - 0.02, 1e-6);
  EXPECT_NEAR(std::atan2(scan.points[100].direction.y(), scan.points[100].direction.x()), 0.5 + 0.0097, 1e-4);
}

TEST(Deskew, PointsOfADrivingRobotLieWhereTheyAreAtTheReference) {
  // 1 m/s, and a LiDAR mounted 0.1 m ahead.
  Sweep sweep = sweep_at(0);
  sweep.mount = {0.1, 0.0, 0.0};
  const ScanPoints scan = deskew({{sweep}, 1}, history_of(3, 0.02, 0.0));
  EXPECT_NEAR(scan.points[50].position.x(), 3.0 + 0.1 + 0.015 - 0.02, 1e-3);
}

TEST(ScanQueue, InLockStepASweepIsUsedOneStepAfterItsEnd) {
  ScanQueue queue(20 * kMs);
  ASSERT_EQ(queue.add(sweep_at(0)), "");
  EXPECT_TRUE(queue.take_due(history_of(2, 0.0, 0.0)).empty());
  const auto sets = queue.take_due(history_of(3, 0.0, 0.0));
  ASSERT_EQ(sets.size(), 1u);
  EXPECT_EQ(sets[0].step, 1u);
}

TEST(ScanQueue, OnTheRobotsClockASweepDoesNotWaitForTheNextWheelOdometry) {
  ScanQueue queue(std::nullopt);
  queue.add(sweep_at(0));
  EXPECT_TRUE(queue.take_due(history_of(0, 0.0, 0.0)).empty());
  EXPECT_EQ(queue.take_due(history_of(1, 0.0, 0.0)).size(), 1u);
}

TEST(ScanQueue, FrontAndRearOfOneTimeAreOneSetInWhateverOrderTheyCome) {
  Sweep rear = sweep_at(0);
  rear.lidar = Lidar::kRear;
  ScanQueue queue(20 * kMs);
  queue.add(rear);
  queue.add(sweep_at(0));
  const auto sets = queue.take_due(history_of(3, 0.0, 0.0));
  ASSERT_EQ(sets.size(), 1u);
  ASSERT_EQ(sets[0].sweeps.size(), 2u);
  EXPECT_EQ(sets[0].sweeps[0].lidar, Lidar::kFront);
  EXPECT_EQ(deskew(sets[0], history_of(3, 0.0, 0.0)).points.size(), 202u);
}

TEST(ScanQueue, TimeThatGoesBackwardsIsRefusedAndCounted) {
  ScanQueue queue(20 * kMs);
  queue.add(sweep_at(80 * kMs));
  EXPECT_EQ(queue.add(sweep_at(40 * kMs)).find("A scan is not newer"), 0U);
  EXPECT_EQ(queue.add(sweep_at(80 * kMs)).find("A scan is not newer"), 0U);
  EXPECT_EQ(queue.refused(), 2);
  EXPECT_EQ(queue.add(sweep_at(120 * kMs, 3.1F)), "");
}

TEST(ScanQueue, DriverThatWasStartedAnewIsUsedAgain) {
  ScanQueue queue(20 * kMs);
  queue.add(sweep_at(100'000 * kMs));
  EXPECT_EQ(queue.add(sweep_at(0, 3.1F)), "");
}

TEST(ScanQueue, SweepThatRepeatsTheOneBeforeIsOfAFrozenLidar) {
  ScanQueue queue(20 * kMs);
  queue.add(sweep_at(0));
  EXPECT_NE(queue.add(sweep_at(40 * kMs)).find("is frozen"), std::string::npos);
  EXPECT_EQ(queue.add(sweep_at(80 * kMs, 3.01F)), "");
  // The rear LiDAR is another sensor, and an empty field repeats itself.
  Sweep rear = sweep_at(80 * kMs, 3.01F);
  rear.lidar = Lidar::kRear;
  EXPECT_EQ(queue.add(rear), "");
  const float nothing = std::numeric_limits<float>::infinity();
  EXPECT_EQ(queue.add(sweep_at(120 * kMs, nothing)), "");
  EXPECT_EQ(queue.add(sweep_at(160 * kMs, nothing)), "");
}

TEST(ScanQueue, SweepFromBeforeTheHistoryIsRefused) {
  ScanQueue queue(20 * kMs);
  queue.add(sweep_at(0));
  FilterHistory history(PoseFilter(SensorParameters{}), 1000 * kMs);
  EXPECT_TRUE(queue.take_due(history).empty());
  EXPECT_EQ(queue.refused(), 1);
}

TEST(ScanQueue, WithoutWheelOdometrySweepsDoNotPileUp) {
  ScanQueue queue(20 * kMs);
  for (int i = 0; i < 100; ++i) {
    queue.add(sweep_at(i * 40 * kMs, 3.0F + 0.01F * static_cast<float>(i)));
  }
  EXPECT_EQ(queue.refused(), 80);
}

TEST(ScanQueue, LidarWhoseStampsRunAheadDoesNotPushOutTheOther) {
  for (const std::int64_t ahead_ns : {0 * kMs, 500 * kMs, 2000 * kMs, 3'600'000 * kMs}) {
    ScanQueue queue(std::nullopt);
    FilterHistory history(PoseFilter(SensorParameters{}), 0);
    int front_used = 0;
    for (int number = 0; number < 100; ++number) {
      const float range_m = 3.0F + 0.01F * static_cast<float>(number);
      Sweep rear = sweep_at(number * 40 * kMs + ahead_ns, range_m);
      rear.lidar = Lidar::kRear;
      queue.add(rear);
      queue.add(sweep_at(number * 40 * kMs, range_m));
      for (const int half : {1, 2}) {
        history.advance((2 * number + half) * 20 * kMs, {FilterInput::Kind::kMove, {0.02, 0.0, 0.0}});
      }
      for (const ScanSet& set : queue.take_due(history)) {
        front_used += set.sweeps[0].lidar == Lidar::kFront ? 1 : 0;
      }
    }
    EXPECT_EQ(front_used, 100) << ahead_ns;
  }
}

TEST(FilterHistory, CorrectionInThePastCountsAsIfItHadComeInTime) {
  PoseCorrection correction;
  correction.information = Eigen::Vector3d(1e6, 1e6, 1e6).asDiagonal();
  correction.information_vector = {100.0, -200.0, 10.0};
  FilterHistory late = history_of(10, 0.01, 0.02);
  late.change(5, [&](PoseFilter& filter) { filter.correct(correction); });
  FilterHistory in_time = history_of(5, 0.01, 0.02);
  in_time.change(5, [&](PoseFilter& filter) { filter.correct(correction); });
  for (int i = 6; i <= 10; ++i) {
    in_time.advance(i * 20 * kMs, {FilterInput::Kind::kMove, {0.02, 0.01, 0.02}});
  }
  EXPECT_LT((late.newest().filter.pose() - in_time.newest().filter.pose()).norm(), 1e-12);
  EXPECT_LT((late.newest().filter.pose_covariance() - in_time.newest().filter.pose_covariance()).norm(), 1e-15);
}

TEST(FilterHistory, OdomDoesNotJumpWhenThePoseIsCorrected) {
  FilterHistory history = history_of(10, 0.01, 0.0);
  const PoseVector before = history.newest().odom;
  history.change(9, [](PoseFilter& filter) { filter.set_pose({5.0, 5.0, 1.0}, Eigen::Matrix3d::Identity()); });
  EXPECT_EQ(history.newest().odom, before);
  EXPECT_NEAR(history.newest().filter.x_m(), 5.0 + 0.01 * std::cos(1.0), 1e-9);
}

TEST(FilterHistory, PoseBetweenStepsIsInterpolated) {
  const FilterHistory history = history_of(3, 0.02, 0.0);
  EXPECT_NEAR(history.odom_at(30 * kMs).x(), 0.03, 1e-12);
}

TEST(FilterHistory, PoseAfterTheNewestStepGoesOnAsThatStepDid) {
  const FilterHistory history = history_of(3, 0.02, 0.0);
  EXPECT_NEAR(history.odom_at(70 * kMs).x(), 0.07, 1e-12);
  EXPECT_NEAR(history_of(0, 0.0, 0.0).odom_at(10 * kMs).x(), 0.0, 1e-12);
}

}  // namespace
}  // namespace mtr_localization
