/// @file
/// Messages of the frozen map.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <mtr_msgs/SurfaceMap.h>
#include <nav_msgs/OccupancyGrid.h>
#include <visualization_msgs/MarkerArray.h>

#include "pose_source.hpp"
#include "samples.hpp"

namespace mtr_localization {

mtr_msgs::SurfaceMap message_of(const MapResult& result);
nav_msgs::OccupancyGrid grid_message_of(const MapResult& result);

/// Returns markers for rviz: surfaces, key frames, and the 3-sigma ellipse of the robot.
visualization_msgs::MarkerArray markers_of(const PoseSource& source, const Estimate& estimate);

}  // namespace mtr_localization
