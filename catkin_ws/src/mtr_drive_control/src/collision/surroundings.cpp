/// @file
/// Converts sweeps and odometry to obstacles in base_link.
// SPDX-License-Identifier: Apache-2.0
#include "mtr_drive_control/collision/surroundings.hpp"

#include <algorithm>
#include <cmath>

#include "mtr_core/plausible.hpp"
#include "mtr_core/steady_time.hpp"
#include "problems.hpp"

namespace mtr_drive_control {
namespace {

// Larger than any stop and any person's path during it.
constexpr double kRangeOfInterestM = 4.0;
// A person out of view for longer may be anywhere; then only the memory of the ground counts.
constexpr double kLostPersonS = 3.0;
// A surface that vanishes ahead of this angle is hidden by a nearer one, e.g. a wheel of the Car, and is seen again
// before it is behind the robot.
constexpr double kBehindRad = 1.75;

constexpr double kPi = 3.14159265358979323846;
// A sector with this share of the view counts as the whole view.
constexpr double kWholeShare = 0.95;
// Longest range of the supported LiDARs.
constexpr double kMemoryReachM = 30.0;
// Time for which a vanished thing may be a walking person; without a reappearance it is stationary, or has gone.
constexpr double kMayHaveWalkedS = 0.3;
// A stopped process missed all motion meanwhile; a late tick has a shorter gap.
constexpr double kLookedAwayS = 0.5;
// A carried robot loses its position within this time after its LiDARs contradict the memory.
constexpr std::int64_t kCoveredNs = 1'000'000'000;
// Rules for odometry as in localization: after a longer silence, or a larger step than possible, it has restarted.
constexpr double kOdometryGapS = 0.2;
constexpr double kJumpM = 0.05;
constexpr double kJumpRad = 0.1;
// With two LiDARs, the view that each needs to both sides of its direction; farther back the other one sees as well.
constexpr double kSharedViewRad = 2.0;

/// Whole degrees, for sentences.
std::int64_t degrees(double angle_rad) { return std::lround(angle_rad * 180.0 / kPi); }

double age_s(std::int64_t now_ns, std::int64_t stamp_ns) { return static_cast<double>(now_ns - stamp_ns) * 1e-9; }

}  // namespace

Surroundings::Surroundings(const CollisionParameters& parameters, const RobotShape& shape)
    : parameters_(parameters), footprint_(shape.footprint), watches_rear_(shape.rear_lidar.has_value()) {
  const double own_view_rad = shape.rear_lidar ? kSharedViewRad : kPi;
  const auto add = [&](const char* name, const LidarMount& mount) {
    lidars_.push_back({LidarWatch(name, parameters.lidar_timeout_s), EchoFinder(mount, footprint_, own_view_rad)});
  };
  add("front LiDAR", shape.front_lidar);
  if (shape.rear_lidar) {
    add("rear LiDAR", *shape.rear_lidar);
  }
}

void Surroundings::take(std::int64_t tick_ns, const Sensors& sensors) {
  if (tick_ns < tick_ns_) {
    // With a clock step backwards, old ground would count as seen and new echoes as old.
    forget_ground();
    followed_.reset();
  }
  if (may_have_been_carried(tick_ns, sensors)) {
    forget_echoes();
  }
  tick_ns_ = tick_ns;
  has_motion_ = sensors.motion.has_value();
  had_position_ = sensors.map.has_value();
  has_map_ = sensors.map && sensors.map->map && !sensors.map->map->occupied.empty();
  const bool is_known =
      has_motion_ && mtr_core::is_fresh(sensors.motion->stamp_ns, tick_ns, parameters_.odometry_timeout_s);
  motion_ = is_known ? sensors.motion : std::nullopt;
  if (motion_) {
    follow(*motion_);
    if (!steady_.follow(*motion_, sensors.gyro_radps)) {
      newcomers_ = Newcomers();
    }
  }
  bool has_observed = false;
  for (std::size_t i = 0; i < lidars_.size(); ++i) {
    has_observed = observe(i, sensors) || has_observed;
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

bool Surroundings::may_have_been_carried(std::int64_t tick_ns, const Sensors& sensors) const {
  const bool looked_away = tick_ns < tick_ns_ || age_s(tick_ns, tick_ns_) > kLookedAwayS;
  // A covered LiDAR also causes a lost position, but it was detected before.
  const bool is_lost =
      had_position_ && !sensors.map && std::all_of(lidars_.begin(), lidars_.end(), [&](const Lidar& each) {
        return each.sees_surface && !each.empty.has_lasted_since(tick_ns - kCoveredNs);
      });
  return looked_away || is_lost;
}

void Surroundings::forget_echoes() {
  memory_ = EchoMemory();
  for (Lidar& lidar : lidars_) {
    lidar.empty = EmptySector();
    lidar.has_seen = lidar.has_seen_surface = false;
  }
}

void Surroundings::follow(const Motion& motion) {
  if (followed_ && motion.stamp_ns != followed_->stamp_ns) {
    const double since_s = age_s(motion.stamp_ns, followed_->stamp_ns);
    const double moved_m = distance_m(motion.odom_from_base.position(), followed_->odom_from_base.position());
    const double turned_rad = std::abs(
        std::remainder(motion.odom_from_base.heading_rad() - followed_->odom_from_base.heading_rad(), 2.0 * kPi));
    const bool jumps = moved_m > mtr_core::kMaxWheelsMps * since_s + kJumpM ||
                       turned_rad > mtr_core::kMaxTurnRadps * since_s + kJumpRad;
    if (since_s < 0.0 || since_s > kOdometryGapS || jumps) {
      forget_ground();
    }
    if (jumps) {
      memory_.move(followed_->odom_from_base, motion.odom_from_base);
    }
  }
  followed_ = motion;
}

bool Surroundings::was_free(const Point& point, double max_age_s) const {
  return ground_.was_free(odom_from_base_.apply(point), tick_ns_, max_age_s);
}

bool Surroundings::is_watched(const Point& point) const {
  return std::any_of(lidars_.begin(), lidars_.end(), [&](const Lidar& lidar) { return lidar.finder.sees(point); });
}

bool Surroundings::observe(std::size_t index, const Sensors& sensors) {
  Lidar& lidar = lidars_[index];
  const std::shared_ptr<const Sweep>& sweep = index == 0 ? sensors.front : sensors.rear;
  // A stale sweep, or one from the future, would be remembered with a wrong time.
  if (!lidar.watch.take(sweep)) {
    return false;
  }
  lidar.finder.read(*sweep);
  lidar.covered = lidar.finder.covered_sector(*sweep);
  if (lidar.watch.problem_at(tick_ns_) || !motion_) {
    return false;
  }
  const View view = lidar.finder.view_of(*sweep, *motion_);
  lidar.echoes = lidar.finder.find(*sweep, view, kMemoryReachM);
  for (Echo& echo : lidar.echoes) {
    // A part of the Car that is about to leave the view is still recognized.
    echo.is_wide = echo.is_wide || ground_.was_wide(echo.point);
  }
  look_for_gaps(index, view, sensors);
  remember_newcomers(lidar, *sweep, sensors);
  const auto far = std::remove_if(lidar.echoes.begin(), lidar.echoes.end(),
                                  [](const Echo& echo) { return echo.range_m >= kRangeOfInterestM; });
  lidar.echoes.erase(far, lidar.echoes.end());
  ground_.observe(*sweep, lidar.finder.directions(), view);
  ground_.remember(lidar.echoes, *motion_);
  return true;
}

void Surroundings::remember_newcomers(const Lidar& lidar, const Sweep& sweep, const Sensors& sensors) {
  newcomers_.observe(sweep, lidar.finder.directions(), steady_.motion());
  const SiteMap* map = sensors.map ? sensors.map->map.get() : nullptr;
  for (const Echo& echo : lidar.echoes) {
    if (echo.range_m > kNewcomerReachM) {
      continue;
    }
    const std::optional<Point> in_map =
        sensors.map ? std::optional<Point>(sensors.map->map_from_odom.apply(echo.point)) : std::nullopt;
    newcomers_.remember(steady_.from_odom(echo.point), sweep.stamp_ns, map, in_map);
  }
}

bool Surroundings::is_possible_person(const Point& in_odom) const {
  const Point place = steady_.from_odom(in_odom);
  return newcomers_.may_be_person(place);
}

void Surroundings::look_for_gaps(std::size_t index, const View& view, const Sensors& sensors) {
  Lidar& lidar = lidars_[index];
  const std::vector<Echo>& echoes = lidar.echoes;
  lidar.has_seen = lidar.has_seen || !echoes.empty();
  lidar.sees_surface = std::any_of(echoes.begin(), echoes.end(), [](const Echo& echo) { return echo.is_wide; });
  lidar.has_seen_surface = lidar.has_seen_surface || lidar.sees_surface;
  const Witness witness{index, lidar.finder.own_view_rad()};
  EmptyBeams empty = memory_.observe(view, witness, echoes);
  if (sensors.map) {
    lidar.map.observe(view, witness, echoes, *sensors.map, empty);
  }
  lidar.empty.update(empty, view);
}

void Surroundings::classify() {
  for (Lidar& lidar : lidars_) {
    lidar.kinds.clear();
    lidar.possible_persons.clear();
    for (const Echo& echo : lidar.echoes) {
      const bool may_walk = is_possible_person(echo.point);
      const bool is_static = !may_walk && (echo.is_wide || ground_.was_wide(echo.point));
      lidar.possible_persons.push_back(may_walk);
      lidar.kinds.push_back(is_static ? Kind::kWide : ground_.has_stood(echo.point) ? Kind::kStanding : Kind::kThing);
    }
  }
}

mtr_core::Problem Surroundings::blindness_at(std::int64_t tick_ns) const {
  for (const Lidar& lidar : lidars_) {
    if (mtr_core::Problem problem = lidar.watch.problem_at(tick_ns)) {
      return problem;
    }
    if (mtr_core::Problem problem = blindness_of(lidar)) {
      return problem;
    }
  }
  if (motion_) {
    return {};
  }
  return has_motion_ ? problems::kOdometrySilent() : problems::kWaitingForOdometry();
}

mtr_core::Problem Surroundings::blindness_of(const Lidar& lidar) const {
  const std::string& name = lidar.watch.name();
  if (lidar.covered) {
    const double covered_rad = lidar.covered->to_rad - lidar.covered->from_rad;
    const bool is_whole = covered_rad > kWholeShare * 2.0 * std::min(kSharedViewRad, lidar.finder.own_view_rad());
    return is_whole ? problems::kLidarCovered({{"lidar", name}})
                    : problems::kLidarSectorCovered({{"lidar", name},
                                                     {"from_deg", degrees(lidar.covered->from_rad)},
                                                     {"to_deg", degrees(lidar.covered->to_rad)}});
  }
  const std::optional<Sector> empty = lidar.empty.confirmed();
  return empty ? problems::kLidarSeesNothing(
                     {{"lidar", name}, {"from_deg", degrees(empty->from_rad)}, {"to_deg", degrees(empty->to_rad)}})
               : mtr_core::Problem{};
}

mtr_core::Problem Surroundings::distrust(const Velocity& desired) const {
  const bool is_backwards = desired.linear_mps < 0.0;
  if (desired.linear_mps == 0.0 || (is_backwards && !watches_rear_)) {
    return {};
  }
  const Lidar& lidar = is_backwards ? lidars_.back() : lidars_.front();
  if (lidar.has_seen) {
    return {};
  }
  const auto other =
      std::find_if(lidars_.begin(), lidars_.end(), [](const Lidar& each) { return each.has_seen_surface; });
  const std::string shown_by = other != lidars_.end() ? other->watch.name() : has_map_ ? "map" : "";
  return shown_by.empty() ? mtr_core::Problem{}
                          : problems::kLidarNeverSaw({{"lidar", lidar.watch.name()}, {"other", shown_by}});
}

void Surroundings::add_obstacle(const Point& point, std::int64_t seen_ns, Kind kind, bool is_possible_person) {
  // An echo from the future counts as current.
  obstacles_.push_back(
      {point, std::max(0.0, age_s(tick_ns_, seen_ns)), kind, footprint_.distance_to(point), is_possible_person});
}

void Surroundings::find_obstacles() {
  obstacles_.reserve(lidars_.front().echoes.size() + lidars_.back().echoes.size());
  for (const Lidar& lidar : lidars_) {
    for (std::size_t i = 0; i < lidar.echoes.size(); ++i) {
      const Echo& echo = lidar.echoes[i];
      add_obstacle(odom_from_base_.undo(echo.point), echo.stamp_ns, lidar.kinds[i], lidar.possible_persons[i]);
    }
  }
  for (const MissingEcho& missing : memory_.missing()) {
    const Point point = odom_from_base_.undo(missing.point);
    const bool is_static = missing.is_wide && !is_possible_person(missing.point);
    const bool may_walk = !is_static && age_s(tick_ns_, missing.seen_ns) < kMayHaveWalkedS;
    if (distance_m(point, Point{}) < kRangeOfInterestM) {
      add_obstacle(point, may_walk ? missing.seen_ns : tick_ns_,
                   is_static  ? Kind::kWide
                   : may_walk ? Kind::kThing
                              : Kind::kStanding,
                   false);
    }
  }
  if (!watches_rear_) {
    for (const LostThing& thing : ground_.lost_things(tick_ns_, kLostPersonS)) {
      const Point point = odom_from_base_.undo(thing.point);
      const bool may_walk = thing.was_moving || newcomers_.has_come(steady_.from_odom(thing.point));
      if (may_walk && std::abs(std::atan2(point.y_m, point.x_m)) > kBehindRad) {
        add_obstacle(point, thing.seen_ns, Kind::kLost, true);
      }
    }
  }
}

}  // namespace mtr_drive_control
