/// @file
/// Reception of scans, and where their LiDAR sits.
// SPDX-License-Identifier: Apache-2.0
#include "ros/scan_input.hpp"

#include <utility>

#include "mtr_core/clock.hpp"
#include "mtr_core/names.hpp"

namespace mtr_localization {
namespace {

namespace names = mtr_core::names;

// A sweep is due one turn and one step of the clock after its first beam, see docs/lock-step.md.
constexpr std::int64_t kDueAfterNs = mtr_core::kLidar.period_ns + mtr_core::kClockStep.period_ns;
// Of the patience of those that wait for localization.
constexpr double kPatience = 0.4;
// Wall time within which the description's static transforms have arrived in simulation.
constexpr double kFramesWithinS = 1.5;
constexpr double kPollS = 0.01;

}  // namespace

std::optional<mtr_core::Waiting> input_waiting() {
  auto waiting = mtr_core::lockstep_waiting();
  if (waiting) {
    waiting->patience_s *= kPatience;
  }
  return waiting;
}

ScanInput::ScanInput(ros::NodeHandle& node, Lidar lidar, const tf2_ros::Buffer& frames, std::function<void(Sweep)> take)
    : lidar_(lidar),
      frames_(frames),
      take_(std::move(take)),
      received_(mtr_core::kLidar, kDueAfterNs, input_waiting()),
      subscriber_(node.subscribe<sensor_msgs::LaserScan>(
          lidar == Lidar::kFront ? names::kFrontScan : names::kRearScan, 10,
          [this](const sensor_msgs::LaserScan::ConstPtr& message) { receive(*message); }, ros::VoidConstPtr(),
          ros::TransportHints().tcpNoDelay())) {}

void ScanInput::wait_until_due(std::int64_t stamp_ns) {
  // Without a LiDAR nobody waits. In simulation all connections are there before the clock starts.
  if (subscriber_.getNumPublishers() > 0) {
    received_.at(stamp_ns);
  }
}

void ScanInput::receive(const sensor_msgs::LaserScan& message) {
  const std::int64_t stamp_ns = mtr_core::to_ns(message.header.stamp);
  received_.add(stamp_ns, stamp_ns);
  if (const Mount* mount = mount_of(message.header.frame_id)) {
    take_(sweep_of(message, lidar_, *mount));
  }
}

const Mount* ScanInput::mount_of(const std::string& frame) {
  const auto known = mounts_.find(frame);
  if (known != mounts_.end()) {
    return &known->second;
  }
  if (frame != unknown_frame_ && mtr_core::is_simulated()) {
    const double deadline = mtr_core::wall_seconds() + kFramesWithinS;
    while (ros::ok() && !look_up(frame) && mtr_core::wall_seconds() < deadline) {
      ros::WallDuration(kPollS).sleep();
    }
  }
  if (const auto mount = look_up(frame)) {
    return &mounts_.emplace(frame, *mount).first->second;
  }
  if (frame != unknown_frame_) {
    ROS_WARN("There is no transform from %s to '%s', or that LiDAR is not level: its scans are not used.", names::kBase,
             frame.c_str());
    unknown_frame_ = frame;
  }
  return nullptr;
}

std::optional<Mount> ScanInput::look_up(const std::string& frame) const {
  try {
    return mount_from(frames_.lookupTransform(names::kBase, frame, ros::Time(0)));
  } catch (const tf2::TransformException&) {
    return std::nullopt;
  }
}

}  // namespace mtr_localization
