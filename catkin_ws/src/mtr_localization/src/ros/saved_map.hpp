/// @file
/// Maps and poses in bags, from which another localization goes on.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <mtr_msgs/SavedMap.h>
#include <mtr_msgs/SavedPose.h>
#include <nav_msgs/OccupancyGrid.h>

#include <optional>
#include <stdexcept>
#include <string>

#include "mapping/mapper.hpp"
#include "memory.hpp"
#include "samples.hpp"

namespace mtr_localization {

/// A file that is there and cannot be used.
class FileUnusable : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// A map with the messages in which it was published.
struct SavedMap {
  mtr_msgs::SavedMap map;
  nav_msgs::OccupancyGrid grid;
};

SavedMap saved_map_of(const MapResult& result, const mtr_msgs::SurfaceMap& surfaces,
                      const nav_msgs::OccupancyGrid& grid);
mtr_msgs::SavedPose saved_pose_of(const Estimate& estimate);

/// What localization goes on with; throws FileUnusable when columns are missing or numbers are none.
Memory memory_of(const mtr_msgs::SavedMap& map);
RememberedPose remembered_pose_of(const mtr_msgs::SavedPose& pose);

/// Written whole or not at all: a file of before stays until then. Throws FileUnusable.
void write_bag(const SavedMap& map, const std::string& path);
void write_bag(const mtr_msgs::SavedPose& pose, const std::string& path);
/// None when there is no file; throws FileUnusable for one that is none of these.
std::optional<SavedMap> read_map(const std::string& path);
std::optional<mtr_msgs::SavedPose> read_pose(const std::string& path);

}  // namespace mtr_localization
