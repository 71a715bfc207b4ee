/// @file
/// Zone that must be free, and the limits if it is not.
// SPDX-License-Identifier: Apache-2.0
#include "mtr_drive_control/collision/collision_stop.hpp"

#include "problems.hpp"

namespace mtr_drive_control {
namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr int kHalvings = 8;
// A smaller share of the desired velocity counts as a stop, because so slow a motion is useless.
constexpr double kLeastShare = 0.05;
// Tolerance for rounding; a larger one would let the robot creep closer tick by tick.
constexpr double kRoundingM = 1e-9;
constexpr double kEdgeStepM = 0.05;
// Time for which a temporarily hidden possible person still counts as near.
constexpr double kStillNearS = 1.0;

/// Points on the outline of the robot.
std::vector<Point> edge_of(const Footprint& footprint) {
  std::vector<Point> edge;
  for (double y = -footprint.half_width_m; y <= footprint.half_width_m; y += kEdgeStepM) {
    edge.push_back({-footprint.rear_m, y});
    edge.push_back({footprint.front_m, y});
  }
  for (double x = -footprint.rear_m; x <= footprint.front_m; x += kEdgeStepM) {
    edge.push_back({x, -footprint.half_width_m});
    edge.push_back({x, footprint.half_width_m});
  }
  edge.push_back({-footprint.rear_m, footprint.half_width_m});
  return edge;
}

/// Upper bound of the speed of each point of the outline.
double outline_mps(const Velocity& velocity, double radius_m) {
  return std::abs(velocity.linear_mps) + std::abs(velocity.angular_radps) * radius_m;
}

}  // namespace

CollisionStop::CollisionStop(const CollisionParameters& parameters, const RobotShape& shape)
    : parameters_(parameters),
      footprint_(shape.footprint),
      edge_(edge_of(shape.footprint)),
      surroundings_(parameters, shape) {
  check(parameters);
}

Assessment CollisionStop::assess(std::int64_t tick_ns, const DesiredMotion& desired, const Deceleration& normal) {
  const mtr_core::Problem blind = blindness() ? blindness() : surroundings_.distrust(desired.velocity);
  if (blind || desired.velocity.is_zero()) {
    surroundings_.rest(rested_ns_);
  }
  if (blind) {
    if (!desired.velocity.is_zero()) {
      blocked_motion_ = desired;
      last_blocked_ns_ = tick_ns;
    }
    return {{}, Zone::kBlind, std::nullopt, blind};
  }
  // A planner that stops for the obstacle must not make the path free by that.
  const DesiredMotion sighted =
      within_sight(desired.velocity.is_zero() && blocked_motion_ ? *blocked_motion_ : desired);
  const double slow_share =
      std::min(1.0, slow_zone_mps(tick_ns, normal.linear_mps2) / outline_mps(sighted.velocity, footprint_.radius_m()));
  const DesiredMotion tried{sighted.velocity.scaled(slow_share), sighted.by_hand};
  const std::optional<Hindrance> hindrance = hindrance_of(tried, normal);
  const double share = hindrance ? safe_share(tried, normal) : 1.0;
  if (share < kLeastShare) {
    return blocked(tick_ns, tried, hindrance);
  }
  if (is_pausing(tick_ns)) {
    return {{}, Zone::kBlocked, hindrance, hindrance ? problem_of(*hindrance) : problems::kPausing()};
  }
  blocked_motion_.reset();
  if (desired.velocity.is_zero()) {
    return {};
  }
  const Obstacle* person = slow_share < 1.0 ? nearest_possible_person() : nullptr;
  const std::optional<Hindrance> slowed_by = hindrance || !person ? hindrance : hindrance_at(person->point);
  const bool is_slowed = hindrance || slow_share < 1.0;
  return {tried.velocity.scaled(share), is_slowed ? Zone::kSlowed : Zone::kClear, slowed_by, {}};
}

