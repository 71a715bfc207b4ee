/// @file
/// Sweeps and odometry to obstacles in base_link.
// SPDX-License-Identifier: Apache-2.0
#include "mtr_drive_control/collision/surroundings.hpp"

#include "mtr_core/steady_time.hpp"
#include "problems.hpp"

namespace mtr_drive_control {
namespace {

// Farther than any stop and any person's way during it.
constexpr double kRangeOfInterestM = 4.0;
// A person out of view for longer may be anywhere; then only the memory of the ground counts.
constexpr double kLostPersonS = 3.0;
// What vanishes ahead of this is hidden by something nearer, e.g. a wheel of the Car, and is seen again before it gets
// behind the robot.
constexpr double kBehindRad = 1.75;

constexpr double kPi = 3.14159265358979323846;
// Of two LiDARs each has to see so far to both sides of where it points; farther back the other one sees as well.
constexpr double kSharedViewRad = 2.0;

double age_s(std::int64_t now_ns, std::int64_t stamp_ns) { return static_cast<double>(now_ns - stamp_ns) * 1e-9; }

}  // namespace

Surroundings::Surroundings(const CollisionParameters& parameters, const RobotShape& shape)
    : parameters_(parameters), footprint_(shape.footprint), watches_rear_(shape.rear_lidar.has_value()) {
  const double timeout_s = parameters.lidar_timeout_s;
  const double own_view_rad = shape.rear_lidar ? kSharedViewRad : kPi;
  lidars_.push_back(
      {LidarWatch("front LiDAR", timeout_s), EchoFinder(shape.front_lidar, footprint_, own_view_rad), false, {}, {}});
  if (shape.rear_lidar) {
    lidars_.push_back(
        {LidarWatch("rear LiDAR", timeout_s), EchoFinder(*shape.rear_lidar, footprint_, own_view_rad), false, {}, {}});
  }
}

void Surroundings::take(std::int64_t tick_ns, const Sensors& sensors) {
  if (tick_ns < tick_ns_) {
    // A clock that goes back would let old ground count as seen and new echoes as old.
    ground_ = GroundMemory();
  }
  tick_ns_ = tick_ns;
  has_motion_ = sensors.motion.has_value();
  const bool is_known =
      has_motion_ && mtr_core::is_fresh(sensors.motion->stamp_ns, tick_ns, parameters_.odometry_timeout_s);
  motion_ = is_known ? sensors.motion : std::nullopt;
  bool has_observed = observe(lidars_.front(), sensors.front);
  if (watches_rear_) {
    has_observed = observe(lidars_.back(), sensors.rear) || has_observed;
  }
  if (has_observed) {
    classify();
  }
  blindness_ = blindness_at(tick_ns);
  obstacles_.clear();
  if (motion_) {
    odom_from_base_ = motion_->at(tick_ns);
    ground_.stand(footprint_, *motion_);
    find_obstacles();
  }
}

bool Surroundings::was_free(const Point& point) const {
  return ground_.was_free(odom_from_base_.apply(point), tick_ns_, parameters_.ground_memory_s);
}

bool Surroundings::observe(Lidar& lidar, const std::shared_ptr<const Sweep>& sweep) {
  // What is stale or from the future would be remembered as of a wrong time.
  if (!lidar.watch.take(sweep)) {
    return false;
  }
  lidar.is_covered = lidar.finder.is_covered(*sweep);
  if (lidar.watch.problem_at(tick_ns_) || !motion_) {
    return false;
  }
  lidar.echoes = lidar.finder.find(*sweep, *motion_, kRangeOfInterestM);
  ground_.observe(*sweep, lidar.finder.mount(), *motion_);
  ground_.remember(lidar.echoes, *motion_);
  return true;
}

void Surroundings::classify() {
  for (Lidar& lidar : lidars_) {
    lidar.kinds.clear();
    for (const Echo& echo : lidar.echoes) {
      lidar.kinds.push_back(echo.is_wide || ground_.was_wide(echo.point) ? Kind::kWide
                            : ground_.has_stood(echo.point)              ? Kind::kStanding
                                                                         : Kind::kThing);
    }
  }
}

mtr_core::Problem Surroundings::blindness_at(std::int64_t tick_ns) const {
  for (const Lidar& lidar : lidars_) {
    if (mtr_core::Problem problem = lidar.watch.problem_at(tick_ns)) {
      return problem;
    }
    if (lidar.is_covered) {
      return problems::kLidarCovered({{"lidar", lidar.watch.name()}});
    }
  }
  if (motion_) {
    return {};
  }
  return has_motion_ ? problems::kOdometrySilent() : problems::kWaitingForOdometry();
}

void Surroundings::add_obstacle(const Point& point, std::int64_t seen_ns, Kind kind) {
  obstacles_.push_back({point, age_s(tick_ns_, seen_ns), kind, footprint_.distance_to(point)});
}

void Surroundings::find_obstacles() {
  for (const Lidar& lidar : lidars_) {
    for (std::size_t i = 0; i < lidar.echoes.size(); ++i) {
      const Echo& echo = lidar.echoes[i];
      add_obstacle(odom_from_base_.undo(echo.point), echo.stamp_ns, lidar.kinds[i]);
    }
  }
  if (!watches_rear_) {
    for (const LostThing& thing : ground_.lost_things(tick_ns_, kLostPersonS)) {
      const Point point = odom_from_base_.undo(thing.point);
      if (thing.was_moving && std::abs(std::atan2(point.y_m, point.x_m)) > kBehindRad) {
        add_obstacle(point, thing.seen_ns, Kind::kLost);
      }
    }
  }
}

}  // namespace mtr_drive_control
