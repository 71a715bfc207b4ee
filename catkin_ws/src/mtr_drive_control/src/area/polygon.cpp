/// @file
/// Distances between a polygon, points and a rectangle.
// SPDX-License-Identifier: Apache-2.0
#include "mtr_drive_control/area/polygon.hpp"

#include <array>
#include <limits>
#include <utility>

namespace mtr_drive_control {
namespace {

// Distance between points of the outline at which a protrusion is measured.
constexpr double kOutlineStepM = 0.1;

double distance_to_edge_m(const Point& point, const Point& start, const Point& end) {
  const double dx = end.x_m - start.x_m;
  const double dy = end.y_m - start.y_m;
  const double square = dx * dx + dy * dy;
  const double along = (point.x_m - start.x_m) * dx + (point.y_m - start.y_m) * dy;
  const double share = square > 0.0 ? std::clamp(along / square, 0.0, 1.0) : 0.0;
  return distance_m(point, {start.x_m + share * dx, start.y_m + share * dy});
}

std::array<Point, 4> corners_of(const Footprint& footprint) {
  return {{{footprint.front_m, footprint.half_width_m},
           {-footprint.rear_m, footprint.half_width_m},
           {-footprint.rear_m, -footprint.half_width_m},
           {footprint.front_m, -footprint.half_width_m}}};
}

/// Returns true if an edge, in base_link, has a point in the rectangle: its parts within both pairs of sides overlap.
bool crosses(const Footprint& footprint, const Point& start, const Point& end) {
  double first = 0.0;
  double last = 1.0;
  const auto clip = [&](double from, double to, double low, double high) {
    const double way = to - from;
    if (way == 0.0) {
      return low <= from && from <= high;
    }
    const double enter = ((way > 0.0 ? low : high) - from) / way;
    const double leave = ((way > 0.0 ? high : low) - from) / way;
    first = std::max(first, enter);
    last = std::min(last, leave);
    return first <= last;
  };
  return clip(start.x_m, end.x_m, -footprint.rear_m, footprint.front_m) &&
         clip(start.y_m, end.y_m, -footprint.half_width_m, footprint.half_width_m);
}

double distance_to_edge_m(const Footprint& footprint, const Point& start, const Point& end) {
  if (crosses(footprint, start, end)) {
    return 0.0;
  }
  double least_m = std::min(footprint.distance_to(start), footprint.distance_to(end));
  for (const Point& corner : corners_of(footprint)) {
    least_m = std::min(least_m, distance_to_edge_m(corner, start, end));
  }
  return least_m;
}

std::vector<Point> outline_of(const Footprint& footprint) {
  const std::array<Point, 4> corners = corners_of(footprint);
  std::vector<Point> outline;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Point& start = corners[i];
    const Point& end = corners[(i + 1) % corners.size()];
    const int steps = std::max(1, static_cast<int>(std::ceil(distance_m(start, end) / kOutlineStepM)));
    for (int step = 0; step < steps; ++step) {
      const double share = static_cast<double>(step) / steps;
      outline.push_back({start.x_m + share * (end.x_m - start.x_m), start.y_m + share * (end.y_m - start.y_m)});
    }
  }
  return outline;
}

/// Depth of a point of base_link in the rectangle, 0 outside.
double depth_m(const Footprint& footprint, const Point& point) {
  return std::max(0.0, std::min({footprint.front_m - point.x_m, point.x_m + footprint.rear_m,
                                 footprint.half_width_m - std::abs(point.y_m)}));
}

}  // namespace

Polygon::Polygon(std::vector<Point> corners) : corners_(std::move(corners)) {}

bool Polygon::contains(const Point& point) const {
  bool is_inside = false;
  for (std::size_t i = 0, before = corners_.size() - 1; i < corners_.size(); before = i++) {
    const Point& a = corners_[before];
    const Point& b = corners_[i];
    const bool spans = (a.y_m > point.y_m) != (b.y_m > point.y_m);
    if (spans && point.x_m < a.x_m + (point.y_m - a.y_m) / (b.y_m - a.y_m) * (b.x_m - a.x_m)) {
      is_inside = !is_inside;
    }
  }
  return is_inside;
}

double Polygon::distance_to_border_m(const Point& point) const {
  double least_m = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0, before = corners_.size() - 1; i < corners_.size(); before = i++) {
    least_m = std::min(least_m, distance_to_edge_m(point, corners_[before], corners_[i]));
  }
  return least_m;
}

double Polygon::clearance_m(const Footprint& footprint, const Pose& pose) const {
  double least_m = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0, before = corners_.size() - 1; i < corners_.size(); before = i++) {
    least_m = std::min(least_m, distance_to_edge_m(footprint, pose.undo(corners_[before]), pose.undo(corners_[i])));
  }
  return least_m > 0.0 && contains(pose.position()) ? least_m : -protrusion_m(footprint, pose);
}

double Polygon::protrusion_m(const Footprint& footprint, const Pose& pose) const {
  double most_m = 0.0;
  for (const Point& point : outline_of(footprint)) {
    const Point in_frame = pose.apply(point);
    if (!contains(in_frame)) {
      most_m = std::max(most_m, distance_to_border_m(in_frame));
    }
  }
  for (const Point& corner : corners_) {
    most_m = std::max(most_m, depth_m(footprint, pose.undo(corner)));
  }
  return most_m;
}

}  // namespace mtr_drive_control