const Obstacle* CollisionStop::nearest_possible_person() const {
  const Obstacle* nearest = nullptr;
  for (const Obstacle& obstacle : surroundings_.obstacles()) {
    const bool is_nearer = nearest == nullptr || obstacle.distance_m < nearest->distance_m;
    nearest = obstacle.is_possible_person && is_nearer ? &obstacle : nearest;
  }
  return nearest;
}

double CollisionStop::slow_zone_mps(std::int64_t tick_ns, double deceleration_mps2) {
  const Obstacle* person = parameters_.contact_skirt ? nullptr : nearest_possible_person();
  const double slow_mps = parameters_.near_person_mps;
  const double beyond_m = person != nullptr ? person->distance_m - parameters_.near_person_m : kInfinity;
  if (beyond_m <= 0.0) {
    person_near_ns_ = tick_ns;
  }
  if (person_near_ns_ && static_cast<double>(tick_ns - *person_near_ns_) * 1e-9 <= kStillNearS) {
    return slow_mps;
  }
  // Speed from which the normal stop reaches the slow zone at its speed, including the reaction.
  const double reacted_mps = deceleration_mps2 * (parameters_.reaction_s + late_s_);
  const double squared = slow_mps * slow_mps + 2.0 * deceleration_mps2 * std::max(0.0, beyond_m);
  return std::max(slow_mps, std::sqrt(squared + reacted_mps * reacted_mps) - reacted_mps);
}

Assessment CollisionStop::blocked(std::int64_t tick_ns, const DesiredMotion& desired,
                                  const std::optional<Hindrance>& hindrance) {
  blocked_motion_ = desired;
  last_blocked_ns_ = tick_ns;
  return {{}, Zone::kBlocked, hindrance, problem_of(*hindrance)};
}

bool CollisionStop::is_pausing(std::int64_t tick_ns) const {
  return blocked_motion_ && static_cast<double>(tick_ns - last_blocked_ns_) * 1e-9 < parameters_.resume_pause_s;
}

DesiredMotion CollisionStop::within_sight(const DesiredMotion& desired) const {
  const double speed_mps = -desired.velocity.linear_mps;
  if (surroundings_.watches_rear() || speed_mps <= parameters_.unwatched_reverse_mps) {
    return desired;
  }
  return {desired.velocity.scaled(parameters_.unwatched_reverse_mps / speed_mps), desired.by_hand};
}

double CollisionStop::safe_share(const DesiredMotion& desired, const Deceleration& normal) const {
  double safe = 0.0;
  double unsafe = 1.0;
  for (int i = 0; i < kHalvings; ++i) {
    const double share = 0.5 * (safe + unsafe);
    (permits({desired.velocity.scaled(share), desired.by_hand}, normal) ? safe : unsafe) = share;
  }
  return safe;
}

std::optional<Hindrance> CollisionStop::hindrance_of(const DesiredMotion& desired,
                                                     const Deceleration& deceleration) const {
  if (desired.velocity.is_zero()) {
    return std::nullopt;
  }
  const std::vector<PathPoint> path = stopping_path_of(desired.velocity, deceleration);
  const Obstacle* nearest = nullptr;
  for (const Obstacle& obstacle : surroundings_.obstacles()) {
    const bool is_nearer = nearest == nullptr || obstacle.distance_m < nearest->distance_m;
    if (is_nearer && may_be_reached(obstacle, path) && is_in_reach(obstacle, desired, path)) {
      nearest = &obstacle;
    }
  }
  if (nearest != nullptr) {
    return hindrance_at(nearest->point);
  }
  const bool is_seen = surroundings_.watches_rear() || is_backed_by_person(desired);
  return is_seen ? std::nullopt : unseen_ground(desired, path);
}

bool CollisionStop::is_backed_by_person(const DesiredMotion& desired) const {
  // A person sees the path behind the robot. A turn with little reverse motion is still a turn.
  const double turned_mps = std::abs(desired.velocity.angular_radps) * footprint_.radius_m();
  return desired.by_hand && -desired.velocity.linear_mps > turned_mps;
}

