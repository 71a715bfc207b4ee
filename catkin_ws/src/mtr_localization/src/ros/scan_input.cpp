/// @file
/// Reception of scans.
// SPDX-License-Identifier: Apache-2.0
#include "ros/scan_input.hpp"

#include <ros/console.h>

#include <utility>

#include "mtr_core/clock.hpp"
#include "mtr_core/names.hpp"

namespace mtr_localization {
namespace {

namespace names = mtr_core::names;

// A sweep is due one turn and one clock step after its first beam, see docs/lock-step.md.
constexpr std::int64_t kDueAfterNs = mtr_core::kLidar.period_ns + mtr_core::kClockStep.period_ns;
// Share of the patience of nodes that wait for localization.
constexpr double kPatience = 0.4;

}  // namespace

std::optional<mtr_core::Waiting> input_waiting() {
  auto waiting = mtr_core::lockstep_waiting();
  if (waiting) {
    waiting->patience_s *= kPatience;
  }
  return waiting;
}

ScanInput::ScanInput(ros::NodeHandle& node, Lidar lidar, RobotFrames& frames, const ScanParameters& parameters,
                     std::function<void(Sweep)> take)
    : lidar_(lidar),
      frames_(frames),
      parameters_(parameters),
      take_(std::move(take)),
      received_(mtr_core::kLidar, kDueAfterNs, input_waiting()),
      subscriber_(node.subscribe<sensor_msgs::LaserScan>(
          lidar == Lidar::kFront ? names::kFrontScan : names::kRearScan, 10,
          [this](const sensor_msgs::LaserScan::ConstPtr& message) { receive(*message); }, ros::VoidConstPtr(),
          ros::TransportHints().tcpNoDelay())) {}

void ScanInput::wait_until_due(std::int64_t stamp_ns) {
  // Without a LiDAR, there is nothing to wait for. In simulation, all connections exist before the clock starts.
  if (subscriber_.getNumPublishers() > 0) {
    received_.at(stamp_ns);
  }
}

void ScanInput::receive(const sensor_msgs::LaserScan& message) {
  const std::int64_t stamp_ns = mtr_core::to_ns(message.header.stamp);
  received_.add(stamp_ns, stamp_ns);
  if (const Mount* mount = frames_.lidar(message.header.frame_id)) {
    Sweep sweep = sweep_of(message, lidar_, *mount);
    sweep.time_beams(parameters_.time_increment_s);
    if (sweep.time_increment_s == 0.0 && !mtr_core::is_simulated()) {
      ROS_WARN_ONCE(
          "Scans do not say when each beam was measured; all count as measured at once, which is wrong while the robot "
          "moves. Name the LiDAR (lidar of robot.launch), or have its driver say it.");
    }
    take_(std::move(sweep));
  }
}

}  // namespace mtr_localization
