/// @file
/// Flat world for tests: discs and walls seen by the robot's LiDARs, and a robot that follows commands exactly.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <functional>
#include <limits>
#include <memory>
#include <vector>

#include "mtr_drive_control/drive_control.hpp"

namespace mtr_drive_control {

constexpr std::int64_t kTestMs = 1'000'000;
constexpr std::int64_t kTestPeriodNs = 20 * kTestMs;
constexpr std::int64_t kTestSweepNs = 40 * kTestMs;
constexpr double kTestPi = 3.14159265358979323846;

/// A robot like the one of mtr_description.
inline RobotShape test_shape(bool has_rear_lidar) {
  const LidarMount rear{-0.20, 0.0, kTestPi};
  return {{0.27, 0.254, 0.215}, {0.12, 0.0, 0.0}, has_rear_lidar ? std::optional<LidarMount>(rear) : std::nullopt};
}

/// Upright cylinder in world.
struct Disc {
  Point centre;
  double radius_m;
};

/// Thin wall in world.
struct Wall {
  Point start;
  Point end;
};

class Scene {
 public:
  std::vector<Disc> discs;
  std::vector<Wall> walls;
  /// Single echoes in front of other objects: range by beam.
  std::vector<std::pair<std::size_t, double>> raindrops;
  std::size_t beams = 720;
  double noise_m = 0.005;
  double range_min_m = 0.1;
  double range_max_m = 30.0;

  /// Returns the sweep of a LiDAR at this pose in world.
  std::shared_ptr<Sweep> sweep(const Pose& world_from_lidar, std::int64_t stamp_ns) const {
    auto seen = std::make_shared<Sweep>(Sweep{stamp_ns,
                                              -0.75 * kTestPi,
                                              1.5 * kTestPi / static_cast<double>(beams - 1),
                                              0.0,
                                              range_min_m,
                                              range_max_m,
                                              {},
                                              "",
                                              ""});
    const std::int64_t stamp_ms = stamp_ns / kTestMs;
    for (std::size_t beam = 0; beam < beams; ++beam) {
      const Point start = world_from_lidar.position();
      const double angle = seen->angle_of(beam);
      const Point ahead = world_from_lidar.apply({std::cos(angle), std::sin(angle)});
      const double range = nearest(start, {ahead.x_m - start.x_m, ahead.y_m - start.y_m});
      // Each sweep is different, as a live LiDAR's.
      const double noise = noise_m * std::sin(static_cast<double>(beam * 7919 + stamp_ms * 104729));
      const bool is_near = range + noise < range_min_m;
      const double measured_m = range > range_max_m ? std::numeric_limits<double>::infinity() : range + noise;
      seen->ranges_m.push_back(is_near ? -std::numeric_limits<float>::infinity() : static_cast<float>(measured_m));
    }
    for (const auto& [beam, range] : raindrops) {
      seen->ranges_m[beam] = static_cast<float>(range);
    }
    return seen;
  }

  /// Returns the distance of the footprint at this pose from the nearest object.
  double clearance(const Footprint& footprint, const Pose& world_from_base) const {
    double least = std::numeric_limits<double>::infinity();
    for (const Disc& disc : discs) {
      least = std::min(least, footprint.distance_to(world_from_base.undo(disc.centre)) - disc.radius_m);
    }
    for (const Wall& wall : walls) {
      for (int i = 0; i <= 200; ++i) {
        const double share = i / 200.0;
        const Point point{wall.start.x_m + share * (wall.end.x_m - wall.start.x_m),
                          wall.start.y_m + share * (wall.end.y_m - wall.start.y_m)};
        least = std::min(least, footprint.distance_to(world_from_base.undo(point)));
      }
    }
    return least;
  }

 private:
  double nearest(const Point& start, const Point& way) const {
    double range = std::numeric_limits<double>::infinity();
    for (const Disc& disc : discs) {
      const double dx = disc.centre.x_m - start.x_m;
      const double dy = disc.centre.y_m - start.y_m;
      const double along = dx * way.x_m + dy * way.y_m;
      const double aside = dx * way.y_m - dy * way.x_m;
      if (along > 0.0 && std::abs(aside) < disc.radius_m) {
        range = std::min(range, along - std::sqrt(disc.radius_m * disc.radius_m - aside * aside));
      }
    }
    for (const Wall& wall : walls) {
      const Point side{wall.end.x_m - wall.start.x_m, wall.end.y_m - wall.start.y_m};
      const double cross = way.x_m * side.y_m - way.y_m * side.x_m;
      const double dx = wall.start.x_m - start.x_m;
      const double dy = wall.start.y_m - start.y_m;
      const double along = (dx * side.y_m - dy * side.x_m) / cross;
      const double share = (dx * way.y_m - dy * way.x_m) / cross;
      if (along > 0.0 && share >= 0.0 && share <= 1.0) {
        range = std::min(range, along);
      }
    }
    return range;
  }
};

/// Drive control in a scene, with a planner that requests one velocity.
class TestRobot {
 public:
  explicit TestRobot(bool has_rear_lidar = true, const Parameters& parameters = Parameters{})
      : control(parameters, CollisionParameters{}, test_shape(has_rear_lidar), 0.02), has_rear_lidar_(has_rear_lidar) {}

