/// @file
/// Writes the map to files for other programs.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "mtr_surfel_map/occupancy_grid.hpp"
#include "mtr_surfel_map/types.hpp"

namespace mtr_surfel_map {

/// Each function throws std::runtime_error with one sentence if the file cannot be written. Lengths in m, angles in
/// rad.

/// Writes one surfel per line: x_m, y_m, normal_rad, length_m, sigma_m, hits.
void write_surfaces(const AdjustedMap& map, const std::string& path);

/// Writes one key frame per line: stamp_s, x_m, y_m, heading_rad, nine covariance entries row by row, returns,
/// standing.
void write_key_frames(const AdjustedMap& map, const std::string& path);

/// Writes image and metadata in the format of map_server: folder/map.pgm and folder/map.yaml.
void write_grid(const OccupancyGrid& grid, const std::string& folder);

}  // namespace mtr_surfel_map
