/// @file
/// Drawing of the stopping zone.
// SPDX-License-Identifier: Apache-2.0
#include "mtr_drive_control/ros/zone_markers.hpp"

#include <visualization_msgs/MarkerArray.h>

#include "mtr_core/clock.hpp"
#include "mtr_core/names.hpp"

namespace mtr_drive_control {
namespace {

constexpr std::int64_t kPeriodNs = 200 * mtr_core::kMillisecondNs;

std_msgs::ColorRGBA colour_of(Zone zone) {
  std_msgs::ColorRGBA colour;
  colour.a = 0.9F;
  colour.r = zone == Zone::kClear ? 0.1F : 1.0F;
  colour.g = zone == Zone::kClear ? 0.9F : (zone == Zone::kSlowed ? 0.8F : 0.0F);
  colour.b = zone == Zone::kBlind ? 1.0F : 0.1F;
  return colour;
}

geometry_msgs::Point message_of(const Point& point) {
  geometry_msgs::Point message;
  message.x = point.x_m;
  message.y = point.y_m;
  message.z = 0.05;
  return message;
}

}  // namespace

ZoneMarkers::ZoneMarkers(ros::NodeHandle& node)
    : publisher_(node.advertise<visualization_msgs::MarkerArray>(mtr_core::names::kDriveMarkers, 1)) {}

void ZoneMarkers::publish(const mtr_core::Instant& tick, const Decision& decision, const DriveControl& drive_control) {
  if (tick.time_ns - published_ns_ < kPeriodNs || publisher_.getNumSubscribers() == 0) {
    return;
  }
  published_ns_ = tick.time_ns;
  visualization_msgs::Marker marker;
  marker.header.stamp = mtr_core::stamp_of(tick.stamp_ns);
  marker.header.frame_id = mtr_core::names::kBase;
  marker.ns = "stop_zone";
  marker.type = visualization_msgs::Marker::LINE_LIST;
  marker.scale.x = 0.02;
  marker.pose.orientation.w = 1.0;
  marker.color = colour_of(decision.zone);
  const Footprint& footprint = drive_control.footprint();
  const Point corners[] = {{footprint.front_m, footprint.half_width_m},
                           {-footprint.rear_m, footprint.half_width_m},
                           {-footprint.rear_m, -footprint.half_width_m},
                           {footprint.front_m, -footprint.half_width_m}};
  for (const PathPoint& then : drive_control.stopping_path_of(decision.velocity)) {
    for (int corner = 0; corner < 4; ++corner) {
      marker.points.push_back(message_of(then.pose.apply(corners[corner])));
      marker.points.push_back(message_of(then.pose.apply(corners[(corner + 1) % 4])));
    }
  }
  visualization_msgs::MarkerArray markers;
  markers.markers.push_back(marker);
  publisher_.publish(markers);
}

}  // namespace mtr_drive_control
