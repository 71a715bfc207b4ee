/// @file
/// Wiring of localization: topics to the core and back.
// SPDX-License-Identifier: Apache-2.0
#include "mtr_localization/node.hpp"

#include <diagnostic_msgs/DiagnosticArray.h>
#include <rosgraph_msgs/Clock.h>

#include "mtr_localization/conversions.hpp"
#include "mtr_localization/diagnostics.hpp"
#include "mtr_lockstep/clock.hpp"
#include "mtr_lockstep/names.hpp"

namespace mtr_localization {
namespace {

namespace names = mtr_lockstep::names;

constexpr double kPeriodS = static_cast<double>(mtr_lockstep::kLocalization.period_ns) * 1e-9;

}  // namespace

NodeParameters Node::read(mtr_lockstep::ParameterReader& reader) {
  NodeParameters parameters;
  reader.read_numbers(kRows, parameters.sensors);
  reader.read("publish_odom_tf", parameters.publish_odom_tf);
  return parameters;
}

Node::Node(ros::NodeHandle& node, const NodeParameters& parameters)
    : localizer_(parameters.sensors),
      publish_odom_tf_(parameters.publish_odom_tf),
      poses_(node.advertise<mtr_msgs::LocalizedPose>(names::kLocalizedPose, 50)),
      diagnostics_(node.advertise<diagnostic_msgs::DiagnosticArray>("/diagnostics", 10)),
      imu_(node.subscribe<sensor_msgs::Imu>(
          names::kImuData, 100,
          [this](const sensor_msgs::Imu::ConstPtr& message) { publish(localizer_.add_imu(imu_sample_of(*message))); },
          ros::VoidConstPtr(), ros::TransportHints().tcpNoDelay())),
      wheels_(node.subscribe<nav_msgs::Odometry>(
          names::kWheelOdometry, 100,
          [this](const nav_msgs::Odometry::ConstPtr& message) {
            publish(localizer_.add_wheels(wheel_sample_of(*message)));
          },
          ros::VoidConstPtr(), ros::TransportHints().tcpNoDelay())) {
  watch_silence(node);
}

void Node::spin() { ros::spin(); }

void Node::watch_silence(ros::NodeHandle& node) {
  if (mtr_lockstep::is_simulated()) {
    // By the simulated clock's own steps, so that silence is noticed at the same instant on any machine.
    clock_ = node.subscribe<rosgraph_msgs::Clock>(
        "/clock", 1,
        [this](const rosgraph_msgs::Clock::ConstPtr& message) {
          publish(localizer_.check_silence(mtr_lockstep::to_ns(message->clock)));
        },
        ros::VoidConstPtr(), ros::TransportHints().tcpNoDelay());
  } else {
    timer_ = node.createWallTimer(ros::WallDuration(kPeriodS), [this](const ros::WallTimerEvent&) {
      publish(localizer_.check_silence(mtr_lockstep::to_ns(ros::Time::now())));
    });
  }
}

void Node::publish(const std::vector<Estimate>& estimates) {
  for (const Estimate& estimate : estimates) {
    poses_.publish(message_of(estimate));
    publish_transforms(estimate);
    publish_diagnostics(estimate);
    log(estimate);
  }
}

void Node::publish_transforms(const Estimate& estimate) {
  // Dead reckoning corrects nothing in map, so map and odom are the same frame.
  std::vector<geometry_msgs::TransformStamped> messages{
      transform_message(estimate.stamp_ns, {names::kMap, names::kOdom, 0.0, 0.0, 0.0})};
  if (publish_odom_tf_) {
    messages.push_back(transform_message(
        estimate.stamp_ns, {names::kOdom, names::kBase, estimate.x_m, estimate.y_m, estimate.heading_rad}));
  }
  transforms_.sendTransform(messages);
}

void Node::publish_diagnostics(const Estimate& estimate) {
  const std::int64_t second = estimate.stamp_ns / mtr_lockstep::kSecondNs;
  if (second != diagnosed_second_) {
    diagnosed_second_ = second;
    diagnostics_.publish(diagnostics_of(localizer_, estimate));
  }
}

void Node::log(const Estimate& estimate) {
  if (estimate.message == message_) {
    return;
  }
  message_ = estimate.message;
  if (message_.empty()) {
    ROS_INFO("Tracking; gyro bias %.5f rad/s.", localizer_.reckoning().gyro_bias_radps());
  } else if (localizer_.mode() == Mode::kStarting) {
    ROS_INFO("%s", message_.c_str());
  } else {
    ROS_WARN("%s", message_.c_str());
  }
}

}  // namespace mtr_localization
