// SPDX-License-Identifier: Apache-2.0
#include "plugin/truth.hpp"

#include <geometry_msgs/PoseStamped.h>
#include <nav_msgs/Odometry.h>

#include <algorithm>
#include <cmath>

#include "mtr_core/names.hpp"

namespace mtr_gazebo {
namespace {

using ignition::math::Pose3d;
using ignition::math::Vector3d;

// Queue size: key poses must not be lost, because each advances the Car's clock.
constexpr int kQueue = 500;
constexpr double kSPerNs = 1e-9;
// The motor follows the firmware's lift within some ms: its speed is the remaining distance times this gain.
constexpr double kLiftFollowsPerS = 50.0;
constexpr double kLiftSpeedMps = 0.5;
constexpr char kGround[] = "ground";

Pose3d level(double x, double y, double heading) { return {x, y, 0.0, 0.0, 0.0, heading}; }

void set_heading(geometry_msgs::Quaternion& orientation, double heading_rad) {
  orientation.z = std::sin(0.5 * heading_rad);
  orientation.w = std::cos(0.5 * heading_rad);
}

}  // namespace

Truth::Truth(const sdf::ElementPtr& plugin, const gazebo::physics::ModelPtr& model, ros::NodeHandle& ros)
    : slot_{ns_of(plugin, "truth_period_ms"), 0},
      model_(model),
      base_(model->GetLink(mtr_core::names::kBase)),
      base_height_m_(model->WorldPose().Pos().Z()),
      pose_publisher_(ros.advertise<nav_msgs::Odometry>(mtr_core::names::kSimTruth, kQueue)),
      key_publisher_(ros.advertise<geometry_msgs::PoseStamped>(mtr_core::names::kSimKey, kQueue)) {
  const auto car = value_of<Vector3d>(plugin, "world_from_car");
  world_from_car_ = level(car.X(), car.Y(), car.Z());
  const sdf::ElementPtr lift = plugin->GetElement("lift");
  lift_joint_ = model->GetJoint(value_of<std::string>(lift, "joint"));
  lift_joint_->SetParam("fmax", 0, value_of<double>(lift, "max_force_n"));
  carriage_ = model->GetLink(value_of<std::string>(lift, "link"));
  key_on_carriage_ = value_of<Vector3d>(lift, "key");
  lift_subscriber_ = ros.subscribe(value_of<std::string>(lift, "height_topic"), kQueue, &Truth::lift, this,
                                   ros::TransportHints().tcpNoDelay());
  kidnap_subscriber_ = ros.subscribe(mtr_core::names::kSimKidnap, kQueue, &Truth::kidnap, this);
  // Keep contacts without subscribers in Gazebo.
  model->GetWorld()->Physics()->GetContactManager()->SetNeverDropContacts(true);
}

void Truth::lift(const std_msgs::Float64& height_m) {
  if (std::isfinite(height_m.data)) {
    lift_m_ = height_m.data;
  }
}

void Truth::kidnap(const geometry_msgs::Pose2D& there) {
  if (!std::isfinite(there.x) || !std::isfinite(there.y) || !std::isfinite(there.theta)) {
    ROS_WARN("The robot was not carried away: x %g m, y %g m, heading %g rad is no pose in the Car's frame.", there.x,
             there.y, there.theta);
    return;
  }
  Pose3d pose = world_from_car_ * level(there.x, there.y, there.theta);
  pose.Pos().Z(base_height_m_);
  model_->SetWorldPose(pose);
  model_->ResetPhysicsStates();
  ROS_INFO("The robot was carried to x %.2f m, y %.2f m in the Car's frame.", there.x, there.y);
}

void Truth::drive() {
  const double speed = (lift_m_ - lift_joint_->Position(0)) * kLiftFollowsPerS;
  lift_joint_->SetParam("vel", 0, std::clamp(speed, -kLiftSpeedMps, kLiftSpeedMps));
}

void Truth::update(const Step& step) {
  if (step.has_tick(slot_)) {
    publish_pose(step.now_ns);
    publish_key(step.now_ns);
    log_contacts(step.now_ns);
  }
}

void Truth::publish_pose(std::int64_t now_ns) {
  const Pose3d pose = world_from_car_.Inverse() * base_->WorldPose();
  const Vector3d velocity = base_->RelativeLinearVel();
  nav_msgs::Odometry message;
  message.header.stamp.fromNSec(static_cast<std::uint64_t>(now_ns));
  message.header.frame_id = mtr_core::names::kCar;
  message.child_frame_id = mtr_core::names::kBase;
  message.pose.pose.position.x = pose.Pos().X();
  message.pose.pose.position.y = pose.Pos().Y();
  set_heading(message.pose.pose.orientation, pose.Rot().Yaw());
  message.twist.twist.linear.x = velocity.X();
  message.twist.twist.linear.y = velocity.Y();
  message.twist.twist.angular.z = base_->WorldAngularVel().Z();
  pose_publisher_.publish(message);
}

void Truth::publish_key(std::int64_t now_ns) {
  const Pose3d car_from_base = world_from_car_.Inverse() * base_->WorldPose();
  const Pose3d carriage = world_from_car_.Inverse() * carriage_->WorldPose();
  const Vector3d key = carriage.Pos() + carriage.Rot().RotateVector(key_on_carriage_);
  geometry_msgs::PoseStamped message;
  message.header.stamp.fromNSec(static_cast<std::uint64_t>(now_ns));
  message.header.frame_id = mtr_core::names::kCar;
  message.pose.position.x = key.X();
  message.pose.position.y = key.Y();
  message.pose.position.z = key.Z();
  set_heading(message.pose.orientation, car_from_base.Rot().Yaw());
  key_publisher_.publish(message);
}

void Truth::log_contacts(std::int64_t now_ns) {
  const std::set<std::string> touched = this->touched();
  for (const std::string& name : touched) {
    if (touched_.count(name) == 0) {
      ROS_WARN("The robot touches %s at %.2f s.", name.c_str(), static_cast<double>(now_ns) * kSPerNs);
    }
  }
  touched_ = touched;
}

std::set<std::string> Truth::touched() const {
  std::set<std::string> found;
  const gazebo::physics::ContactManager* contacts = model_->GetWorld()->Physics()->GetContactManager();
  for (unsigned int index = 0; index < contacts->GetContactCount(); ++index) {
    const gazebo::physics::Contact* contact = contacts->GetContact(index);
    const std::string first = contact->collision1->GetModel()->GetName();
    const std::string second = contact->collision2->GetModel()->GetName();
    const bool is_first = first == model_->GetName();
    if (is_first || second == model_->GetName()) {
      found.insert(is_first ? second : first);
    }
  }
  found.erase(kGround);
  return found;
}

}  // namespace mtr_gazebo
