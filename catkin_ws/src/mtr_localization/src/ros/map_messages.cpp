/// @file
/// Conversion of the map to messages, and markers of the localization state.
// SPDX-License-Identifier: Apache-2.0
#include "ros/map_messages.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "mtr_core/clock.hpp"
#include "mtr_core/names.hpp"
#include "scans/sweep.hpp"

namespace mtr_localization {
namespace {

using visualization_msgs::Marker;

constexpr double kEllipseSigmas = 3.0;
// Height of the scan plane above base_link, so that surfaces are drawn at the height of the scans.
constexpr double kShownAtM = 0.2;

mtr_msgs::KeyFrame message_of(const KeyFrame& frame, const Eigen::Matrix3d& covariance) {
  mtr_msgs::KeyFrame message;
  message.stamp = mtr_core::stamp_of(frame.stamp_ns);
  message.x = frame.pose.x();
  message.y = frame.pose.y();
  message.heading = frame.pose.z();
  Eigen::Map<Eigen::Matrix3d>(message.covariance.data()) = covariance;
  return message;
}

geometry_msgs::Point point_of(const Eigen::Vector2d& position) {
  geometry_msgs::Point point;
  point.x = position.x();
  point.y = position.y();
  point.z = kShownAtM;
  return point;
}

Marker marker(const Estimate& estimate, const char* what, int type) {
  Marker marker;
  marker.header.frame_id = mtr_core::names::kMap;
  marker.header.stamp = mtr_core::stamp_of(estimate.stamp_ns);
  marker.ns = what;
  marker.type = type;
  marker.pose.orientation.w = 1.0;
  marker.color.a = 1.0F;
  return marker;
}

Marker surfaces_marker(const PoseSource& source, const Estimate& estimate) {
  Marker lines = marker(estimate, "surfaces", Marker::LINE_LIST);
  lines.scale.x = 0.02;
  lines.color.g = 0.8F;
  lines.color.b = estimate.map_revision == 0 ? 0.8F : 0.0F;
  for (const Surfel& surfel : source.surfels()) {
    const Eigen::Vector2d half = 0.5 * surfel.length_m * Eigen::Vector2d(-surfel.normal.y(), surfel.normal.x());
    lines.points.push_back(point_of(surfel.position - half));
    lines.points.push_back(point_of(surfel.position + half));
  }
  return lines;
}

Marker key_frames_marker(const PoseSource& source, const Estimate& estimate) {
  Marker places = marker(estimate, "key_frames", Marker::SPHERE_LIST);
  places.scale.x = places.scale.y = places.scale.z = 0.08;
  places.color.r = 1.0F;
  places.color.g = 0.6F;
  for (const KeyFrame& frame : source.key_frames()) {
    places.points.push_back(point_of(frame.pose.head<2>()));
  }
  return places;
}

Marker ellipse_marker(const Estimate& estimate) {
  Marker ellipse = marker(estimate, "position", Marker::CYLINDER);
  const Eigen::Matrix3d covariance = Eigen::Map<const Eigen::Matrix3d>(estimate.covariance.data());
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> axes(covariance.topLeftCorner<2, 2>());
  const double turn = std::atan2(axes.eigenvectors()(1, 0), axes.eigenvectors()(0, 0));
  ellipse.pose.position = point_of({estimate.x_m, estimate.y_m});
  ellipse.pose.orientation.z = std::sin(0.5 * turn);
  ellipse.pose.orientation.w = std::cos(0.5 * turn);
  ellipse.scale.x = 2.0 * kEllipseSigmas * std::sqrt(std::max(axes.eigenvalues()[0], 1e-8));
  ellipse.scale.y = 2.0 * kEllipseSigmas * std::sqrt(std::max(axes.eigenvalues()[1], 1e-8));
  ellipse.scale.z = 0.01;
  ellipse.color.r = estimate.valid ? 0.2F : 1.0F;
  ellipse.color.b = estimate.valid ? 1.0F : 0.2F;
  ellipse.color.a = 0.6F;
  return ellipse;
}

}  // namespace

mtr_msgs::SurfaceMap message_of(const MapResult& result) {
  mtr_msgs::SurfaceMap message;
  message.header.stamp = mtr_core::stamp_of(result.stamp_ns);
  message.header.frame_id = mtr_core::names::kMap;
  message.map_car_id = result.map_car_id;
  message.revision = result.revision;
  message.valid = result.map.valid;
  for (const Surfel& surfel : result.map.surfels) {
    message.x.push_back(static_cast<float>(surfel.position.x()));
    message.y.push_back(static_cast<float>(surfel.position.y()));
    message.normal.push_back(static_cast<float>(std::atan2(surfel.normal.y(), surfel.normal.x())));
    message.length.push_back(static_cast<float>(surfel.length_m));
    message.sigma.push_back(static_cast<float>(surfel.sigma_m));
    message.hits.push_back(static_cast<std::uint16_t>(std::clamp(surfel.hits, 0, 65535)));
  }
  for (std::size_t i = 0; i < std::min(result.map.key_frames.size(), result.map.pose_covariances.size()); ++i) {
    message.key_frames.push_back(message_of(result.map.key_frames[i], result.map.pose_covariances[i]));
  }
  message.range_bias_m = result.map.range_bias.value_m[static_cast<int>(Lidar::kFront)];
  message.rear_range_bias_m = result.map.range_bias.value_m[static_cast<int>(Lidar::kRear)];
  message.message = result.map.message.text;
  message.problems = mtr_core::messages_of<mtr_msgs::Problem>(result.map.message);
  return message;
}

nav_msgs::OccupancyGrid grid_message_of(const MapResult& result) {
  nav_msgs::OccupancyGrid message;
  message.header.stamp = mtr_core::stamp_of(result.stamp_ns);
  message.header.frame_id = mtr_core::names::kMap;
  message.info.map_load_time = message.header.stamp;
  message.info.resolution = static_cast<float>(result.grid.cell_m);
  message.info.width = static_cast<std::uint32_t>(result.grid.size.x());
  message.info.height = static_cast<std::uint32_t>(result.grid.size.y());
  message.info.origin.position.x = result.grid.origin.x();
  message.info.origin.position.y = result.grid.origin.y();
  message.info.origin.orientation.w = 1.0;
  message.data = result.grid.cells;
  return message;
}

visualization_msgs::MarkerArray markers_of(const PoseSource& source, const Estimate& estimate) {
  visualization_msgs::MarkerArray markers;
  markers.markers = {surfaces_marker(source, estimate), key_frames_marker(source, estimate), ellipse_marker(estimate)};
  return markers;
}

}  // namespace mtr_localization
