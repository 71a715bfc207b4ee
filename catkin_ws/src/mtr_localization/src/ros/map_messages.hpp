/// @file
/// The frozen map as messages.
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

/// What a person sees in rviz: surfaces, key frames, and the ellipse of 3 sigma round the robot.
visualization_msgs::MarkerArray markers_of(const PoseSource& source, const Estimate& estimate);

}  // namespace mtr_localization
