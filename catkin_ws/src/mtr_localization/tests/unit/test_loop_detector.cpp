/// @file
/// Closure of a drive.
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "replay/loop_detector.hpp"

namespace mtr_localization::replay {
namespace {

std::vector<KeyFrame> frames_at(const std::vector<Eigen::Vector2d>& places) {
  std::vector<KeyFrame> frames;
  for (const Eigen::Vector2d& place : places) {
    KeyFrame frame;
    frame.pose.head<2>() = place;
    frames.push_back(frame);
  }
  return frames;
}

TEST(LoopDetector, WayRoundClosesWhenItComesBack) {
  LoopDetector watch;
  std::vector<Eigen::Vector2d> places;
  for (int degrees = 0; degrees <= 355; degrees += 5) {
    places.emplace_back(4.0 * std::cos(degrees * M_PI / 180.0), 3.0 * std::sin(degrees * M_PI / 180.0));
    // The path is 0.8 m from its start 15 degrees before its end.
    EXPECT_EQ(watch.closes(frames_at(places)), degrees >= 345) << degrees;
  }
}

TEST(LoopDetector, WayOutAndBackIsNoLoop) {
  LoopDetector watch;
  std::vector<Eigen::Vector2d> places;
  for (int i = 0; i <= 40; ++i) {
    places.emplace_back(0.3 * std::min(i, 40 - i), 0.0);
    EXPECT_FALSE(watch.closes(frames_at(places))) << i;
  }
}

}  // namespace
}  // namespace mtr_localization::replay
