/// @file
/// Selection of key frames, and mean of scans at rest.
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "mapping/key_frame_selector.hpp"

namespace mtr_localization {
namespace {

constexpr std::int64_t kPeriodNs = 40'000'000;

/// Returns a scan of two LiDARs with a wall 3 m ahead, with noise.
ScanPoints wall(std::mt19937& random, std::int64_t stamp_ns) {
  std::normal_distribution<double> noise(0.0, 0.01);
  ScanPoints scan;
  scan.stamp_ns = stamp_ns;
  for (const double lidar_x : {0.2, -0.2}) {
    for (int beam = -50; beam <= 50; ++beam) {
      const double angle = 0.00655 * beam;
      const Eigen::Vector2d direction(std::cos(angle), std::sin(angle));
      const double range = (3.0 - lidar_x) / direction.x() + noise(random);
      scan.points.push_back({Eigen::Vector2d(lidar_x, 0.0) + range * direction, direction, range});
    }
  }
  return scan;
}

/// Robot that drives along x, and its key frames.
class Robot {
 public:
  void drive(double distance_m, double turn_rad = 0.0) {
    constexpr int kSteps = 20;
    for (int i = 0; i < kSteps; ++i) {
      odom_ += PoseVector(distance_m / kSteps, 0.0, turn_rad / kSteps);
      selector_.travel(distance_m / kSteps, turn_rad / kSteps);
      scan(false);
    }
  }

  void stand(int scans) {
    for (int i = 0; i < scans; ++i) {
      scan(true);
    }
  }

  void lead(const Eigen::Matrix3d& covariance) { selector_.lead(covariance); }

  const std::vector<KeyFrame>& frames() const { return frames_; }

 private:
  void scan(bool standing) {
    stamp_ns_ += kPeriodNs;
    KeyFrameCandidate candidate;
    candidate.scan = wall(random_, stamp_ns_);
    candidate.pose = odom_ + PoseVector(5.0, 0.0, 0.0);
    candidate.odom = odom_;
    candidate.standing = standing;
    candidate.gyro_bias_sigma_radps = 1e-4;
    if (const auto frame = selector_.add(candidate)) {
      frames_.push_back(*frame);
    }
  }

  KeyFrameSelector selector_{SensorParameters{}};
  PoseVector odom_ = PoseVector::Zero();
  std::int64_t stamp_ns_ = 0;
  std::mt19937 random_{1};
  std::vector<KeyFrame> frames_;
};

TEST(KeyFrameSelector, DrivingGivesAKeyFrameEveryThreeDecimetres) {
  Robot robot;
  for (int i = 0; i < 6; ++i) {
    robot.drive(0.5);
  }
  ASSERT_GE(robot.frames().size(), 9U);
  EXPECT_LE(robot.frames().size(), 11U);
  EXPECT_NEAR(robot.frames()[1].motion.x(), 0.3, 0.026);
  EXPECT_EQ(robot.frames()[1].sweeps, 1);
}

TEST(KeyFrameSelector, TurningOnTheSpotGivesKeyFramesToo) {
  Robot robot;
  robot.drive(0.0, M_PI_2);
  EXPECT_GE(robot.frames().size(), 5U);
}

TEST(KeyFrameSelector, RestGivesOneKeyFrameWhichIsTheMeanOfItsScans) {
  Robot robot;
  robot.stand(100);
  ASSERT_EQ(robot.frames().size(), 1U);
  const KeyFrame& frame = robot.frames().front();
  EXPECT_TRUE(frame.standing);
  EXPECT_EQ(frame.sweeps, 10);
  EXPECT_EQ(frame.stamp_ns, 10 * kPeriodNs);
  ASSERT_EQ(frame.scan.points.size(), 202U);
  double squares = 0.0;
  for (const ScanPoint& point : frame.scan.points) {
    squares += std::pow((point.position.x() - 3.0) / point.direction.x(), 2.0) / 202.0;
    EXPECT_NEAR(point.direction.norm(), 1.0, 1e-12);
  }
  // Ten times the measurements reduce the noise to about a third.
  EXPECT_LT(std::sqrt(squares), 0.005);
}

TEST(KeyFrameSelector, RestTooShortForAMeanIsNoKeyFrame) {
  Robot robot;
  robot.stand(5);
  EXPECT_TRUE(robot.frames().empty());
}

TEST(KeyFrameSelector, MotionIsLessCertainAfterMoreOfIt) {
  Robot robot;
  robot.stand(10);
  robot.drive(0.28);
  robot.drive(0.05);
  robot.drive(0.05, 0.3);
  ASSERT_EQ(robot.frames().size(), 3U);
  const Eigen::Matrix3d straight = robot.frames()[1].motion_covariance;
  const Eigen::Matrix3d turning = robot.frames()[2].motion_covariance;
  EXPECT_GT(straight(0, 0), 0.0);
  EXPECT_GT(turning(0, 0), straight(0, 0));
  EXPECT_GT(turning(2, 2), straight(2, 2));
}

TEST(KeyFrameSelector, WayThatNobodySawCountsOnce) {
  Robot robot;
  robot.stand(10);
  robot.lead(Eigen::Vector3d(0.01, 0.02, 0.04).asDiagonal());
  robot.drive(0.28);
  robot.drive(0.34);
  ASSERT_EQ(robot.frames().size(), 3U);
  const Eigen::Matrix3d led = robot.frames()[1].motion_covariance - robot.frames()[2].motion_covariance;
  EXPECT_NEAR(led(0, 0), 0.01, 1e-4);
  // Motion after an unmeasured turn has a lateral uncertainty.
  EXPECT_GT(led(1, 1), 0.02);
  EXPECT_NEAR(led(2, 2), 0.04, 1e-4);
}

TEST(ScanMean, SomebodyWhoPassesIsLeftOut) {
  std::mt19937 random(2);
  ScanMean mean;
  for (int i = 0; i < 10; ++i) {
    ScanPoints scan = wall(random, i);
    if (i % 3 == 0) {
      scan.points[10].position -= 1.5 * scan.points[10].direction;
      scan.points[10].range_m -= 1.5;
    }
    mean.add(scan);
  }
  for (const ScanPoint& point : mean.mean().points) {
    EXPECT_NEAR(point.position.x(), 3.0, 0.02);
  }
}

TEST(ScanMean, BeamThatSeldomReturnsIsLeftOut) {
  std::mt19937 random(2);
  ScanMean mean;
  for (int i = 0; i < 10; ++i) {
    ScanPoints scan = wall(random, i);
    scan.points.resize(i < 4 ? 202 : 201);
    mean.add(scan);
  }
  EXPECT_EQ(mean.mean().points.size(), 201U);
}

}  // namespace
}  // namespace mtr_localization