bool CollisionStop::may_be_reached(const Obstacle& obstacle, const std::vector<PathPoint>& path) const {
  const double moved_m = kPathStepM * static_cast<double>(path.size() - 1);
  const double walked_m = parameters_.person_speed_mps * (obstacle.age_s + path.back().time_s);
  const double kept_m = std::max(parameters_.gap_m, parameters_.person_reach_m + walked_m);
  return obstacle.distance_m - moved_m <= kept_m;
}

bool CollisionStop::is_in_reach(const Obstacle& obstacle, const DesiredMotion& desired,
                                const std::vector<PathPoint>& path) const {
  switch (obstacle.kind) {
    case Kind::kWide:
      return gets_nearer_than(parameters_.gap_m, obstacle.point, path);
    case Kind::kThing:
      return is_approached_by_person(obstacle, path);
    case Kind::kLost:
      return desired.velocity.linear_mps < 0.0 && !desired.by_hand && is_approached_by_person(obstacle, path);
    case Kind::kStanding: {
      const bool creeps = outline_mps(desired.velocity, footprint_.radius_m()) <= parameters_.creep_mps + 1e-9;
      return is_approached_by_person(obstacle, path) &&
             !(creeps && !gets_nearer_than(parameters_.person_reach_m, obstacle.point, path));
    }
  }
  return true;
}

bool CollisionStop::gets_nearer_than(double limit_m, const Point& point, const std::vector<PathPoint>& path) const {
  // The robot may leave an obstacle that is already closer, but not approach it.
  const double allowed_m = std::min(limit_m, footprint_.distance_to(point) - kRoundingM);
  for (const PathPoint& then : path) {
    if (footprint_.distance_to(then.pose.undo(point)) < allowed_m) {
      return true;
    }
  }
  return false;
}

bool CollisionStop::is_approached_by_person(const Obstacle& obstacle, const std::vector<PathPoint>& path) const {
  for (const PathPoint& then : path) {
    const double walked_m = parameters_.person_speed_mps * (obstacle.age_s + then.time_s);
    if (footprint_.distance_to(then.pose.undo(obstacle.point)) < parameters_.person_reach_m + walked_m) {
      return true;
    }
  }
  return false;
}

std::optional<Hindrance> CollisionStop::unseen_ground(const DesiredMotion& desired,
                                                      const std::vector<PathPoint>& path) const {
  // A person at the controller watches ground that was free longer ago, but not ground that was never seen.
  const double max_age_s = desired.by_hand ? std::numeric_limits<double>::infinity() : parameters_.ground_memory_s;
  for (const PathPoint& then : path) {
    for (const Point& edge : edge_) {
      const Point point = then.pose.apply(edge);
      if (footprint_.distance_to(point) > kRoundingM && !surroundings_.is_watched(point) &&
          !surroundings_.was_free(point, max_age_s)) {
        Hindrance nothing_seen;
        nothing_seen.is_unseen_ground = true;
        return nothing_seen;
      }
    }
  }
  return std::nullopt;
}

Hindrance CollisionStop::hindrance_at(const Point& point) const {
  return {footprint_.distance_to(point), std::atan2(point.y_m, point.x_m), false};
}

mtr_core::Problem problem_of(const Hindrance& hindrance) {
  if (hindrance.is_unseen_ground) {
    return problems::kUnseenGround();
  }
  const double bearing = std::abs(hindrance.bearing_rad);
  const char* side = bearing < kPi / 4.0           ? "ahead"
                     : bearing > 3.0 * kPi / 4.0   ? "behind"
                     : hindrance.bearing_rad > 0.0 ? "on the left"
                                                   : "on the right";
  return problems::kObstacle({{"distance_m", hindrance.distance_m}, {"side", side}});
}

}  // namespace mtr_drive_control
