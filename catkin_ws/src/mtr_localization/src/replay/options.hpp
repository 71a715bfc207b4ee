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

/// Where the LiDARs sit on the robot, for bags without /tf_static; defaults from mtr_description.
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
  /// Time of the bag's stamps at which the way round the Car ends; without it by the bag's orders, or when it closes.
  std::optional<std::int64_t> loop_end_ns;
  /// File map.bag of another replay: it is localized on, and none is made; empty: one is made.
  std::string map;
  /// Where base_link is on that map at the first odometry: x, y (m), heading (rad); without it as the map remembers.
  std::optional<std::array<double, 3>> begin_at;
  Parameters parameters;
  Mounting mounting;
};

/// Throws std::runtime_error with one sentence for what cannot be understood.
Options parse(const std::vector<std::string>& arguments);

/// Somebody asks what there is.
bool asks_for_help(const std::vector<std::string>& arguments);
/// Usage, and each parameter with its default and range, a line each.
std::string help();

}  // namespace mtr_localization::replay
