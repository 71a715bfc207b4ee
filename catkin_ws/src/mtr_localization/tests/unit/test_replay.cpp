/// @file
/// Command line, bags and results of the offline replay.
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <string>
#include <variant>

#include "map_names.hpp"
#include "replay/bag_reader.hpp"
#include "replay/loop_detector.hpp"
#include "replay/options.hpp"
#include "replay/replay.hpp"
#include "replay/result_files.hpp"
#include "ros/map_messages.hpp"
#include "ros/saved_map.hpp"
#include "synthetic_bag.hpp"

namespace mtr_localization::replay {
namespace {

template <typename Action>
void expect_sentence(Action action, const std::string& part) {
  try {
    action();
    ADD_FAILURE() << "accepted";
  } catch (const std::runtime_error& error) {
    EXPECT_NE(std::string(error.what()).find(part), std::string::npos) << error.what();
  }
}

/// A bag in the tests' folder; `truth` gets its true poses.
std::string bag_of(const std::string& name, const BagOptions& options, std::vector<PoseVector>* truth = nullptr) {
  const std::string path = ::testing::TempDir() + name + ".bag";
  const std::vector<PoseVector> poses = BagWriter(path, options).write();
  if (truth != nullptr) {
    *truth = poses;
  }
  return path;
}

Result replayed(const std::string& bag, std::vector<std::string> more = {}) {
  more.insert(more.begin(), {bag, "--out", ::testing::TempDir() + "replayed"});
  const Options options = parse(more);
  return Replay(options).run();
}

/// Largest distance of a valid pose in the frozen map from the truth, m. Map begins at the first true pose.
double largest_error_m(const Result& result, const std::vector<PoseVector>& truth) {
  double max_m = 0.0;
  for (const Estimate& pose : result.trajectory) {
    if (pose.mode == PoseMode::kLocalized) {
      const auto step =
          static_cast<std::size_t>(std::llround((static_cast<double>(pose.stamp_ns) * 1e-9 - 1.0) / 0.02));
      const PoseVector expected = relative(truth.front(), truth.at(step));
      max_m = std::max(max_m, std::hypot(pose.x_m - expected.x(), pose.y_m - expected.y()));
    }
  }
  return max_m;
}

TEST(BagReader, ScansWithoutAScanTimeComeAfterTheirLastBeam) {
  BagOptions options;
  options.scan_time_s = 0.0;
  const Options parsed = parse({bag_of("no_scan_time", options), "--out", ::testing::TempDir() + "read"});
  BagReader reader(parsed);
  reader.open();
  std::int64_t newest_ns = 0;
  int sweeps = 0;
  for (Event event = ImuSample{}; reader.next(event);) {
    if (const auto* sweep = std::get_if<Sweep>(&event)) {
      ++sweeps;
      EXPECT_GE(sweep->end_ns(), newest_ns);
      newest_ns = sweep->end_ns();
    } else if (const auto* sample = std::get_if<ImuSample>(&event)) {
      EXPECT_GE(sample->stamp_ns, newest_ns);
      newest_ns = sample->stamp_ns;
    }
  }
  EXPECT_GT(sweeps, 1000);
}

TEST(ReplayOptions, EverythingIsUnderstood) {
  const Options options = parse({"a.bag", "--out", "there", "--front-only", "--parameter", "surface_sigma_m=0.006",
                                 "--parameter", "rear_lidar_x_m=-0.3", "--loop-end", "12.5"});
  EXPECT_EQ(options.bag, "a.bag");
  EXPECT_EQ(options.folder, "there");
  EXPECT_TRUE(options.front_only);
  EXPECT_TRUE(options.parameters.lockstep);
  EXPECT_EQ(options.parameters.adjustment.surface_sigma_m, 0.006);
  EXPECT_EQ(options.mounting.rear_lidar_x_m, -0.3);
  EXPECT_EQ(options.loop_end_ns, 12'500'000'000);
}

TEST(ReplayOptions, WhatIsNotUnderstoodIsASentence) {
  expect_sentence([] { parse({}); }, "Usage");
  expect_sentence([] { parse({"a.bag", "--out"}); }, "--out needs a value");
  expect_sentence([] { parse({"a.bag", "--out", "b", "--fast"}); }, "'--fast' is not understood");
  expect_sentence([] { parse({"a.bag", "--out", "b", "--parameter", "colour=1"}); }, "colour is unknown");
  expect_sentence([] { parse({"a.bag", "--out", "b", "--parameter", "surface_sigma_m=7"}); }, "allowed is");
  expect_sentence([] { parse({"a.bag", "--out", "b", "--parameter", "surface_sigma_m=x"}); }, "no number");
  expect_sentence([] { parse({"a.bag", "--out", "b", "--loop-end", "nan"}); }, "no number");
  expect_sentence([] { parse({"a.bag", "--out", "b", "--loop-end", "9", "--map", "m"}); }, "give one of them");
  expect_sentence([] { parse({"a.bag", "--out", "b", "--begin-at", "1", "2", "3"}); }, "give --map");
  expect_sentence([] { parse({"a.bag", "--out", "b", "--map", "m", "--begin-at", "1", "2"}); }, "needs a value");
}

TEST(ReplayOptions, HelpTellsEachParameterOnceWithItsDefaultAndRange) {
  EXPECT_TRUE(asks_for_help({"a.bag", "--help"}));
  EXPECT_TRUE(asks_for_help({"-h"}));
  EXPECT_FALSE(asks_for_help({"a.bag", "--out", "there"}));
  const std::string text = help();
  EXPECT_NE(text.find("  range_noise_m=0.015  0.001 to 0.1 m\n"), std::string::npos) << text;
  EXPECT_NE(text.find("  rear_lidar_x_m=-0.2  -2 to 2 m\n"), std::string::npos) << text;
  const Options options;
  for_each_group(options.parameters, [&](const auto& rows, const auto&) {
    for (const auto& row : rows) {
      const std::string line = std::string("\n  ") + row.name + "=";
      EXPECT_EQ(text.find(line), text.rfind(line)) << row.name;
      EXPECT_NE(text.find(line), std::string::npos) << row.name;
    }
  });
}

TEST(Replay, PersonWhoWaitsIsToldEachPercentOnce) {
  const Options options = parse({bag_of("progress", {}), "--out", ::testing::TempDir() + "progress"});
  std::vector<int> told;
  Replay(options).run([&](int percent) { told.push_back(percent); });
  EXPECT_EQ(told.back(), 100);
  EXPECT_GT(told.size(), 50U);
  EXPECT_TRUE(std::is_sorted(told.begin(), told.end()));
  EXPECT_EQ(std::adjacent_find(told.begin(), told.end()), told.end());
}

TEST(Replay, BagThatLacksSomethingIsASentence) {
  expect_sentence([] { replayed("/nowhere.bag"); }, "Bag /nowhere.bag cannot be read");
  BagOptions options;
  options.with_scans = false;
  options.with_odometry = false;
  expect_sentence([&] { replayed(bag_of("no_odometry", options)); }, "has no wheel odometry");
  options.with_odometry = true;
  expect_sentence([&] { replayed(bag_of("no_scans", options)); }, "has no scans");
  options.with_imu = false;
  expect_sentence([&] { replayed(bag_of("no_imu", options)); }, "has no IMU data");
}

TEST(Replay, TextThatIsNoBagIsASentence) {
  const std::string path = ::testing::TempDir() + "text.bag";
  std::ofstream(path) << "This is no bag.";
  expect_sentence([&] { replayed(path); }, "cannot be read");
}

TEST(Replay, WayRoundWithoutOrdersGivesMapAndTruePosesEvenWhenScansWereRecordedLate) {
  BagOptions options;
  options.scan_delay_s = 0.1;
  std::vector<PoseVector> truth;
  const Result result = replayed(bag_of("late", options, &truth));
  ASSERT_TRUE(result.map.map.valid) << result.map.map.message.text;
  EXPECT_EQ(result.map.revision, 1U);
  EXPECT_EQ(result.trajectory.size(), truth.size() - 1);
  // The last sweep is due only after the bag's end.
  EXPECT_GE(result.sweeps_used + result.sweeps_refused, result.sweeps - 1);
  EXPECT_EQ(result.trajectory.back().mode, PoseMode::kLocalized);
  EXPECT_LT(largest_error_m(result, truth), 0.03);
}

TEST(Replay, LoopEndThatIsGivenEndsTheLoop) {
  const Result result = replayed(bag_of("given", {}), {"--loop-end", "20"});
  EXPECT_FALSE(result.map.map.valid);
  EXPECT_NE(result.map.map.message.text.find("not closed"), std::string::npos) << result.map.map.message.text;
}

TEST(Replay, ResultsAreWrittenAndTheSameEachTime) {
  const std::string bag = bag_of("twice", {});
  const std::string folder = ::testing::TempDir() + "written";
  std::string first;
  for (int i = 0; i < 2; ++i) {
    write_files(replayed(bag), bag, folder);
    std::ifstream file(folder + "/trajectory.csv");
    const std::string text((std::istreambuf_iterator<char>(file)), std::istreambuf_iterator<char>());
    EXPECT_EQ(text.rfind("stamp_s,x_m,y_m,heading_rad,cxx,", 0), 0U);
    EXPECT_TRUE(i == 0 || text == first);
    first = text;
  }
  for (const char* name : {"surfaces.csv", "key_frames.csv", "map.pgm", "map.yaml", "map.bag", "summary.json"}) {
    EXPECT_TRUE(std::ifstream(folder + "/" + name).good()) << name;
  }
}

TEST(Replay, ValidPosesAreWrittenForToolsThatReadTum) {
  const std::string bag = bag_of("tum", {});
  const Result result = replayed(bag);
  write_files(result, bag, ::testing::TempDir() + "tum");
  std::ifstream file(::testing::TempDir() + "tum/trajectory.tum");
  std::string line;
  std::getline(file, line);
  EXPECT_EQ(line, "# timestamp tx ty tz qx qy qz qw");
  for (const Estimate& pose : result.trajectory) {
    if (!pose.valid) {
      continue;
    }
    std::getline(file, line);
    std::istringstream row(line);
    std::array<double, 8> value{};
    for (double& each : value) {
      row >> each;
    }
    ASSERT_TRUE(row) << line;
    EXPECT_NEAR(value[0], static_cast<double>(pose.stamp_ns) * 1e-9, 1e-6);
    EXPECT_NEAR(value[1], pose.x_m, 1e-6);
    EXPECT_NEAR(wrapped(2.0 * std::atan2(value[6], value[7]) - pose.heading_rad), 0.0, 1e-5);
  }
  EXPECT_FALSE(std::getline(file, line));
}

TEST(Replay, BagThatBeginsInMotionIsTrackedFromItsFirstPose) {
  const std::string bag = bag_of("in_motion", {});
  EXPECT_FALSE(replayed(bag).trajectory.front().valid);
  EXPECT_TRUE(replayed(bag, {"--in-motion"}).trajectory.front().valid);
}

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

TEST(Replay, AnotherDriveIsLocalizedOnTheMapOfAReplay) {
  std::vector<PoseVector> truth;
  const std::string bag = bag_of("on_map", {}, &truth);
  const std::string folder = ::testing::TempDir() + "on_map";
  write_files(replayed(bag), bag, folder);
  const Result result = replayed(bag, {"--map", folder + "/map.bag"});
  EXPECT_FALSE(result.is_map_new);
  EXPECT_EQ(result.trajectory.front().map_revision, 1U);
  EXPECT_FALSE(result.trajectory.front().valid);
  EXPECT_TRUE(result.trajectory.back().valid) << result.trajectory.back().message.text;
  EXPECT_LT(largest_error_m(result, truth), 0.03);
  expect_sentence([&] { replayed(bag, {"--map", "/nowhere/map.bag"}); }, "File /nowhere/map.bag is not there");
}

TEST(Replay, PlaceOnTheMapThatIsToldIsTakenUpWhenTheLidarsAgree) {
  std::vector<PoseVector> truth;
  const std::string bag = bag_of("begin_at", {}, &truth);
  const std::string folder = ::testing::TempDir() + "begin_at";
  const Result mapped = replayed(bag);
  write_files(mapped, bag, folder);
  const auto valid = [&](const std::vector<std::string>& place) {
    std::vector<std::string> options{"--map", folder + "/map.bag", "--in-motion", "--begin-at"};
    options.insert(options.end(), place.begin(), place.end());
    const Result result = replayed(bag, options);
    EXPECT_LT(largest_error_m(result, truth), 0.05);
    const auto is_valid = [](const Estimate& pose) { return pose.valid; };
    return std::count_if(result.trajectory.begin(), result.trajectory.end(), is_valid);
  };
  const auto right = valid({"0.03", "-0.03", "0.01"});
  EXPECT_GT(right, 9 * static_cast<std::ptrdiff_t>(mapped.trajectory.size()) / 10);
  EXPECT_LT(valid({"2.0", "2.0", "1.0"}), right);
}

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
    // 15 degrees before its end the way is 0.8 m from its beginning.
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
