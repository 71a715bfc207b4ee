// SPDX-License-Identifier: Apache-2.0
#include "plugin/lidar.hpp"

#include <cmath>
#include <limits>
#include <string>

#include "mtr_core/schedule.hpp"

namespace mtr_gazebo {
namespace {

using ignition::math::Quaterniond;
using ignition::math::Vector3d;

constexpr int kQueue = 10;
// Slope of the beams. With rounding errors, ODE reports hits of parallel rays on the top of a box, as for the chassis
// below the beams: the robot saw itself whenever it accelerated. Rising by this much per metre prevents that; a wall at
// 10 m is hit 1 mm higher.
constexpr double kRise = 1e-4;
constexpr double kSPerNs = 1e-9;

SweepFigures figures_of(const sdf::ElementPtr& element) {
  return {value_of<int>(element, "beams"), value_of<double>(element, "field_of_view_rad"), ns_of(element, "period_ms"),
          value_of<double>(element, "range_min_m"), value_of<double>(element, "range_max_m")};
}

sensor_msgs::LaserScan empty_scan(const sdf::ElementPtr& element, const SweepFigures& figures, const Sweep& sweep) {
  sensor_msgs::LaserScan scan;
  scan.header.frame_id = value_of<std::string>(element, "frame");
  scan.angle_min = static_cast<float>(-0.5 * figures.field_of_view_rad);
  scan.angle_max = static_cast<float>(0.5 * figures.field_of_view_rad);
  scan.angle_increment = static_cast<float>(sweep.angle_increment_rad());
  scan.time_increment = static_cast<float>(sweep.time_increment_s());
  scan.scan_time = static_cast<float>(static_cast<double>(figures.rotation_ns) * kSPerNs);
  scan.range_min = static_cast<float>(figures.range_min_m);
  scan.range_max = static_cast<float>(figures.range_max_m);
  scan.ranges.resize(static_cast<std::size_t>(figures.beams));
  return scan;
}

}  // namespace

Lidar::Lidar(const sdf::ElementPtr& element, const gazebo::physics::LinkPtr& base, std::uint64_t seed,
             ros::NodeHandle& ros)
    : figures_(figures_of(element)),
      sweep_(figures_, mtr_core::kSimulationStartNs + ns_of(element, "phase_ms")),
      base_from_lidar_(pose_of(element)),
      base_(base),
      // A shape without a collision object: its ends are in world coordinates.
      ray_(boost::dynamic_pointer_cast<gazebo::physics::RayShape>(
          base->GetWorld()->Physics()->CreateShape("ray", gazebo::physics::CollisionPtr()))),
      noise_m_(value_of<double>(element, "noise_m")),
      random_(seed),
      scan_(empty_scan(element, figures_, sweep_)),
      publisher_(ros.advertise<sensor_msgs::LaserScan>(value_of<std::string>(element, "topic"), kQueue)) {}

void Lidar::update(const Step& step) {
  sweep_.advance(
      step.now_ns, [&](const Beam& beam) { cast(beam, step.now_ns); },
      [this](std::int64_t start_ns) { publish(start_ns); });
}

void Lidar::cast(const Beam& beam, std::int64_t now_ns) {
  float& range = scan_.ranges[static_cast<std::size_t>(beam.index)];
  if (publisher_.getNumSubscribers() == 0) {
    range = std::numeric_limits<float>::infinity();
    return;
  }
  // Extrapolate from the end of the step back to the time of the beam, with the present velocities.
  const double back_s = static_cast<double>(now_ns - beam.time_ns) * kSPerNs;
  ignition::math::Pose3d world_from_base = base_->WorldPose();
  world_from_base.Pos() -= base_->WorldLinearVel() * back_s;
  world_from_base.Rot() = Quaterniond(0.0, 0.0, -base_->WorldAngularVel().Z() * back_s) * world_from_base.Rot();
  const ignition::math::Pose3d world_from_lidar = world_from_base * base_from_lidar_;
  const Vector3d along =
      world_from_lidar.Rot().RotateVector(Vector3d(std::cos(beam.angle_rad), std::sin(beam.angle_rad), kRise));
  // Start at the minimum range, because the LiDAR itself is in the way of a ray from its centre.
  ray_->SetPoints(world_from_lidar.Pos() + along * figures_.range_min_m,
                  world_from_lidar.Pos() + along * figures_.range_max_m);
  double distance_m = 0.0;
  std::string met;
  ray_->GetIntersection(distance_m, met);
  const double truth_m = met.empty() ? std::numeric_limits<double>::infinity() : figures_.range_min_m + distance_m;
  range = range_reading(truth_m, noise_m_ * normal_(random_), figures_);
}

void Lidar::publish(std::int64_t start_ns) {
  scan_.header.stamp.fromNSec(static_cast<std::uint64_t>(start_ns));
  publisher_.publish(scan_);
}

}  // namespace mtr_gazebo
