/// @file
/// Rejection of key frames and of maps that cannot be trusted.
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "mtr_surfel_map/adjustment/map_adjustment.hpp"
#include "synthetic_loop.hpp"

namespace mtr_surfel_map {
namespace {

using synthetic::drive;
using synthetic::LoopOptions;

LoopOptions open_field() {
  LoopOptions options;
  options.scene = "open";
  return options;
}

void expect_refused(const std::vector<KeyFrame>& key_frames, const std::string& part) {
  const AdjustedMap map = adjust(key_frames, AdjustmentParameters{});
  EXPECT_FALSE(map.valid);
  EXPECT_NE(map.message.text.find(part), std::string::npos) << map.message.text;
  EXPECT_EQ(map.pose_covariances.size(), key_frames.size());
}

TEST(MapVerdict, NoKeyFramesAreNoMap) { expect_refused({}, "Only 0 key-frames"); }

TEST(MapVerdict, HalfAWayRoundIsNoMap) {
  LoopOptions options = open_field();
  options.turns = 0.5;
  expect_refused(drive(options).key_frames, "not closed");
}

TEST(MapVerdict, ClosedWayOfANoisyLidarRoundTheCarAloneIsAMap) {
  LoopOptions options = open_field();
  options.range_noise_m = 0.025;
  for (options.seed = 1; options.seed <= 3; ++options.seed) {
    const AdjustedMap map = adjust(drive(options).key_frames, AdjustmentParameters{});
    EXPECT_TRUE(map.valid) << map.message.text;
  }
}

LoopOptions to_and_fro() {
  LoopOptions options;
  options.scene = "beside";
  options.turns = 0.5;
  options.to_and_fro = true;
  options.rear_lidar = false;
  options.range_noise_m = 0.02;
  return options;
}

TEST(MapVerdict, WayToAndFroIsClosedThoughTheRobotLooksTheOtherWayWhereItBegan) {
  LoopOptions options = to_and_fro();
  for (options.seed = 1; options.seed <= 3; ++options.seed) {
    const AdjustedMap map = adjust(drive(options).key_frames, AdjustmentParameters{});
    EXPECT_TRUE(map.valid) << map.message.text;
  }
}

TEST(MapVerdict, WayThatEndsWhereOtherThingsAreSeenThanWhereItBeganIsNoMap) {
  LoopOptions options = to_and_fro();
  for (options.seed = 1; options.seed <= 3; ++options.seed) {
    std::vector<KeyFrame> frames = drive(options).key_frames;
    const std::size_t middle = frames.size() / 2;
    for (std::size_t back = 1; back <= 8; ++back) {
      frames[frames.size() - back].scan = frames[middle - back].scan;
    }
    expect_refused(frames, "not closed");
  }
}

TEST(MapVerdict, OneMotionThatWheelsAndGyroExcludeIsNoMap) {
  for (const PoseVector& jump : {PoseVector(0.4, 0.0, 0.0), PoseVector(0.0, 0.0, 0.06)}) {
    std::vector<KeyFrame> frames = drive(LoopOptions{}).key_frames;
    KeyFrame& jumping = frames[frames.size() / 3];
    jumping.motion += jump;
    expect_refused(frames, "wheels and gyro exclude");
    // An unknown motion does not exclude anything.
    jumping.motion_covariance = Eigen::Matrix3d::Identity();
    EXPECT_TRUE(adjust(frames, AdjustmentParameters{}).valid);
  }
}

TEST(MapVerdict, KeyFrameThatIsNoNumberIsNoMap) {
  std::vector<KeyFrame> frames = drive(open_field()).key_frames;
  frames[7].scan.points[3].position.x() = std::nan("");
  expect_refused(frames, "no numbers");
}

TEST(MapVerdict, NothingInViewIsNoMap) {
  std::vector<KeyFrame> frames = drive(open_field()).key_frames;
  for (KeyFrame& frame : frames) {
    frame.scan.points.clear();
  }
  expect_refused(frames, "is the Car in view?");
}

TEST(MapVerdict, ScansWithoutAnySurfaceAreNoMap) {
  std::vector<KeyFrame> frames = drive(open_field()).key_frames;
  std::mt19937 random(1);
  std::uniform_real_distribution<double> range(0.5, 20.0);
  for (KeyFrame& frame : frames) {
    for (ScanPoint& point : frame.scan.points) {
      const double change = range(random) - point.range_m;
      point.position += change * point.direction;
      point.range_m += change;
    }
  }
  EXPECT_FALSE(adjust(frames, AdjustmentParameters{}).valid);
}

TEST(MapVerdict, ParameterOutOfItsRangeIsRefusedByName) {
  AdjustmentParameters parameters;
  parameters.range_noise_m = 1.0;
  try {
    adjust({}, parameters);
    ADD_FAILURE() << "accepted";
  } catch (const mtr_core::ConfigurationError& error) {
    EXPECT_NE(std::string(error.what()).find("range_noise_m"), std::string::npos);
  }
}

}  // namespace
}  // namespace mtr_surfel_map