  /// Runs one tick with this desired velocity.
  Decision step(const Velocity& desired, bool by_hand = false) {
    const double period_s = static_cast<double>(period_ns) * 1e-9;
    world_from_base = world_from_base.after({wheels.linear_mps, grip * wheels.angular_radps}, period_s);
    odom_from_base = odom_from_base.after(wheels, period_s);
    now_ns += period_ns;
    if (now_ns / kTestSweepNs != (now_ns - period_ns) / kTestSweepNs && !lidars_are_silent) {
      observe();
    }
    Inputs inputs;
    const SourceCommand command{now_ns - kTestPeriodNs, desired, true};
    inputs.locks = locks;
    (by_hand ? inputs.manual : inputs.planner) = command;
    inputs.sensors = {front_, rear_,
                      Motion{odometry_is_silent ? now_ns - 1000 * kTestMs : now_ns, odom_from_base, wheels}, map};
    inputs.key = KeyHeight{now_ns, key_height_m};
    inputs.imu = imu((wheels.linear_mps - wheels_before_.linear_mps) / period_s);
    wheels_before_ = wheels;
    inputs.area = area ? area() : AreaInputs{};
    inputs.speed_limit = speed_limit;
    Decision decision = control.step(now_ns, inputs);
    velocity = decision.velocity;
    wheels = obeys ? velocity : Velocity{};
    return decision;
  }

  /// Runs one observation of the surroundings before the first motion.
  void settle() { drive({}, 0.1); }

  /// Runs ticks with the same desired velocity; returns the last decision.
  Decision drive(const Velocity& desired, double duration_s, bool by_hand = false) {
    Decision decision;
    for (int tick = 0; tick < std::lround(duration_s * 1e9 / static_cast<double>(period_ns)); ++tick) {
      decision = step(desired, by_hand);
    }
    return decision;
  }

  double clearance() const { return scene.clearance(control.footprint(), world_from_base); }

  Scene scene;
  DriveControl control;
  Pose world_from_base;
  /// Pose from wheel odometry, which is wrong in turns with slip.
  Pose odom_from_base;
  double grip = 1.0;
  std::optional<LocalizedMap> map;
  /// Last command, and the resulting motion of the wheels.
  Velocity velocity;
  Velocity wheels;
  bool obeys = true;
  bool odometry_is_silent = false;
  bool lidars_are_silent = false;
  std::int64_t now_ns = 5'000'000'000;
  /// Period of the ticks; drive control expects kTestPeriodNs.
  std::int64_t period_ns = kTestPeriodNs;
  std::vector<EngagedLock> locks;
  /// The test area, and the pose in it.
  std::function<AreaInputs()> area;
  std::optional<SpeedLimit> speed_limit;
  double key_height_m = 0.35;
  /// Pitch of the ground, downhill ahead; it changes without a rotation on the gyro.
  double pitch_rad = 0.0;
  /// Modifies the IMU reading.
  std::function<void(ImuReading&)> spoil_imu;
  /// Modifies the sweep of a LiDAR, front or rear.
  std::function<void(Sweep&, bool is_rear)> spoil;

 private:
  /// Returns the reading of a live IMU, which never repeats.
  ImuReading imu(double acceleration_mps2) const {
    const std::int64_t now_ms = now_ns / kTestMs;
    const double noise = 1e-3 * std::sin(static_cast<double>(now_ms));
    ImuReading reading{now_ns,
                       {noise, -noise, grip * wheels.angular_radps + noise},
                       {acceleration_mps2 - 9.81 * std::sin(pitch_rad) + noise,
                        wheels.linear_mps * grip * wheels.angular_radps, 9.81 * std::cos(pitch_rad)}};
    if (spoil_imu) {
      spoil_imu(reading);
    }
    return reading;
  }

  // Publishes the sweep that has just ended, as seen at its end.
  void observe() {
    const RobotShape shape = test_shape(true);
    front_ = seen_by(shape.front_lidar, false);
    rear_ = has_rear_lidar_ ? seen_by(*shape.rear_lidar, true) : nullptr;
  }

  std::shared_ptr<const Sweep> seen_by(const LidarMount& mount, bool is_rear) const {
    const auto sweep = scene.sweep(pose_of(mount), now_ns - kTestSweepNs);
    if (spoil) {
      spoil(*sweep, is_rear);
    }
    return sweep;
  }

  Pose pose_of(const LidarMount& mount) const {
    const Point at = world_from_base.apply({mount.x_m, mount.y_m});
    return {at.x_m, at.y_m, world_from_base.heading_rad() + mount.yaw_rad};
  }

  bool has_rear_lidar_;
  Velocity wheels_before_;
  std::shared_ptr<const Sweep> front_;
  std::shared_ptr<const Sweep> rear_;
};

}  // namespace mtr_drive_control
