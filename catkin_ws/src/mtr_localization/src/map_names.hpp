/// @file
/// Shared types of localization and map: planar poses, scan points, surfels and key frames.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "mtr_surfel_map/growing_map.hpp"
#include "mtr_surfel_map/occupancy_grid.hpp"
#include "mtr_surfel_map/se2.hpp"
#include "mtr_surfel_map/surfel_map.hpp"
#include "mtr_surfel_map/types.hpp"

namespace mtr_localization {

using mtr_surfel_map::AdjustedMap;
using mtr_surfel_map::GrowingMap;
using mtr_surfel_map::KeyFrame;
using mtr_surfel_map::OccupancyGrid;
using mtr_surfel_map::PoseVector;
using mtr_surfel_map::RangeBias;
using mtr_surfel_map::ScanPoint;
using mtr_surfel_map::ScanPoints;
using mtr_surfel_map::Surfel;
using mtr_surfel_map::SurfelMap;
using mtr_surfel_map::SurfelMatch;

using mtr_surfel_map::kLidars;

using mtr_surfel_map::compose;
using mtr_surfel_map::occupancy_of;
using mtr_surfel_map::relative;
using mtr_surfel_map::rotation;
using mtr_surfel_map::transformed;
using mtr_surfel_map::wrapped;

}  // namespace mtr_localization
