/// @file
/// Wiring of localization: topics and the pose source.
// SPDX-License-Identifier: Apache-2.0
#include "ros/node.hpp"

#include <nav_msgs/Odometry.h>
#include <rosgraph_msgs/Clock.h>
#include <sensor_msgs/Imu.h>

#include <algorithm>
#include <optional>
#include <string>
#include <utility>

#include "localizer.hpp"
#include "mtr_core/clock.hpp"
#include "mtr_core/names.hpp"
#include "mtr_description/robot_description.hpp"
#include "ros/conversions.hpp"
#include "ros/stamps.hpp"

namespace mtr_localization {
namespace {

namespace names = mtr_core::names;

constexpr double kPeriodS = static_cast<double>(mtr_core::kLocalization.period_ns) * 1e-9;
// Wheels and IMU publish every period; after this time, a message may have arrived without having been read.
constexpr std::int64_t kUnreadAfterNs = 5 * mtr_core::kLocalization.period_ns / 2;
// Longest suspension of the reading thread on a busy machine.
constexpr double kReadWithinS = 0.25;

template <typename M, typename Callback>
ros::Subscriber subscribe(ros::NodeHandle& node, const char* topic, Callback callback) {
  return node.subscribe<M>(
      topic, 100, [callback](const typename M::ConstPtr& message) { callback(*message); }, ros::VoidConstPtr(),
      ros::TransportHints().tcpNoDelay());
}

/// Returns the pose of odom in map from another program.
std::optional<StampedPose> map_from_odom_in(const tf2_ros::Buffer& transforms) {
  try {
    const auto transform = transforms.lookupTransform(names::kMap, names::kOdom, ros::Time(0));
    // The newest transform may be old, so its usual age is unknown.
    std::int64_t unknown_age_ns = 0;
    return StampedPose{time_of(mtr_core::to_ns(transform.header.stamp), unknown_age_ns), pose_of(transform.transform)};
  } catch (const tf2::TransformException&) {
    return std::nullopt;
  }
}

/// Returns the id of the run for stored files, or an empty text without roslaunch. /run_id lasts as long as the ROS
/// master, which may outlive a start of the robot, so a separate id takes precedence.
std::string this_run() { return ros::param::param(names::kRobotRun, ros::param::param("/run_id", std::string())); }

}  // namespace

NodeParameters Node::read(mtr_core::ParameterReader& reader) {
  NodeParameters parameters;
  for_each_group(parameters.localization,
                 [&reader](const auto& rows, auto& group) { reader.read_numbers(rows, group); });
  reader.read_numbers(kExternalRows, parameters.external);
  reader.read_numbers(kScanRows, parameters.scans);
  reader.read("publish_odom_tf", parameters.publish_odom_tf);
  reader.read("rear_lidar", parameters.rear_lidar);
  reader.read("pose_source", parameters.pose_source, {"own", "external"});
  reader.read("memory_folder", parameters.memory_folder);
  if (parameters.pose_source == "external" && !parameters.publish_odom_tf) {
    // The external transform would refer to the base's odom frame, which drifts away from the odom frame of this node.
    throw mtr_core::ConfigurationError(
        "Parameter pose_source is external and publish_odom_tf false; allowed is external with publish_odom_tf true, "
        "and the base has to leave odom to base_link to localization.");
  }
  return parameters;
}

std::unique_ptr<PoseSource> Node::pose_source_of(NodeParameters parameters) {
  // In a replay, the clock waits for this node, as offline.
  parameters.localization.lockstep = mtr_core::is_held();
  if (parameters.pose_source == "external") {
    return std::make_unique<ExternalPose>(parameters.localization, parameters.external,
                                          [this] { return map_from_odom_in(transforms_); });
  }
  return own_source(parameters.localization);
}

std::unique_ptr<PoseSource> Node::own_source(const Parameters& parameters) {
  auto localizer = std::make_unique<Localizer>(parameters);
  if (const auto saved = memory_.map()) {
    Memory memory = memory_of(saved->map);
    memory.pose = memory_.pose();
    ROS_WARN("Localization was started anew; it goes on with map %u of before, %s.", memory.revision,
             memory.pose ? "near where the robot was" : "and nobody knows where the robot is");
    localizer->go_on(std::move(memory));
    outputs_.publish_map_of_before(*saved);
  }
  return localizer;
}

Node::Node(ros::NodeHandle& node, const NodeParameters& parameters)
    : frames_(mtr_description::described_robot(), mtr_description::lidars_by_frame(parameters.rear_lidar)),
      listener_(transforms_),
      memory_(parameters.memory_folder, this_run()),
      outputs_(node, parameters.publish_odom_tf, memory_),
      source_(pose_source_of(parameters)),
      front_(node, Lidar::kFront, frames_, parameters.scans, [this](Sweep sweep) { receive_sweep(std::move(sweep)); }),
      rear_(node, Lidar::kRear, frames_, parameters.scans, [this](Sweep sweep) { receive_sweep(std::move(sweep)); }),
      gnss_(node, frames_,
            [this](GnssFix fix) {
              fix.stamp_ns = time_of(fix.stamp_ns, ages_.fix_ns);
              return source_->add_fix(fix);
            }),
      orders_received_(mtr_core::kCarLocator, mtr_core::kClockStep.period_ns, input_waiting()),
      orders_(subscribe<mtr_msgs::MappingOrder>(node, names::kMappingOrder,
                                                [this](const auto& message) { receive_order(message); })),
      imu_(subscribe<sensor_msgs::Imu>(node, names::kImuData,
                                       [this](const auto& message) { receive_imu(imu_sample_of(message)); })),
      wheels_(subscribe<nav_msgs::Odometry>(node, names::kWheelOdometry, [this](const auto& message) {
        waiting_.push_back(wheel_sample_of(message));
        newest_wheels_ns_ = waiting_.back().stamp_ns = time_of(waiting_.back().stamp_ns, ages_.wheels_ns);
      })) {
  subscribe_to_time(node);
}

void Node::spin() {
  while (mtr_core::run_callbacks(mtr_core::kShutdownCheckS)) {
    const std::int64_t newest_ns = waiting_.empty() ? 0 : waiting_.back().stamp_ns;
    if (may_have_unread(std::max(newest_ns, silence_due_ns_.value_or(0)))) {
      read_arrived();
    }
    answer_waiting();
    check_silence();
  }
}

bool Node::may_have_unread(std::int64_t now_ns) const {
  // In lock-step, the clock waits until everything due has been processed.
  return !mtr_core::is_lockstep() && now_ns - std::min(newest_imu_ns_, newest_wheels_ns_) > kUnreadAfterNs;
}

void Node::read_arrived() {
  barrier_.wait(kReadWithinS);
  mtr_core::run_callbacks(0.0);
}

void Node::check_silence() {
  const auto now_ns = std::exchange(silence_due_ns_, std::nullopt);
  // In lock-step, the clock waits, so this node is never late.
  if (now_ns && (silence_turn_.counts(*now_ns) || mtr_core::is_lockstep())) {
    publish(source_->check_silence(*now_ns));
  }
}

void Node::answer_waiting() {
  while (!waiting_.empty()) {
    const WheelSample wheels = waiting_.front();
    waiting_.pop_front();
    answer(wheels);
  }
}

void Node::subscribe_to_time(ros::NodeHandle& node) {
  if (mtr_core::is_simulated()) {
    // Check at the steps of the simulated clock, so that silence is detected at the same time on any machine.
    clock_ = node.subscribe<rosgraph_msgs::Clock>(
        "/clock", 1,
        [this](const rosgraph_msgs::Clock::ConstPtr& message) { silence_due_ns_ = mtr_core::to_ns(message->clock); },
        ros::VoidConstPtr(), ros::TransportHints().tcpNoDelay());
  } else {
    // Initialise the clock mapping, because stamps of messages sent before the first input are ROS times, too.
    std::int64_t age_ns = 0;
    time_of(mtr_core::to_ns(ros::Time::now()), age_ns);
    timer_ = node.createSteadyTimer(ros::WallDuration(kPeriodS), [this](const ros::SteadyTimerEvent&) {
      silence_due_ns_ = mtr_core::boot_time_ns();
    });
  }
}

void Node::receive_imu(ImuSample sample) {
  newest_imu_ns_ = sample.stamp_ns = time_of(sample.stamp_ns, ages_.imu_ns);
  publish_measured([&] { return source_->add_imu(sample); });
}

void Node::publish(std::vector<Estimate> estimates) {
  for (Estimate& estimate : estimates) {
    estimate.stamp_ns = stamp_of(estimate.stamp_ns);
  }
  outputs_.publish(*source_, estimates, load_);
}

void Node::receive_sweep(Sweep sweep) {
  sweep.stamp_ns = time_of(sweep.stamp_ns, sweep.lidar == Lidar::kFront ? ages_.front_ns : ages_.rear_ns);
  if (!mtr_core::is_lockstep() && !(!waiting_.empty() && may_have_unread(waiting_.back().stamp_ns))) {
    // After a delay, both messages were received at once: process the wheels first.
    answer_waiting();
  }
  const std::int64_t end_ns = sweep.end_ns();
  const std::string problem = source_->add_scan(std::move(sweep));
  if (!problem.empty() && problem != scan_problem_) {
    ROS_WARN("%s It is not used; %d were refused so far.", problem.c_str(), source_->figures().scans_refused);
  }
  scan_problem_ = problem;
  const WorkLoad::Timer timer;
  // On the robot's own clock, a scan is used at once; the next pose follows with the next wheel odometry.
  if (source_->use_scans()) {
    load_.add(timer.elapsed_ms(), 1);
    if (source_->owns_map_frame()) {
      outputs_.publish_map_from_odom(stamp_of(end_ns), source_->newest());
    }
  }
}

void Node::receive_order(const mtr_msgs::MappingOrder& message) {
  MapOrder order = order_of(message);
  order.stamp_ns = time_of(order.stamp_ns, ages_.order_ns);
  orders_received_.add(order.stamp_ns, order.stamp_ns);
  source_->add_order(order);
}

void Node::answer(const WheelSample& wheels) {
  front_.wait_until_due(wheels.stamp_ns);
  rear_.wait_until_due(wheels.stamp_ns);
  if (orders_.getNumPublishers() > 0) {
    orders_received_.at(wheels.stamp_ns);
  }
  publish_measured([&] { return source_->add_wheels(wheels); });
}

void Node::publish_measured(const std::function<std::vector<Estimate>()>& answer) {
  const int scans_before = source_->scans_used();
  const WorkLoad::Timer timer;
  std::vector<Estimate> estimates = answer();
  load_.add(timer.elapsed_ms(), source_->scans_used() - scans_before);
  publish(std::move(estimates));
}

}  // namespace mtr_localization
