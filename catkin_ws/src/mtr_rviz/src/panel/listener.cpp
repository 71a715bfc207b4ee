/// @file
/// Received ROS messages and parameters in core types.
// SPDX-License-Identifier: Apache-2.0
#include "panel/listener.hpp"

#include "mtr_core/names.hpp"
#include "mtr_core/steady_time.hpp"
#include "panel/conversions.hpp"

namespace mtr_rviz {
namespace {

namespace names = mtr_core::names;
/// More than the messages between two iterations of a busy window.
constexpr int kQueue = 20;

/// Clock of preflights on the robot.
double steady_s() {
  return ros::Time::isSimTime() ? ros::Time::now().toSec() : static_cast<double>(mtr_core::boot_time_ns()) * 1e-9;
}

/// Returns a parameter of the master, or nothing if it is unset or the master is unavailable. It is not cached, and the
/// call is fast.
std::optional<XmlRpc::XmlRpcValue> parameter(const char* name) {
  XmlRpc::XmlRpcValue value;
  return ros::param::get(name, value) ? std::optional<XmlRpc::XmlRpcValue>(value) : std::nullopt;
}

/// Returns the message with its arrival time.
template <typename Said>
Heard<Said> heard(Said said) {
  return {std::move(said), Listener::now_s()};
}

}  // namespace

Listener::Listener() {
  listen(names::kRobotMode, &Listener::take_mode);
  listen(names::kLocalizedPose, &Listener::take_pose);
  listen(names::kCarEstimate, &Listener::take_car);
  listen(names::kCarCheck, &Listener::take_check);
  listen(names::kMotionStatus, &Listener::take_motion);
  listen(names::kDriveStatus, &Listener::take_drive);
  listen(names::kPeripheralsState, &Listener::take_parts);
  listen(names::kMotionLock, &Listener::take_lock);
  listen(names::kActiveFaults, &Listener::take_faults);
}

template <typename Message>
void Listener::listen(const char* topic, void (Listener::*take)(const Message&)) {
  subscribers_.push_back(node_.subscribe<Message>(
      topic, kQueue, [this, take](const boost::shared_ptr<const Message>& message) { (this->*take)(*message); }));
}

Robot Listener::robot() const {
  Robot robot = robot_;
  if (faults_) {
    std::vector<std::string> sentences;
    for (const mtr_msgs::ActiveFault& fault : faults_->faults) {
      sentences.push_back(fault_sentence(fault.part, fault.kind, (fault.until - ros::Time::now()).toSec()));
    }
    robot.faults = sentences;
  }
  return robot;
}

void Listener::look() {
  std::optional<XmlRpc::XmlRpcValue> preflight = parameter(names::kPreflightReport);
  robot_.preflight = preflight ? preflight_in(*preflight, steady_s()) : std::nullopt;
  if (faults_ && catalogue_.empty()) {
    std::optional<XmlRpc::XmlRpcValue> catalogue = parameter(names::kFaultCatalogue);
    catalogue_ = catalogue ? catalogue_in(*catalogue) : FaultCatalogue{};
  }
}

double Listener::now_s() { return ros::SteadyTime::now().toSec(); }

void Listener::take_mode(const mtr_msgs::RobotMode& message) { robot_.mode = heard(from_message(message)); }

void Listener::take_pose(const mtr_msgs::LocalizedPose& message) { robot_.pose = heard(from_message(message)); }

void Listener::take_car(const mtr_msgs::CarEstimate& message) { robot_.car = heard(from_message(message)); }

void Listener::take_check(const mtr_msgs::CarCheck& message) { robot_.self_check = heard(from_message(message)); }

void Listener::take_motion(const mtr_msgs::MotionStatus& message) { robot_.motion = heard(from_message(message)); }

void Listener::take_drive(const mtr_msgs::DriveStatus& message) { robot_.drive = heard(from_message(message)); }

void Listener::take_parts(const mtr_msgs::PeripheralsState& message) { robot_.parts = heard(from_message(message)); }

void Listener::take_lock(const mtr_msgs::MotionLock& message) {
  robot_.locks[message.owner] = heard(LockSaid{message.engaged != 0, message.reason});
}

void Listener::take_faults(const mtr_msgs::ActiveFaults& message) { faults_ = message; }

}  // namespace mtr_rviz
