/// @file
/// Converts ROS messages to plain types and back.
// SPDX-License-Identifier: Apache-2.0
#include "mtr_drive_control/ros/conversions.hpp"

#include <algorithm>
#include <cmath>

#include "mtr_core/clock.hpp"
#include "mtr_core/names.hpp"
#include "mtr_core/plausible.hpp"

namespace mtr_drive_control {
namespace {

// Share in percent from which a cell of a map counts as occupied, as in map_server.
constexpr int kOccupied = 65;
// A quaternion of norm 1 is a rotation; single precision and rounding in text are within this tolerance.
constexpr double kNormTolerance = 0.05;

bool is_rotation(const geometry_msgs::Quaternion& turn) {
  const double norm = std::sqrt(turn.w * turn.w + turn.x * turn.x + turn.y * turn.y + turn.z * turn.z);
  return std::abs(norm - 1.0) <= kNormTolerance;
}

double heading_of(const geometry_msgs::Quaternion& turn) {
  return std::atan2(2.0 * (turn.w * turn.z + turn.x * turn.y), 1.0 - 2.0 * (turn.y * turn.y + turn.z * turn.z));
}

}  // namespace

std::optional<SourceCommand> command_of(const Received<mtr_msgs::VelocityCommand>& received) {
  if (!received) {
    return std::nullopt;
  }
  const mtr_msgs::VelocityCommand& message = *received.message;
  return SourceCommand{
      received.time_ns, {message.linear_mps, message.angular_radps}, static_cast<bool>(message.active)};
}

SpeedLimit speed_limit_of(const Received<mtr_msgs::RobotMode>& received) {
  return received ? SpeedLimit{received.time_ns, received.message->max_speed_mps} : SpeedLimit{mtr_core::kNeverNs, 0.0};
}

std::optional<Motion> motion_of(const Received<nav_msgs::Odometry>& received) {
  if (!received) {
    return std::nullopt;
  }
  const nav_msgs::Odometry& message = *received.message;
  const auto& position = message.pose.pose.position;
  const double heading = heading_of(message.pose.pose.orientation);
  const Velocity velocity{message.twist.twist.linear.x, message.twist.twist.angular.z};
  if (!is_rotation(message.pose.pose.orientation) || !std::isfinite(position.x + position.y + heading) ||
      !mtr_core::is_wheel_speed(velocity.linear_mps) || !mtr_core::is_turn_rate(velocity.angular_radps)) {
    return std::nullopt;
  }
  return Motion{received.time_ns, Pose(position.x, position.y, heading), velocity};
}

std::optional<ImuReading> imu_reading_of(const Received<sensor_msgs::Imu>& received) {
  if (!received) {
    return std::nullopt;
  }
  const auto& rate = received.message->angular_velocity;
  const auto& force = received.message->linear_acceleration;
  // An IMU without an accelerometer (REP-145) does not show gravity, whatever its message contains.
  const bool has_force = received.message->linear_acceleration_covariance[0] >= 0.0;
  const double share = has_force ? 1.0 : 0.0;
  const ImuReading reading{
      received.time_ns, {rate.x, rate.y, rate.z}, {share * force.x, share * force.y, share * force.z}};
  // An implausible reading counts as silence.
  return reading.is_plausible() ? reading : ImuReading{mtr_core::kNeverNs, {}, {}};
}

std::optional<KeyHeight> key_height_of(const Received<mtr_msgs::PeripheralsState>& received) {
  if (!received || !received.message->alive) {
    return std::nullopt;
  }
  return KeyHeight{received.time_ns, received.message->key_height_m};
}

mtr_msgs::DriveStatus status_message(std::int64_t stamp_ns, const Decision& decision, const Interventions& counted) {
  mtr_msgs::DriveStatus status;
  status.header.stamp = mtr_core::stamp_of(stamp_ns);
  status.header.frame_id = mtr_core::names::kBase;
  status.source = decision.source;
  status.linear_mps = decision.velocity.linear_mps;
  status.angular_radps = decision.velocity.angular_radps;
  status.engaged_locks = decision.engaged_locks;
  status.message = decision.message.text;
  status.problems = mtr_core::messages_of<mtr_msgs::Problem>(decision.message);
  status.zone = static_cast<std::uint8_t>(decision.zone);
  const Hindrance hindrance = decision.hindrance.value_or(Hindrance{});
  status.obstacle_m = hindrance.distance_m;
  status.obstacle_bearing = hindrance.bearing_rad;
  status.manual_drives = counted.manual_drives;
  status.blockages = counted.blockages;
  status.lock_stops = counted.lock_stops;
  return status;
}

mtr_msgs::MotionLock e_stop_message(std::int64_t stamp_ns, const std::string& topic,
                                    const std::vector<EngagedLock>& engaged) {
  const auto lock = std::find_if(engaged.begin(), engaged.end(),
                                 [&topic](const EngagedLock& candidate) { return candidate.owner == topic; });
  mtr_msgs::MotionLock message;
  message.header.stamp = mtr_core::stamp_of(stamp_ns);
  message.owner = topic;
  message.emergency = true;
  message.engaged = lock != engaged.end();
  if (message.engaged) {
    message.reason = lock->reason.text;
    message.problems = mtr_core::messages_of<mtr_msgs::Problem>(lock->reason);
  }
  return message;
}

std::shared_ptr<const TestArea> test_area_of(const mtr_msgs::TestArea& message) {
  auto area = std::make_shared<TestArea>();
  area->required = static_cast<bool>(message.required);
  area->origin_id = message.origin_id;
  if (message.x.empty() && message.y.empty()) {
    return area;
  }
  std::vector<Point> corners;
  const std::size_t count = message.x.size() == message.y.size() ? message.x.size() : 0;
  for (std::size_t i = 0; i < count; ++i) {
    corners.push_back({message.x[i], message.y[i]});
  }
  const auto is_finite = [](const Point& corner) { return std::isfinite(corner.x_m) && std::isfinite(corner.y_m); };
  const bool is_area = corners.size() >= 3 && std::all_of(corners.begin(), corners.end(), is_finite);
  area->polygon = Polygon(is_area ? std::move(corners) : std::vector<Point>(3));
  return area;
}

std::optional<AreaPose> area_pose_of(const mtr_msgs::LocalizedPose& message, std::int64_t time_ns) {
  if (!message.valid || !std::isfinite(message.x + message.y + message.heading)) {
    return std::nullopt;
  }
  const auto& p = message.covariance;
  const double largest_m2 = 0.5 * (p[0] + p[4]) + std::hypot(0.5 * (p[0] - p[4]), p[1]);
  return AreaPose{time_ns, Pose(message.x, message.y, message.heading), std::sqrt(largest_m2), std::sqrt(p[8]),
                  message.origin_id};
}

std::shared_ptr<const SiteMap> site_map_of(const nav_msgs::OccupancyGrid& message) {
  const auto& info = message.info;
  const std::size_t cells = static_cast<std::size_t>(info.width) * info.height;
  const bool is_whole = cells == message.data.size() && info.resolution > 0.0F && std::isfinite(info.resolution) &&
                        std::isfinite(info.origin.position.x + info.origin.position.y) &&
                        is_rotation(info.origin.orientation);
  if (!is_whole) {
    return nullptr;
  }
  auto map = std::make_shared<SiteMap>();
  const Pose origin(info.origin.position.x, info.origin.position.y, heading_of(info.origin.orientation));
  map->free = {origin, info.resolution, info.width, std::vector<bool>(cells)};
  for (std::size_t cell = 0; cell < cells; ++cell) {
    map->free.cells[cell] = message.data[cell] == 0;
    if (message.data[cell] >= kOccupied) {
      map->occupied.push_back(
          origin.apply({(static_cast<double>(cell % info.width) + 0.5) * static_cast<double>(info.resolution),
                        (static_cast<double>(cell / info.width) + 0.5) * static_cast<double>(info.resolution)}));
    }
  }
  return map;
}

std::shared_ptr<const Sweep> SweepReader::read(const Received<sensor_msgs::LaserScan>& received) {
  const sensor_msgs::LaserScan::ConstPtr& message = received.message;
  if (message && message != message_) {
    message_ = message;
    sweep_ = std::make_shared<const Sweep>(Sweep{
        received.time_ns, message->angle_min, message->angle_increment, message->time_increment, message->range_min,
        message->range_max, message->ranges, message->header.frame_id, frame_, message->scan_time});
  }
  return sweep_;
}

}  // namespace mtr_drive_control
