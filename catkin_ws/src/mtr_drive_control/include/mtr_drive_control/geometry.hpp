/// @file
/// Points, poses and velocities in the plane, and the robot's outline seen from above.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>

namespace mtr_drive_control {

/// Velocity of base_link: linear along its x axis, angular about z, counterclockwise.
struct Velocity {
  double linear_mps = 0.0;
  double angular_radps = 0.0;

  bool is_finite() const { return std::isfinite(linear_mps) && std::isfinite(angular_radps); }
  bool is_zero() const { return linear_mps == 0.0 && angular_radps == 0.0; }
  Velocity scaled(double factor) const { return {linear_mps * factor, angular_radps * factor}; }
};

struct Point {
  double x_m = 0.0;
  double y_m = 0.0;
};

inline double distance_m(const Point& a, const Point& b) { return std::hypot(a.x_m - b.x_m, a.y_m - b.y_m); }

/// Pose of one frame in another; `apply` reads outer_from_inner.
class Pose {
 public:
  Pose() = default;
  Pose(double x_m, double y_m, double heading_rad)
      : x_m_(x_m), y_m_(y_m), heading_rad_(heading_rad), cos_(std::cos(heading_rad)), sin_(std::sin(heading_rad)) {}

  Point apply(const Point& inner) const {
    return {x_m_ + cos_ * inner.x_m - sin_ * inner.y_m, y_m_ + sin_ * inner.x_m + cos_ * inner.y_m};
  }

  Point undo(const Point& outer) const {
    const double dx = outer.x_m - x_m_;
    const double dy = outer.y_m - y_m_;
    return {cos_ * dx + sin_ * dy, cos_ * dy - sin_ * dx};
  }

  /// Pose of a base that moves with this velocity for this time (negative: backwards in time), on a circle or straight.
  Pose after(const Velocity& velocity, double time_s) const {
    const double turn = velocity.angular_radps * time_s;
    if (turn == 0.0) {
      Pose straight = *this;
      const Point end = apply({velocity.linear_mps * time_s, 0.0});
      straight.x_m_ = end.x_m;
      straight.y_m_ = end.y_m;
      return straight;
    }
    const double chord =
        velocity.linear_mps * time_s * (std::abs(turn) < 1e-6 ? 1.0 : std::sin(turn / 2.0) * 2.0 / turn);
    const Point end = apply({chord * std::cos(turn / 2.0), chord * std::sin(turn / 2.0)});
    return {end.x_m, end.y_m, heading_rad_ + turn};
  }

  Point position() const { return {x_m_, y_m_}; }
  double heading_rad() const { return heading_rad_; }

 private:
  double x_m_ = 0.0;
  double y_m_ = 0.0;
  double heading_rad_ = 0.0;
  double cos_ = 1.0;
  double sin_ = 0.0;
};

/// Rectangle around base_link that contains the whole robot, including the key in front.
struct Footprint {
  double front_m;
  double rear_m;
  double half_width_m;

  /// True inside and at a distance of 0.
  bool contains(const Point& point) const {
    return point.x_m >= -rear_m && point.x_m <= front_m && std::abs(point.y_m) <= half_width_m;
  }

  /// Distance of a point from the rectangle, 0 inside.
  double distance_to(const Point& point) const {
    const double dx = std::max({-rear_m - point.x_m, 0.0, point.x_m - front_m});
    const double dy = std::max(0.0, std::abs(point.y_m) - half_width_m);
    return dx == 0.0 ? dy : (dy == 0.0 ? dx : std::hypot(dx, dy));
  }

  /// Distance of the farthest corner from base_link.
  double radius_m() const { return std::hypot(std::max(front_m, rear_m), half_width_m); }
};

}  // namespace mtr_drive_control
