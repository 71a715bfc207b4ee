/// @file
/// Publication of estimates and maps.
// SPDX-License-Identifier: Apache-2.0
#include "ros/outputs.hpp"

#include <diagnostic_msgs/DiagnosticArray.h>

#include <utility>

#include "mtr_core/clock.hpp"
#include "mtr_core/names.hpp"
#include "ros/conversions.hpp"
#include "ros/diagnostics.hpp"
#include "ros/map_messages.hpp"
#include "ros/stamps.hpp"

namespace mtr_localization {

namespace names = mtr_core::names;

Outputs::Outputs(ros::NodeHandle& node, bool publish_odom_tf, MemoryFiles& memory)
    : publish_odom_tf_(publish_odom_tf),
      memory_(memory),
      poses_(node.advertise<mtr_msgs::LocalizedPose>(names::kLocalizedPose, 50)),
      surfaces_(node.advertise<mtr_msgs::SurfaceMap>(names::kSurfaceMap, 1, true)),
      grids_(node.advertise<nav_msgs::OccupancyGrid>(names::kMapGrid, 1, true)),
      markers_(node.advertise<visualization_msgs::MarkerArray>(names::kLocalizationMarkers, 1)),
      diagnostics_(node.advertise<diagnostic_msgs::DiagnosticArray>("/diagnostics", 10)) {}

void Outputs::publish(PoseSource& source, const std::vector<Estimate>& estimates, const WorkLoad& load) {
  if (auto result = source.take_map()) {
    result->stamp_ns = stamp_of(result->stamp_ns);
    for (KeyFrame& frame : result->map.key_frames) {
      frame.stamp_ns = stamp_of(frame.stamp_ns);
    }
    publish_map(*result, source.owns_map_frame());
  }
  for (const Estimate& estimate : estimates) {
    poses_.publish(message_of(estimate));
    publish_transforms(estimate, source.owns_map_frame());
    publish_each_second(source, estimate, load);
    log(source, estimate);
    memory_.note(estimate);
  }
}

void Outputs::publish_map_of_before(const SavedMap& saved) {
  surfaces_.publish(saved.map.surfaces);
  grids_.publish(saved.grid);
}

void Outputs::publish_map(const MapResult& result, bool with_grid) {
  const mtr_msgs::SurfaceMap surfaces = message_of(result);
  surfaces_.publish(surfaces);
  if (!result.map.valid) {
    ROS_WARN("The key-frames gave no map. %s", result.map.message.text.c_str());
    return;
  }
  if (with_grid) {
    const nav_msgs::OccupancyGrid grid = grid_message_of(result);
    grids_.publish(grid);
    memory_.keep_map(saved_map_of(result, surfaces, grid));
  }
  ROS_INFO("Map %u: %zu surfaces of %zu key-frames, range biases %.1f and %.1f mm (front, rear).", result.revision,
           result.map.surfels.size(), result.map.key_frames.size(), 1e3 * result.map.range_bias.value_m[0],
           1e3 * result.map.range_bias.value_m[1]);
}

const std::array<double, 3>& Outputs::odom_of(const Estimate& estimate) const {
  return publish_odom_tf_ ? estimate.odom : estimate.wheel_odom;
}

void Outputs::publish_map_from_odom(std::int64_t stamp_ns, const Estimate& corrected) {
  // Sweeps of two LiDARs may end at the same time, or at the time of a pose.
  if (map_stamps_.note(stamp_ns)) {
    transforms_.sendTransform(map_from_odom_message(stamp_ns, corrected, odom_of(corrected)));
  }
}

void Outputs::publish_transforms(const Estimate& estimate, bool with_map) {
  const std::array<double, 3>& odom = odom_of(estimate);
  std::vector<geometry_msgs::TransformStamped> messages;
  if (with_map && map_stamps_.note(estimate.stamp_ns)) {
    messages.push_back(map_from_odom_message(estimate.stamp_ns, estimate, odom));
  }
  if (publish_odom_tf_) {
    messages.push_back(transform_message(estimate.stamp_ns, {names::kOdom, names::kBase, odom[0], odom[1], odom[2]}));
  }
  transforms_.sendTransform(messages);
}

void Outputs::publish_each_second(const PoseSource& source, const Estimate& estimate, const WorkLoad& load) {
  const std::int64_t second = estimate.stamp_ns / mtr_core::kSecondNs;
  if (second == published_second_) {
    return;
  }
  published_second_ = second;
  diagnostics_.publish(diagnostics_of(source.figures(), estimate, load));
  if (markers_.getNumSubscribers() > 0) {
    markers_.publish(markers_of(source, estimate));
  }
}

void Outputs::log(const PoseSource& source, const Estimate& estimate) {
  std::string kind = estimate.message.kind();
  if (kind == logged_kind_) {
    return;
  }
  logged_kind_ = std::move(kind);
  const std::string& message = estimate.message.text;
  if (message.empty()) {
    ROS_INFO("Tracking; gyro bias %.5f rad/s.", source.figures().gyro_bias_radps);
  } else if (source.motion_state() == MotionState::kStarting) {
    ROS_INFO("%s", message.c_str());
  } else {
    ROS_WARN("%s", message.c_str());
  }
}

}  // namespace mtr_localization
