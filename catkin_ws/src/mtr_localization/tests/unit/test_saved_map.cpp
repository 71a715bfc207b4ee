/// @file
/// A stored map is restored without loss, or one sentence has the reason why it is not usable.
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <string>

#include "map_names.hpp"
#include "ros/map_messages.hpp"
#include "ros/saved_map.hpp"
#include "sentence.hpp"

namespace mtr_localization::replay {
namespace {

TEST(SavedMap, ComesBackFromItsFileAsItWas) {
  MapResult result;
  result.map_car_id = 7;
  result.revision = 3;
  result.map.surfels.push_back({{1.0, -2.0}, {0.6, 0.8}, 0.25, 0.003, 12, -0.1, 0.2, 0.05, 0.01});
  result.map.range_bias.value_m << 0.01, -0.02;
  result.map.range_bias.covariance << 1e-6, 2e-7, 2e-7, 3e-6;
  const std::string path = ::testing::TempDir() + "saved/map.bag";
  write_bag(saved_map_of(result, message_of(result), grid_message_of(result)), path);
  const auto saved = read_map(path);
  ASSERT_TRUE(saved);
  const Memory memory = memory_of(saved->map);
  EXPECT_EQ(memory.map_car_id, 7U);
  EXPECT_EQ(memory.revision, 3U);
  ASSERT_EQ(memory.map.surfels.size(), 1U);
  const Surfel& surfel = memory.map.surfels.front();
  EXPECT_EQ(surfel.position, Eigen::Vector2d(1.0, -2.0));
  EXPECT_EQ(surfel.normal, Eigen::Vector2d(0.6, 0.8));
  EXPECT_EQ(surfel.hits, 12);
  EXPECT_EQ(surfel.lean_sigma, 0.01);
  EXPECT_EQ(memory.map.range_bias.value_m, result.map.range_bias.value_m);
  EXPECT_EQ(memory.map.range_bias.covariance, result.map.range_bias.covariance);
}

TEST(SavedMap, WhatCannotBeUsedIsASentence) {
  mtr_msgs::SavedMap map;
  expect_sentence([&] { memory_of(map); }, "damaged");
  map.surfels.assign(mtr_msgs::SavedMap::COLUMNS + 1, 1.0);
  expect_sentence([&] { memory_of(map); }, "damaged");
  map.surfels.assign(mtr_msgs::SavedMap::COLUMNS, std::nan(""));
  expect_sentence([&] { memory_of(map); }, "damaged");
  const std::string damaged = ::testing::TempDir() + "damaged.bag";
  write_bag(SavedMap{map, {}}, damaged);
  expect_sentence([&] { read_map(damaged); }, "cannot be used: the saved map is damaged");
  const std::string torn = ::testing::TempDir() + "torn.bag";
  std::ofstream(torn) << "#ROSBAG V2.0\n";
  expect_sentence([&] { read_map(torn); }, "cannot be used");
  EXPECT_FALSE(read_map("/nowhere/map.bag"));
  expect_sentence([&] { write_bag(mtr_msgs::SavedPose(), torn + "/below/pose.bag"); }, "cannot be written");
  const std::string pose = ::testing::TempDir() + "pose.bag";
  write_bag(mtr_msgs::SavedPose(), pose);
  EXPECT_TRUE(read_pose(pose));
  expect_sentence([&] { read_map(pose); }, "it has no /localization/saved_map");
}

}  // namespace
}  // namespace mtr_localization::replay
