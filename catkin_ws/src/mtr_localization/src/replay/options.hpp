/// @file
/// Command line of the offline replay.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "parameters.hpp"

namespace mtr_localization::replay {

/// Mounts of the LiDARs for bags without /tf_static; defaults from mtr_description.
struct Mounting {
  double front_lidar_x_m = 0.12;
  double front_lidar_y_m = 0.0;
  double front_lidar_heading_rad = 0.0;
  double rear_lidar_x_m = -0.2;
  double rear_lidar_y_m = 0.0;
  double rear_lidar_heading_rad = 3.141592653589793;
};

inline constexpr std::array<mtr_core::ParameterRow<Mounting>, 6> kMountingRows{{
    {"front_lidar_x_m", &Mounting::front_lidar_x_m, -2.0, 2.0, "m"},
    {"front_lidar_y_m", &Mounting::front_lidar_y_m, -2.0, 2.0, "m"},
    {"front_lidar_heading_rad", &Mounting::front_lidar_heading_rad, -3.2, 3.2, "rad"},
    {"rear_lidar_x_m", &Mounting::rear_lidar_x_m, -2.0, 2.0, "m"},
    {"rear_lidar_y_m", &Mounting::rear_lidar_y_m, -2.0, 2.0, "m"},
    {"rear_lidar_heading_rad", &Mounting::rear_lidar_heading_rad, -3.2, 3.2, "rad"},
}};

struct Options {
  std::string bag;
  std::string folder;
  bool front_only = false;
  /// Stamp at which the drive round the Car ends; without it, the orders of the bag or loop closure define the end.
  std::optional<std::int64_t> loop_end_ns;
  /// File map.bag of another replay, used for localization; if empty, a new map is made.
  std::string map;
  /// Pose of base_link on that map at the first odometry: x, y (m), heading (rad); by default the stored pose.
  std::optional<std::array<double, 3>> begin_at;
  Parameters parameters;
  Mounting mounting;
};

/// Throws std::runtime_error with one sentence for invalid arguments.
Options parse(const std::vector<std::string>& arguments);

/// Returns true if help is requested.
bool asks_for_help(const std::vector<std::string>& arguments);
/// Returns the usage, and one line per parameter with its default and range.
std::string help();

}  // namespace mtr_localization::replay
