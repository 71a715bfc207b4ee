/// @file
/// Wiring of drive control: topics to the core and back.
// SPDX-License-Identifier: Apache-2.0
#include "mtr_drive_control/node.hpp"

#include "mtr_lockstep/names.hpp"

namespace mtr_drive_control {
namespace {

namespace names = mtr_lockstep::names;
using mtr_msgs::VelocityCommand;

constexpr double kPeriodS = static_cast<double>(mtr_lockstep::kDriveControl.period_ns) * 1e-9;

std::optional<SourceCommand> command_of(const VelocityCommand::ConstPtr& message) {
  if (!message) {
    return std::nullopt;
  }
  return SourceCommand{mtr_lockstep::to_ns(message->header.stamp),
                       {message->linear_mps, message->angular_radps},
                       static_cast<bool>(message->active)};
}

}  // namespace

NodeParameters Node::read(mtr_lockstep::ParameterReader& reader) {
  NodeParameters parameters;
  reader.read_numbers(kRows, parameters.limits);
  reader.read("lock_owners", parameters.lock_owners);
  reader.read("manual_expected", parameters.manual_expected);
  return parameters;
}

Node::Node(ros::NodeHandle& node, const NodeParameters& parameters)
    : drive_control_(parameters.limits, kPeriodS),
      locks_(parameters.lock_owners, parameters.limits.lock_timeout_s, mtr_lockstep::lockstep_waiting()),
      ticker_(node, mtr_lockstep::kDriveControl),
      manual_(node, names::kManualVelocity, mtr_lockstep::kControllerInput, mtr_lockstep::kClockStep.period_ns,
              parameters.manual_expected),
      planner_(node, names::kPlannerVelocity, mtr_lockstep::kMotionPlanner),
      lock_subscriber_(node.subscribe<mtr_msgs::MotionLock>(
          names::kMotionLock, 50,
          [this](const mtr_msgs::MotionLock::ConstPtr& message) {
            const Lock lock{mtr_lockstep::to_ns(message->header.stamp), static_cast<bool>(message->engaged),
                            message->reason};
            locks_.take(message->owner, lock);
          },
          ros::VoidConstPtr(), ros::TransportHints().tcpNoDelay())),
      wheels_(node.advertise<geometry_msgs::Twist>(names::kWheelCommand, 10)),
      status_(node.advertise<mtr_msgs::DriveStatus>(names::kDriveStatus, 10)) {}

void Node::spin() {
  while (const auto tick_ns = ticker_.sleep()) {
    tick(*tick_ns);
  }
}

void Node::tick(std::int64_t tick_ns) {
  Inputs inputs;
  inputs.locks = locks_.engaged_at(tick_ns);
  inputs.manual = command_of(manual_.at(tick_ns));
  inputs.planner = command_of(planner_.at(tick_ns));
  publish(tick_ns, drive_control_.step(tick_ns, inputs));
}

void Node::publish(std::int64_t tick_ns, const Decision& decision) {
  geometry_msgs::Twist wheels;
  wheels.linear.x = decision.velocity.linear_mps;
  wheels.angular.z = decision.velocity.angular_radps;
  wheels_.publish(wheels);
  ticker_.count_message_sent();

  mtr_msgs::DriveStatus status;
  status.header.stamp = mtr_lockstep::stamp_of(tick_ns);
  status.header.frame_id = names::kBase;
  status.source = decision.source;
  status.linear_mps = decision.velocity.linear_mps;
  status.angular_radps = decision.velocity.angular_radps;
  status.engaged_locks = decision.engaged_locks;
  status.message = decision.message;
  status_.publish(status);

  if (decision.message != message_) {
    message_ = decision.message;
    ROS_INFO("%s", message_.empty() ? "Free to move." : message_.c_str());
  }
}

}  // namespace mtr_drive_control
