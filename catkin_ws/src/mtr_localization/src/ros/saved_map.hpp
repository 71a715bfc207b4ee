/// @file
/// Maps and poses in bags, for a later localization.
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

/// Error of an existing but unusable file.
class FileUnusable : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// A map with its published messages.
struct SavedMap {
  mtr_msgs::SavedMap map;
  nav_msgs::OccupancyGrid grid;
};

SavedMap saved_map_of(const MapResult& result, const mtr_msgs::SurfaceMap& surfaces,
                      const nav_msgs::OccupancyGrid& grid);
mtr_msgs::SavedPose saved_pose_of(const Estimate& estimate);

/// Converts a map for a restart; throws FileUnusable if columns are missing or numbers are not finite.
Memory memory_of(const mtr_msgs::SavedMap& map);
RememberedPose remembered_pose_of(const mtr_msgs::SavedPose& pose);

/// Writes the bag atomically: the previous file remains until then. Throws FileUnusable.
void write_bag(const SavedMap& map, const std::string& path);
void write_bag(const mtr_msgs::SavedPose& pose, const std::string& path);
/// Returns nothing if the file does not exist; throws FileUnusable if its content is not valid.
std::optional<SavedMap> read_map(const std::string& path);
std::optional<mtr_msgs::SavedPose> read_pose(const std::string& path);

}  // namespace mtr_localization
