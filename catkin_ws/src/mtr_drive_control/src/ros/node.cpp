/// @file
/// Wiring of drive control: connects topics to the core.
// SPDX-License-Identifier: Apache-2.0
#include "mtr_drive_control/ros/node.hpp"

#include <geometry_msgs/Twist.h>

#include <algorithm>
#include <utility>

#include "mtr_core/names.hpp"
#include "mtr_description/robot_description.hpp"
#include "mtr_drive_control/tip_over.hpp"
#include "problems.hpp"

namespace mtr_drive_control {
namespace {

namespace names = mtr_core::names;

constexpr double kPeriodS = static_cast<double>(mtr_core::kDriveControl.period_ns) * 1e-9;
// A scan has its first beam's time and arrives after the sweep, before the clock.
constexpr std::int64_t kScanLagNs = mtr_core::kLidar.period_ns;
// As in mtr_core/quiet_log.py.
constexpr std::int64_t kQuietStartNs = 5 * mtr_core::kSecondNs;
// The last published messages may be lost at the end of the process.
constexpr int kZerosBeforeLeaving = 5;

std::vector<std::string> owners_of(const NodeParameters& parameters) {
  std::vector<std::string> owners = parameters.lock_owners;
  owners.insert(owners.end(), parameters.e_stop_topics.begin(), parameters.e_stop_topics.end());
  return owners;
}

std::map<std::string, std::string> permitted_publishers(bool has_guard) {
  const std::string& own = ros::this_node::getName();
  // The master uses the topic names after remapping by a launch file.
  const std::string wheels = ros::names::resolve(names::kWheelCommand);
  if (has_guard) {
    return {{ros::names::resolve(names::kGuardedWheelCommand), own}, {wheels, names::kBaseGuard}};
  }
  return {{wheels, own}};
}

void log_limits(const NodeParameters& parameters) {
  for (const double key_m : {0.0, parameters.limits.key_raised_m}) {
    const Limits limits = limits_at(parameters.limits, key_m);
    ROS_INFO("Limits with the key %s: %.2f m/s, %.2f rad/s, stops at %.2f m/s2 and in an emergency at %.2f m/s2.",
             key_m > 0.0 ? "raised" : "low", limits.max_linear_mps, limits.max_angular_radps,
             limits.linear_deceleration_mps2, limits.emergency_linear_deceleration_mps2);
  }
  if (!parameters.rear_lidar) {
    ROS_WARN(
        "There is no rear LiDAR: nobody who walks in behind is seen. Backwards at %.2f m/s at most, and only into "
        "ground seen free within the last %.0f s; the LEDs warn.",
        parameters.collision.unwatched_reverse_mps, parameters.collision.ground_memory_s);
  }
}

}  // namespace

LidarInput::LidarInput(ros::NodeHandle& node, const std::string& topic, const std::string& frame)
    : scans_(node, topic, mtr_core::kLidar, kScanLagNs), reader_(frame) {}

NodeParameters Node::read(mtr_core::ParameterReader& reader) {
  NodeParameters parameters;
  reader.read_numbers(kRows, parameters.limits);
  reader.read_numbers(kCollisionRows, parameters.collision);
  reader.read_numbers(kAreaRows, parameters.area);
  reader.read("lock_owners", parameters.lock_owners);
  reader.read("e_stop_topics", parameters.e_stop_topics);
  reader.read("rear_lidar", parameters.rear_lidar);
  reader.read("contact_skirt", parameters.collision.contact_skirt);
  reader.read("base_controller", parameters.base_controller);
  reader.read("base_guard", parameters.base_guard);
  reader.read("manual_expected", parameters.manual_expected);
  return parameters;
}

Node::Node(ros::NodeHandle& node, const NodeParameters& parameters)
    : drive_control_(parameters.limits, parameters.collision,
                     shape_of(mtr_description::described_robot(), parameters.rear_lidar), kPeriodS, parameters.area),
      locks_(owners_of(parameters), parameters.limits.lock_timeout_s, mtr_core::lockstep_waiting()),
      e_stop_topics_(parameters.e_stop_topics),
      ticker_(node, mtr_core::kDriveControl),
      manual_(node, names::kManualVelocity, mtr_core::kControllerInput, mtr_core::kClockStep.period_ns,
              parameters.manual_expected),
      planner_(node, names::kPlannerVelocity, mtr_core::kMotionPlanner),
      mode_(node, names::kRobotMode, mtr_core::kStateMachine),
      odometry_(node, names::kWheelOdometry, mtr_core::kSensors, 0),
      imu_(node, names::kImuData, mtr_core::kSensors, 0),
      peripherals_(node, names::kPeripheralsState, mtr_core::kPeripherals),
      front_(node, names::kFrontScan, mtr_description::message_frame(names::kFrontLidar)),
      map_(node),
      area_(node),
      markers_(node),
      wheels_(node.advertise<geometry_msgs::Twist>(
          parameters.base_guard ? names::kGuardedWheelCommand : names::kWheelCommand, 10)),
      status_(node.advertise<mtr_msgs::DriveStatus>(names::kDriveStatus, 10)),
      publishers_(permitted_publishers(parameters.base_guard)) {
  if (parameters.rear_lidar) {
    rear_.emplace(node, names::kRearScan, mtr_description::message_frame(names::kRearLidar));
  }
  check_balance(parameters.limits, mtr_description::described_robot());
  watch_base(parameters);
  listen_to_locks(node);
  log_limits(parameters);
}

void Node::watch_base(const NodeParameters& parameters) {
  const std::string controller =
      parameters.base_guard ? std::string(names::kBaseGuard) + kShippedController : parameters.base_controller;
  if (const std::optional<BaseLimits> limits = limits_of_base(controller, parameters.limits)) {
    base_.emplace(controller, parameters.limits, *limits);
  }
}

void Node::listen_to_locks(ros::NodeHandle& node) {
  lock_subscribers_.push_back(node.subscribe<mtr_msgs::MotionLock>(
      names::kMotionLock, 50,
      [this](const mtr_msgs::MotionLock::ConstPtr& message) {
        // Its own report of an emergency stop comes back; accepting it would keep the lock engaged.
        if (is_e_stop(message->owner)) {
          return;
        }
        const Lock lock{mtr_core::time_of(message->header.stamp, lock_age_ns_), static_cast<bool>(message->engaged),
                        mtr_core::problem_of(message->problems, message->reason),
                        static_cast<bool>(message->emergency)};
        take(message->owner, lock);
      },
      ros::VoidConstPtr(), ros::TransportHints().tcpNoDelay()));
  if (e_stop_topics_.empty()) {
    return;
  }
  // These also stop lift, servos and presses and are shown to the Operator, because those nodes subscribe to motion
  // locks.
  e_stops_ = node.advertise<mtr_msgs::MotionLock>(names::kMotionLock, 50);
  for (const std::string& topic : e_stop_topics_) {
    listen_to_e_stop(node, topic);
  }
}

void Node::listen_to_e_stop(ros::NodeHandle& node, const std::string& topic) {
  lock_subscribers_.push_back(node.subscribe<std_msgs::Bool>(
      topic, 50,
      [this, topic](const std_msgs::Bool::ConstPtr& message) {
        const Lock lock{ticker_.now().time_ns, static_cast<bool>(message->data), problems::kEmergencyStop(), true};
        take(topic, lock);
      },
      ros::VoidConstPtr(), ros::TransportHints().tcpNoDelay()));
}

bool Node::is_e_stop(const std::string& owner) const {
  return std::find(e_stop_topics_.begin(), e_stop_topics_.end(), owner) != e_stop_topics_.end();
}

void Node::take(const std::string& owner, const Lock& lock) {
  // Callbacks run while the node waits for its next tick. A stop executes its first step at once, and the next one
  // slightly early. In lock-step all ticks are regular.
  if (locks_.take(owner, lock) && !mtr_core::is_lockstep()) {
    tick(ticker_.now());
  }
}

void Node::spin() {
  mtr_core::leave_in_order();
  auto instant = ticker_.sleep();
  while (instant && zeros_sent_ < kZerosBeforeLeaving) {
    tick(*instant);
    instant = ticker_.sleep();
  }
}

void Node::tick(const mtr_core::Instant& tick) {
  const std::int64_t tick_ns = tick.time_ns;
  Inputs inputs;
  inputs.sensors.front = front_.at(tick_ns);
  inputs.sensors.rear = rear_ ? rear_->at(tick_ns) : nullptr;
  inputs.sensors.motion = motion_of(odometry_.at(tick_ns));
  inputs.sensors.map = map_.at(inputs.sensors.motion);
  inputs.imu = imu_reading_of(imu_.at(tick_ns));
  inputs.area = area_.at();
  inputs.key = key_height_of(peripherals_.at(tick_ns));
  inputs.locks = locks_.engaged_at(tick_ns);
  inputs.locks_age_s = locks_.age_s();
  for (const std::string& topic : e_stop_topics_) {
    e_stops_.publish(e_stop_message(tick.stamp_ns, topic, inputs.locks));
  }
  const std::vector<EngagedLock> own = own_locks();
  inputs.locks.insert(inputs.locks.begin(), own.begin(), own.end());
  inputs.manual = command_of(manual_.at(tick_ns));
  inputs.planner = command_of(planner_.at(tick_ns));
  inputs.speed_limit = speed_limit_of(mode_.at(tick_ns));
  publish(tick, drive_control_.step(tick_ns, inputs));
}

std::vector<EngagedLock> Node::own_locks() const {
  std::vector<EngagedLock> locks;
  if (mtr_core::is_asked_to_leave()) {
    locks.push_back({kOwner, problems::kLeaving()});
  }
  if (const std::string change = base_ ? base_->change() : std::string(); !change.empty()) {
    locks.push_back({kOwner, problems::kBaseChanged({{"why", change}})});
  }
  if (const std::optional<Intruder> intruder = publishers_.intruder()) {
    locks.push_back({kOwner, problems::kSecondPublisher({{"node", intruder->node}, {"topic", intruder->topic}})});
  }
  return locks;
}

void Node::publish(const mtr_core::Instant& tick, const Decision& decision) {
  geometry_msgs::Twist wheels;
  wheels.linear.x = decision.velocity.linear_mps;
  wheels.angular.z = decision.velocity.angular_radps;
  wheels_.publish(wheels);
  zeros_sent_ = mtr_core::is_asked_to_leave() && decision.velocity.is_zero() ? zeros_sent_ + 1 : 0;
  ticker_.count_message_sent();
  status_.publish(status_message(tick.stamp_ns, decision, interventions_.count(decision)));
  markers_.publish(tick, decision, drive_control_);
  log(tick.time_ns, decision);
}

void Node::log(std::int64_t now_ns, const Decision& decision) {
  begun_ns_ = begun_ns_ ? begun_ns_ : now_ns;
  was_free_ = was_free_ || !decision.message;
  // At the start other nodes have not published yet, so only a lasting problem is a warning.
  const bool is_start = !was_free_ && now_ns - *begun_ns_ < kQuietStartNs;
  // Warnings are shown to the Operator.
  const bool is_stopped = decision.zone == Zone::kBlocked || decision.zone == Zone::kBlind;
  const bool is_warning = is_stopped && !is_start;
  // Distances and durations in the sentence change continuously.
  std::string kind = decision.message.kind();
  if (kind == logged_kind_ && is_warning == logged_warning_) {
    return;
  }
  logged_kind_ = std::move(kind);
  logged_warning_ = is_warning;
  ROS_LOG(is_warning ? ros::console::levels::Warn : ros::console::levels::Info, ROSCONSOLE_DEFAULT_NAME, "%s",
          decision.message ? decision.message.text.c_str() : "Free to move.");
}

}  // namespace mtr_drive_control
