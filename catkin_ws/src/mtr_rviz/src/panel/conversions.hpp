/// @file
/// Conversions of ROS messages and parameters to core types.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <mtr_msgs/CarCheck.h>
#include <mtr_msgs/CarEstimate.h>
#include <mtr_msgs/DriveStatus.h>
#include <mtr_msgs/LocalizedPose.h>
#include <mtr_msgs/MotionStatus.h>
#include <mtr_msgs/PeripheralsState.h>
#include <mtr_msgs/RobotMode.h>
#include <xmlrpcpp/XmlRpcValue.h>

#include <optional>

#include "core/fault_order.hpp"
#include "core/robot.hpp"

namespace mtr_rviz {

ModeSaid from_message(const mtr_msgs::RobotMode& message);
PoseSaid from_message(const mtr_msgs::LocalizedPose& message);
CarSaid from_message(const mtr_msgs::CarEstimate& message);
SelfCheckSaid from_message(const mtr_msgs::CarCheck& message);
MotionSaid from_message(const mtr_msgs::MotionStatus& message);
DriveSaid from_message(const mtr_msgs::DriveStatus& message);
PartsSaid from_message(const mtr_msgs::PeripheralsState& message);

/// Returns the content of mtr_dispatcher's parameter preflight_report, or nothing if it is invalid.
/// @param steady_s the robot's steady clock
std::optional<Preflight> preflight_in(XmlRpc::XmlRpcValue& parameter, double steady_s);

/// Returns the content of mtr_fault_injection's parameter; empty if it is invalid.
FaultCatalogue catalogue_in(XmlRpc::XmlRpcValue& parameter);

}  // namespace mtr_rviz
