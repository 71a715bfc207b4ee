/// @file
/// Relays the wheels' commands to a base that cannot be configured; `base_guard:=true` of robot.launch.
// SPDX-License-Identifier: Apache-2.0
#include "mtr_drive_control/ros/base_guard_node.hpp"

#include <algorithm>

#include "mtr_core/clock.hpp"
#include "mtr_core/names.hpp"
#include "mtr_core/run_node.hpp"
#include "mtr_drive_control/ros/base_parameters.hpp"

namespace mtr_drive_control {
namespace {

namespace names = mtr_core::names;

constexpr double kPeriodS = static_cast<double>(mtr_core::kDriveControl.period_ns) * 1e-9;
// The last published messages may be lost at the end of the process.
constexpr int kZerosBeforeLeaving = 5;

}  // namespace

BaseLimits BaseGuardNode::read(mtr_core::ParameterReader& reader) {
  reader.ignore({kShippedController + 1});
  return checked_base(ros::this_node::getName() + kShippedController, Parameters{});
}

BaseGuardNode::BaseGuardNode(ros::NodeHandle& node, const BaseLimits& limits)
    : guard_(limits, kPeriodS),
      wheels_(node.advertise<geometry_msgs::Twist>(names::kWheelCommand, 1)),
      commands_(node.subscribe<geometry_msgs::Twist>(
          names::kGuardedWheelCommand, 1,
          [this](const geometry_msgs::Twist::ConstPtr& twist) {
            if (!mtr_core::is_asked_to_leave()) {
              guard_.take(mtr_core::boot_time_ns(), {twist->linear.x, twist->angular.z});
            }
          },
          ros::VoidConstPtr(), ros::TransportHints().tcpNoDelay())) {}

void BaseGuardNode::spin() {
  mtr_core::leave_in_order();
  std::int64_t tick_ns = mtr_core::boot_time_ns();
  while (zeros_sent_ < kZerosBeforeLeaving && mtr_core::run_callbacks(0.0)) {
    tick_ns = mtr_core::kDriveControl.next_after(std::max(tick_ns, mtr_core::boot_time_ns()));
    while (mtr_core::boot_time_ns() < tick_ns) {
      mtr_core::run_callbacks(static_cast<double>(tick_ns - mtr_core::boot_time_ns()) * 1e-9);
    }
    step();
  }
}

void BaseGuardNode::step() {
  const Velocity velocity = guard_.step(mtr_core::boot_time_ns());
  zeros_sent_ = mtr_core::is_asked_to_leave() && velocity.is_zero() ? zeros_sent_ + 1 : 0;
  geometry_msgs::Twist twist;
  twist.linear.x = velocity.linear_mps;
  twist.angular.z = velocity.angular_radps;
  wheels_.publish(twist);
}

}  // namespace mtr_drive_control

int main(int argc, char** argv) {
  return mtr_core::run_node<mtr_drive_control::BaseGuardNode>(argc, argv, "base_guard");
}
