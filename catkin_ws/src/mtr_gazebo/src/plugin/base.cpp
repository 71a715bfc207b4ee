// SPDX-License-Identifier: Apache-2.0
#include "plugin/base.hpp"

#include <cmath>
#include <sstream>
#include <stdexcept>
#include <string>

#include "mtr_core/names.hpp"

namespace mtr_gazebo {
namespace {

constexpr int kQueue = 50;
constexpr double kSPerNs = 1e-9;
constexpr std::size_t kDimensions = 6;

BaseFigures figures_of(const sdf::ElementPtr& element) {
  const auto figure = [&](const char* name) { return value_of<double>(element, name); };
  return {figure("max_linear_mps"),       figure("max_angular_radps"), figure("max_linear_mps2"),
          figure("max_angular_radps2"),   figure("command_timeout_s"), figure("believed_radius_m"),
          figure("believed_half_track_m")};
}

OdometryFigures odometry_figures_of(const sdf::ElementPtr& element) {
  const BaseFigures figures = figures_of(element);
  return {figures.believed_radius_m, figures.believed_half_track_m, value_of<double>(element, "encoder_ticks_per_m")};
}

/// Returns the joints of a side, each with a speed-controlled motor of limited torque.
Side side_of(const sdf::ElementPtr& element, const std::string& name, const gazebo::physics::ModelPtr& model) {
  Side side;
  const double torque_nm = value_of<double>(element, "max_wheel_torque_nm");
  for (sdf::ElementPtr each = element->GetElement(name); each; each = each->GetNextElement(name)) {
    const gazebo::physics::JointPtr joint = model->GetJoint(each->Get<std::string>());
    if (!joint) {
      throw std::runtime_error("The model " + model->GetName() + " has no joint " + each->Get<std::string>() + ".");
    }
    joint->SetParam("fmax", 0, torque_nm);
    side.push_back(joint);
  }
  return side;
}

void turn(const Side& side, double speed_radps) {
  for (const gazebo::physics::JointPtr& joint : side) {
    joint->SetParam("vel", 0, speed_radps);
  }
}

double mean_angle(const Side& side) {
  double sum = 0.0;
  for (const gazebo::physics::JointPtr& joint : side) {
    sum += joint->Position(0);
  }
  return sum / static_cast<double>(side.size());
}

nav_msgs::Odometry empty_odometry(const sdf::ElementPtr& element) {
  nav_msgs::Odometry message;
  message.header.frame_id = mtr_core::names::kOdom;
  message.child_frame_id = mtr_core::names::kBase;
  std::istringstream variances(value_of<std::string>(element, "odometry_variances"));
  for (std::size_t axis = 0; axis < kDimensions; ++axis) {
    variances >> message.pose.covariance[axis * (kDimensions + 1)];
  }
  message.twist.covariance = message.pose.covariance;
  return message;
}

}  // namespace

Base::Base(const sdf::ElementPtr& element, const gazebo::physics::ModelPtr& model, ros::NodeHandle& ros)
    : slot_(slot_of(element)),
      drive_(figures_of(element)),
      odometry_(odometry_figures_of(element)),
      left_(side_of(element, "left_joint", model)),
      right_(side_of(element, "right_joint", model)),
      message_(empty_odometry(element)),
      publisher_(ros.advertise<nav_msgs::Odometry>(value_of<std::string>(element, "odometry_topic"), kQueue)),
      subscriber_(ros.subscribe(value_of<std::string>(element, "command_topic"), kQueue, &Base::command, this,
                                ros::TransportHints().tcpNoDelay())) {}

void Base::command(const geometry_msgs::Twist& twist) { drive_.command(twist.linear.x, twist.angular.z); }

void Base::drive(double step_s) {
  const WheelSpeeds speeds = drive_.step(step_s);
  turn(left_, speeds.left_radps);
  turn(right_, speeds.right_radps);
}

void Base::update(const Step& step) {
  if (!step.has_tick(slot_)) {
    return;
  }
  const double period_s = static_cast<double>(slot_.period_ns) * kSPerNs;
  const OdometryReading reading = odometry_.read(mean_angle(left_), mean_angle(right_), period_s);
  message_.header.stamp.fromNSec(static_cast<std::uint64_t>(step.now_ns));
  message_.pose.pose.position.x = reading.x_m;
  message_.pose.pose.position.y = reading.y_m;
  message_.pose.pose.orientation.z = std::sin(0.5 * reading.heading_rad);
  message_.pose.pose.orientation.w = std::cos(0.5 * reading.heading_rad);
  message_.twist.twist.linear.x = reading.linear_mps;
  message_.twist.twist.angular.z = reading.angular_radps;
  publisher_.publish(message_);
}

}  // namespace mtr_gazebo
