/// @file
/// Bags and results of the offline replay.
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <fstream>
#include <sstream>
#include <string>
#include <variant>
#include <vector>

#include "replay/bag_reader.hpp"
#include "replay/options.hpp"
#include "replay/replay.hpp"
#include "replay/result_files.hpp"
#include "sentence.hpp"
#include "synthetic_bag.hpp"

namespace mtr_localization::replay {
namespace {

/// Writes a bag and returns its path; `truth` receives its true poses.
std::string bag_of(const std::string& name, const BagOptions& options, std::vector<PoseVector>* truth = nullptr) {
  std::string path = ::testing::TempDir() + name + ".bag";
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

/// Returns the largest position error of valid poses in the frozen map, m. The map starts at the first true pose.
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
  // The last sweep is due only after the end of the bag.
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

}  // namespace
}  // namespace mtr_localization::replay
