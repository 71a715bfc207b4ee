/// @file
/// Occupancy grid, map files and removal of surfaces that were seen through.
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <fstream>
#include <sstream>
#include <stdexcept>
#include <string>

#include "extraction/free_space.hpp"
#include "mtr_surfel_map/map_files.hpp"
#include "mtr_surfel_map/occupancy_grid.hpp"

namespace mtr_surfel_map {
namespace {

/// Returns a fan of beams that end at a wall with y = range_m; the robot is at x_m and faces along y.
KeyFrame fan(double x_m, double range_m) {
  KeyFrame frame;
  frame.pose = {x_m, 0.0, M_PI_2};
  for (int beam = -20; beam <= 20; ++beam) {
    const double angle = 0.01 * beam;
    const Eigen::Vector2d direction(std::cos(angle), std::sin(angle));
    const double range = range_m / direction.x();
    frame.scan.points.push_back({range * direction, direction, range});
  }
  return frame;
}

AdjustedMap wall_at(double y_m) {
  AdjustedMap map;
  for (int i = 0; i < 5; ++i) {
    map.key_frames.push_back(fan(0.1 * i, y_m));
    map.pose_covariances.push_back(1e-4 * Eigen::Matrix3d::Identity());
  }
  map.surfels.push_back({{0.2, y_m}, {0.0, -1.0}, 0.4, 0.002, 100});
  return map;
}

std::string content_of(const std::string& path) {
  std::ifstream file(path);
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

TEST(OccupancyGrid, WallIsOccupiedWhatLiesBeforeItFreeAndBehindItUnknown) {
  const OccupancyGrid grid = occupancy_of(wall_at(3.02));
  EXPECT_EQ(grid.at({0.2, 3.02}), OccupancyGrid::kOccupied);
  EXPECT_EQ(grid.at({0.2, 1.5}), OccupancyGrid::kFree);
  EXPECT_EQ(grid.at({0.2, 3.3}), OccupancyGrid::kUnknown);
  EXPECT_EQ(grid.at({1e9, -1e9}), OccupancyGrid::kUnknown);
}

TEST(OccupancyGrid, RangeBiasIsTakenOff) {
  AdjustedMap map = wall_at(3.02);
  map.range_bias.value_m[0] = 0.2;
  EXPECT_EQ(occupancy_of(map).at({0.2, 2.82}), OccupancyGrid::kOccupied);
}

TEST(OccupancyGrid, PersonWhoWasSeenThroughIsFree) {
  AdjustedMap map = wall_at(3.02);
  map.key_frames.push_back(fan(0.2, 1.5));
  EXPECT_EQ(occupancy_of(map).at({0.2, 1.5}), OccupancyGrid::kFree);
}

TEST(OccupancyGrid, NoKeyFramesGiveAnEmptyGrid) { EXPECT_TRUE(occupancy_of(AdjustedMap()).cells.empty()); }

TEST(FreeSpace, SurfelThatBeamsPassedIsDropped) {
  const AdjustedMap map = wall_at(3.0);
  std::vector<Surfel> surfels = map.surfels;
  surfels.push_back({{0.2, 1.5}, {0.0, -1.0}, 0.3, 0.002, 30});
  const std::vector<Surfel> kept = without_seen_through(surfels, map.key_frames);
  ASSERT_EQ(kept.size(), 1U);
  EXPECT_EQ(kept.front().position, map.surfels.front().position);
}

TEST(FreeSpace, SurfelNearBeforeAnotherIsKept) {
  const AdjustedMap map = wall_at(3.0);
  const std::vector<Surfel> surfels = {{{0.2, 2.85}, {0.0, -1.0}, 0.3, 0.002, 30}};
  EXPECT_EQ(without_seen_through(surfels, map.key_frames).size(), 1U);
}

TEST(MapFiles, TablesHaveOneLinePerEntry) {
  const AdjustedMap map = wall_at(3.0);
  const std::string folder = ::testing::TempDir();
  write_surfaces(map, folder + "surfaces.csv");
  EXPECT_EQ(content_of(folder + "surfaces.csv"),
            "x_m,y_m,normal_rad,length_m,sigma_m,hits\n0.200000,3.000000,-1.570796,0.400000,0.002000,100\n");
  write_key_frames(map, folder + "key_frames.csv");
  const std::string frames = content_of(folder + "key_frames.csv");
  EXPECT_EQ(std::count(frames.begin(), frames.end(), '\n'), 6);
  EXPECT_NE(frames.find("\n0.000000,0.400000,0.000000,1.570796,1.000000e-04,"), std::string::npos) << frames;
}

TEST(MapFiles, ImageHasTheGridsSizeAndItsUpperRowFirst) {
  const OccupancyGrid grid = occupancy_of(wall_at(3.02));
  const std::string folder = ::testing::TempDir();
  write_grid(grid, folder);
  const std::string image = content_of(folder + "/map.pgm");
  std::ostringstream header;
  header << "P5\n" << grid.size.x() << ' ' << grid.size.y() << "\n255\n";
  ASSERT_EQ(image.substr(0, header.str().size()), header.str());
  ASSERT_EQ(image.size(), header.str().size() + grid.cells.size());
  const int column = static_cast<int>((0.2 - grid.origin.x()) / grid.cell_m);
  const int row = grid.size.y() - 1 - static_cast<int>((3.02 - grid.origin.y()) / grid.cell_m);
  EXPECT_EQ(image[header.str().size() + static_cast<std::size_t>(row * grid.size.x() + column)], '\0');
  EXPECT_NE(content_of(folder + "/map.yaml").find("resolution: 0.05"), std::string::npos);
}

TEST(MapFiles, FolderThatDoesNotExistIsASentence) {
  try {
    write_surfaces(AdjustedMap(), "/nowhere/surfaces.csv");
    ADD_FAILURE() << "written";
  } catch (const std::runtime_error& error) {
    EXPECT_STREQ(error.what(), "File /nowhere/surfaces.csv cannot be written.");
  }
}

}  // namespace
}  // namespace mtr_surfel_map
