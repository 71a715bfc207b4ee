/// @file
/// The map as files for other programs.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "mtr_surfel_map/occupancy_grid.hpp"
#include "mtr_surfel_map/types.hpp"

namespace mtr_surfel_map {

/// Each throws std::runtime_error with one sentence when the file cannot be written. Lengths in m, angles in rad.

/// One surfel a line: x_m, y_m, normal_rad, length_m, sigma_m, hits.
void write_surfaces(const AdjustedMap& map, const std::string& path);

/// One key frame a line: stamp_s, x_m, y_m, heading_rad, nine numbers of the covariance row by row, returns, standing.
void write_key_frames(const AdjustedMap& map, const std::string& path);

/// Image and description as map_server reads and writes them: folder/map.pgm and folder/map.yaml.
void write_grid(const OccupancyGrid& grid, const std::string& folder);

}  // namespace mtr_surfel_map
