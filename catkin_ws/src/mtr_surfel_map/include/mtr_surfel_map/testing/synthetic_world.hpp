/// @file
/// Scenes of straight segments, as a LiDAR sees them. Frame of the Car: origin at its centre, x to its front.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <Eigen/LU>
#include <cmath>
#include <string>
#include <vector>

#include "mtr_surfel_map/se2.hpp"

namespace mtr_surfel_map::synthetic {

struct Segment {
  Eigen::Vector2d from;
  Eigen::Vector2d to;
};

using World = std::vector<Segment>;

inline void add_polygon(World& world, const std::vector<Eigen::Vector2d>& corners, const PoseVector& pose) {
  for (std::size_t i = 0; i < corners.size(); ++i) {
    world.push_back({transformed(pose, corners[i]), transformed(pose, corners[(i + 1) % corners.size()])});
  }
}

inline void add_post(World& world, double x_m, double y_m, double radius_m) {
  std::vector<Eigen::Vector2d> corners;
  for (int i = 0; i < 16; ++i) {
    const double angle = 2.0 * M_PI * i / 16.0;
    corners.emplace_back(radius_m * std::cos(angle), radius_m * std::sin(angle));
  }
  add_polygon(world, corners, {x_m, y_m, 0.0});
}

/// Returns the outline of a car of 4.4 m by 1.8 m at bumper height: curved ends, round corners, sills inboard of the
/// wheels.
inline std::vector<Eigen::Vector2d> car_outline() {
  std::vector<Eigen::Vector2d> right;
  for (int i = 0; i <= 12; ++i) {
    const double y = -0.88 * i / 12.0;
    const double part = std::abs(y) / 0.88;
    right.emplace_back(2.2 - 0.08 * part * part - 0.3 * std::pow(std::max(0.0, (part - 0.6) / 0.4), 2.2), y);
  }
  for (const double wheel : {1.3, -1.3}) {
    for (const auto& [x, y] : std::vector<std::pair<double, double>>{
             {0.36, -0.87}, {0.36, -0.80}, {0.3, -0.80}, {0.3, -0.9}, {-0.3, -0.9}, {-0.3, -0.80}, {-0.36, -0.80}}) {
      right.emplace_back(wheel + x, y);
    }
    right.emplace_back(wheel - 0.36, -0.86);
  }
  for (int i = 12; i >= 0; --i) {
    const double y = -0.88 * i / 12.0;
    const double part = std::abs(y) / 0.88;
    right.emplace_back(-2.2 + 0.05 * part * part + 0.2 * std::pow(std::max(0.0, (part - 0.7) / 0.3), 2.2), y);
  }
  std::vector<Eigen::Vector2d> outline = right;
  for (auto corner = right.rbegin(); corner != right.rend(); ++corner) {
    outline.emplace_back(corner->x(), -corner->y());
  }
  return outline;
}

/// Returns a scene. "open": the Car alone; "cones": the Car and four posts; "beside": the Car, another car and a wall
/// on its right; "lot": the Car, walls, posts and another car.
inline World world_of(const std::string& scene) {
  World world;
  add_polygon(world, car_outline(), {0.0, 0.0, 0.0});
  if (scene == "cones") {
    for (const auto& [x, y] :
         std::vector<std::pair<double, double>>{{13.0, 6.0}, {-6.0, 13.0}, {-13.0, -5.0}, {5.0, -13.5}}) {
      add_post(world, x, y, 0.12);
    }
  }
  if (scene == "beside") {
    add_polygon(world, car_outline(), {0.3, -2.4, 0.03});
    world.push_back({{-6.0, -9.0}, {9.0, -9.0}});
  }
  if (scene == "lot") {
    world.push_back({{-25.0, 20.0}, {5.0, 20.0}});
    world.push_back({{5.0, 20.0}, {5.0, 23.0}});
    world.push_back({{5.0, 23.0}, {22.0, 23.0}});
    for (int i = 0; i < 13; ++i) {
      add_post(world, -18.0, -16.0 + 2.5 * i, 0.05);
    }
    add_polygon(world, car_outline(), {13.5, -6.0, 1.4});
  }
  return world;
}

/// Returns the distance to the nearest segment along a ray, or a negative number if the ray hits none.
inline double cast(const World& world, const Eigen::Vector2d& from, const Eigen::Vector2d& direction) {
  double nearest = -1.0;
  for (const Segment& segment : world) {
    const Eigen::Vector2d edge = segment.to - segment.from;
    const double determinant = direction.x() * edge.y() - direction.y() * edge.x();
    if (determinant == 0.0) {
      continue;
    }
    const Eigen::Vector2d offset = segment.from - from;
    const double range = (offset.x() * edge.y() - offset.y() * edge.x()) / determinant;
    const double part = (offset.x() * direction.y() - offset.y() * direction.x()) / determinant;
    if (range > 0.0 && part >= 0.0 && part <= 1.0 && (nearest < 0.0 || range < nearest)) {
      nearest = range;
    }
  }
  return nearest;
}

/// Returns the distance of a point from the nearest segment.
inline double distance_from(const World& world, const Eigen::Vector2d& point) {
  double nearest = 1e9;
  for (const Segment& segment : world) {
    const Eigen::Vector2d edge = segment.to - segment.from;
    const double part = std::clamp(edge.dot(point - segment.from) / edge.squaredNorm(), 0.0, 1.0);
    nearest = std::min(nearest, (segment.from + part * edge - point).norm());
  }
  return nearest;
}

}  // namespace mtr_surfel_map::synthetic
